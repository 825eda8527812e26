#include "tinwright/surface/products.hpp"
