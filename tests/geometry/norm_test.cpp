#include "tinwright/geometry/norm.hpp"
