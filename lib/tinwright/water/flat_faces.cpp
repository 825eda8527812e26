#include "tinwright/water/flat_faces.hpp"
