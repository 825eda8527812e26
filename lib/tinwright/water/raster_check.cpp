#include "tinwright/water/raster_check.hpp"
