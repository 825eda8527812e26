#include "tinwright/surface/linear.hpp"
