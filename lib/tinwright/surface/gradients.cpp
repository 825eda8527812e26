#include "tinwright/surface/gradients.hpp"
