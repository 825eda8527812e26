#include "tinwright/water/isotonic_regression.hpp"
