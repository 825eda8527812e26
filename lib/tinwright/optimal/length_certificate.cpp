#include "tinwright/optimal/length_certificate.hpp"
