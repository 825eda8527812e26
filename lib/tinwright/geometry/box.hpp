#ifndef TINWRIGHT_GEOMETRY_BOX_HPP
#define TINWRIGHT_GEOMETRY_BOX_HPP

#include <algorithm>
#include <limits>

namespace tinwright {

/// Axis-parallel box in units of the coordinate reference system; empty until something is added.
struct Box {
    double x_min = std::numeric_limits<double>::infinity();
    double y_min = std::numeric_limits<double>::infinity();
    double x_max = -std::numeric_limits<double>::infinity();
    double y_max = -std::numeric_limits<double>::infinity();

    void add(double x, double y) {
        // Adding zero makes a negative zero positive, so that bounds do not depend on which zero came first.
        x_min = std::min(x_min, x + 0.0);
        y_min = std::min(y_min, y + 0.0);
        x_max = std::max(x_max, x + 0.0);
        y_max = std::max(y_max, y + 0.0);
    }
    [[nodiscard]] bool is_empty() const { return !(x_min <= x_max); }
    friend bool operator==(const Box&, const Box&) = default;
};

}  // namespace tinwright

#endif
