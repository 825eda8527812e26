#include "tinwright/water/banks.hpp"
