#include "tinwright/surface/facets.hpp"
