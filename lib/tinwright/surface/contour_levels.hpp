#ifndef TINWRIGHT_SURFACE_CONTOUR_LEVELS_HPP
#define TINWRIGHT_SURFACE_CONTOUR_LEVELS_HPP

#include <optional>
#include <vector>

namespace tinwright {

/// Which contours are wanted.
struct ContourRequest {
    std::optional<double> interval = std::nullopt;  ///< levels base + k * interval for all whole k
    double base = 0;
    std::vector<double> levels{};  ///< these too, in any order
    int index_every = 0;  ///< the lines with k a multiple of this are index contours; 0: there are none
};

struct ContourLevel {
    double elevation = 0;
    bool is_index = false;
    friend bool operator==(const ContourLevel&, const ContourLevel&) = default;
};

/// Levels are refused beyond this number.
inline constexpr double kContourLevelLimit = 1e6;

/// The levels that a surface between two elevations reaches, ascending and distinct: those from `z_min` (as
/// something may lie level there) to below `z_max`. A level is the double nearest to the decimal number
/// meant: three steps of 0.1 are 0.3. Throws UsageError for numbers that are not finite, an interval that is
/// not above zero, neither interval nor levels, index lines without an interval, and too many levels.
std::vector<ContourLevel> choose_levels(double z_min, double z_max, const ContourRequest& request);

/// What `choose_levels` checks without knowing the surface.
void check_contours(const ContourRequest& request);

}  // namespace tinwright

#endif
