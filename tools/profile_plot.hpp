#ifndef TINWRIGHT_TOOLS_PROFILE_PLOT_HPP
#define TINWRIGHT_TOOLS_PROFILE_PLOT_HPP

#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"

#include "line_drawing.hpp"

namespace tinwright::tools {

/// The profile of one line.
struct ProfileCurve {
    std::string name;
    /// Its parts: distance and elevation of each point. Between parts there is no surface.
    std::vector<std::vector<Point2>> parts;
};

struct ProfileUnits {
    std::string distance;   ///< empty: unknown
    std::string elevation;  ///< likewise
};

/// Elevation over distance: axes with round numbers, a curve for each line, gaps where there is no surface,
/// and by how much heights are exaggerated, where both units are the same.
LineDrawing draw_profiles(const std::vector<ProfileCurve>& curves, const ProfileUnits& units);

}  // namespace tinwright::tools

#endif
