#include "tinwright/optimal/min_max_length.hpp"

namespace tinwright {

OptimizeReport minimize_longest_edge(Tin& tin, const OptimizeOptions& options) {
    OptimizeReport report;
    report.before = find_worst(tin, options.criterion, options.norm);
    report.after = report.before;
    return report;
}

}  // namespace tinwright
