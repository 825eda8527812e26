#include "tinwright/water/flow.hpp"
