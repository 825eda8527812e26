#include "tinwright/optimal/min_max_length.hpp"
