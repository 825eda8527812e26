#include "tinwright/water/water.hpp"
