#include "tinwright/delaunay/proximity_graphs.hpp"
