#ifndef TINWRIGHT_GEOMETRY_PROGRESS_HPP
#define TINWRIGHT_GEOMETRY_PROGRESS_HPP

#include <functional>

#include "tinwright/geometry/error.hpp"

namespace tinwright {

/// Called now and then with the fraction done (0 to 1); returns whether to go on. May be empty.
/// Always called from the thread that started the work.
using Progress = std::function<bool(double)>;

/// Reports `fraction`; throws `Cancelled` when the callback says stop.
inline void report_progress(const Progress& progress, double fraction) {
    if (progress && !progress(fraction)) {
        throw Cancelled();
    }
}

}  // namespace tinwright

#endif
