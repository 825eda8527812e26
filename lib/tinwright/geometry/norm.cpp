#include "tinwright/geometry/norm.hpp"

#include <cmath>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

int compare_lengths(Norm /*norm*/, Key2 a, Key2 b, Key2 c, Key2 d) { return compare_distances(a, b, c, d); }

double length(Norm /*norm*/, Key2 a, Key2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace tinwright
