#ifndef TINWRIGHT_TOOLS_CONTOUR_REPORT_HPP
#define TINWRIGHT_TOOLS_CONTOUR_REPORT_HPP

#include <cstddef>
#include <optional>
#include <string>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/surface/contouring.hpp"

#include "json_value.hpp"

namespace tinwright::tools {

/// Contours in figures.
struct ContourReport {
    bool is_bands = false;
    std::size_t levels = 0;
    double lowest = 0;  ///< of the levels
    double highest = 0;
    std::size_t lines = 0;   ///< or bands
    std::size_t closed = 0;  ///< lines
    std::size_t polygons = 0;
    std::size_t points = 0;
    double length = 0;  ///< of all lines, on the ground
    std::string method;
    std::optional<TracingReport> tracing;
    double seconds = 0;
};

ContourReport summarize(const Contours& contours, const GroundMeasures& ground, const std::string& method);

/// The object `contours` of docs/json.md.
JsonValue contours_json(const ContourReport& report);

/// "8 levels from 10 to 17, 23 lines (12 closed), 4567 points".
std::string contours_line(const ContourReport& report);
/// "smooth, within 0.05: 0.023 at most"; empty for lines cut from faces.
std::string tracing_line(const ContourReport& report);

}  // namespace tinwright::tools

#endif
