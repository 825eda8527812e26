#include "tinwright/water/river_cells.hpp"
