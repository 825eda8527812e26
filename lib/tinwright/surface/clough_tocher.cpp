#include "tinwright/surface/clough_tocher.hpp"
