#include "tinwright/surface/smooth.hpp"
