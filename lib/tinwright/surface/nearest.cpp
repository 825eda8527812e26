#include "tinwright/surface/nearest.hpp"
