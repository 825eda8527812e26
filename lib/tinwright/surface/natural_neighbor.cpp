#include "tinwright/surface/natural_neighbor.hpp"
