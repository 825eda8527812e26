#include "tinwright/optimal/optimize.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/optimal/edge_insertion.hpp"
#include "tinwright/optimal/min_max_length.hpp"

namespace tinwright {

namespace {

/// Squares of slopes must not overflow.
void check_elevations(const Tin& tin) {
    constexpr double kGreatest = 1e100;
    const auto extreme =
        std::find_if(tin.z.begin(), tin.z.end(), [](double z) { return !(std::abs(z) <= kGreatest); });
    if (extreme == tin.z.end()) {
        return;
    }
    const auto vertex = static_cast<std::size_t>(extreme - tin.z.begin());
    throw InputError("the elevation " + decimal_text(*extreme) + " at " +
                         location_text(tin.lattice.position(tin.keys[vertex])) +
                         " is too great to compare faces by; remove the sample, or stay within 1e100",
                     {tin.sample[vertex]});
}

}  // namespace

OptimizeReport optimize(Tin& tin, const OptimizeOptions& options) {
    check_elevations(tin);
    return options.criterion == Criterion::Length ? minimize_longest_edge(tin, options)
                                                  : improve_by_insertions(tin, options);
}

}  // namespace tinwright
