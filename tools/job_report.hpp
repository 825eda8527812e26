#ifndef TINWRIGHT_TOOLS_JOB_REPORT_HPP
#define TINWRIGHT_TOOLS_JOB_REPORT_HPP

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/io/write_grid.hpp"

#include "contour_report.hpp"
#include "json_value.hpp"
#include "sample_graph.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

/// A raster that was written.
struct RasterReport {
    GridGeometry grid;
    io::WrittenGrid written;
    bool is_resolution_chosen = false;  ///< by us, not by the user
    std::string method = "linear";
    /// Metres that a cell in the middle measures, of rasters in a geographic system.
    std::optional<Point2> ground_size = std::nullopt;
    std::string unit = {};  ///< of that system
};

/// What a finished command has to tell, once for people and once as JSON (docs/json.md).
struct JobReport {
    std::string command;
    bool tells_slopes = false;  ///< the unit that z is assumed to be in has to be told
    std::string domain;
    std::string duplicate_policy;
    std::optional<RasterReport> raster;
    std::optional<ContourReport> contours;
    std::optional<GraphReport> graph;  ///< instead of a TIN: `surface` has vertices and no faces to tell of
    std::vector<std::pair<std::string, std::string>> details;  ///< label and line, for people only
    std::vector<std::string> outputs;
    std::string output_driver;
    double write_seconds = 0;
};

/// The report's keys for `surface` and what was made of it.
JsonValue make_json(const JobReport& report, const Surface& surface);

/// What only those who ask are told.
struct ReportDetail {
    bool conflicts = false;  ///< the first conflicting duplicates, one by one
    bool times = false;      ///< seconds and memory
};

/// The report for people, as lines: what was read, what came of it, where it went.
std::string report_text(const JobReport& report, const Surface& surface, const ReportDetail& detail);

/// Code, name, unit and WKT; null when unknown.
JsonValue crs_json(const io::Crs& crs);

/// The object `working_crs` of docs/json.md.
JsonValue plane_json(const io::WorkingPlane& plane);

/// Sets the keys `lengths` and `length_unit`.
void set_lengths(JsonValue& json, const GroundMeasures& ground, const io::Crs& plane);

/// Largest resident memory of this process so far, bytes.
std::size_t peak_memory_bytes();

}  // namespace tinwright::tools

#endif
