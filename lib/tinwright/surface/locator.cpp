#include "tinwright/surface/locator.hpp"
