#include "tinwright/water/stations.hpp"
