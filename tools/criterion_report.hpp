#ifndef TINWRIGHT_TOOLS_CRITERION_REPORT_HPP
#define TINWRIGHT_TOOLS_CRITERION_REPORT_HPP

#include <optional>
#include <string>
#include <vector>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/write_tin.hpp"
#include "tinwright/optimal/triangulate.hpp"

#include "json_value.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

/// What a TIN was made best at, and how well that went: of one made just now, or of a file by what it says.
struct CriterionReport {
    std::string name;   ///< "delaunay", "slope", ...; empty: unknown (a foreign TIN)
    std::string norm;   ///< "l2", ...: what edges are measured by; empty for a criterion that measures none
    std::string scope;  ///< empty for a criterion that knows none
    std::string unit;   ///< "degree", "ratio", "metre", ..., `kUnknownLengthUnit`
    std::optional<double> worst;
    std::optional<double> worst_interior;
    std::optional<double> worst_delaunay;  ///< before optimising
    std::optional<double> worst_interior_delaunay;
    std::string proven;                    ///< "theorem", "tested" or "false"
    std::string stopped_by;                ///< "finished", "budget" or "interrupt"
    std::optional<OptimizeReport> counts;  ///< of a file only its numbers of ties, tries and so on
    std::optional<LengthReport> length;    ///< instead, for length
    // Of a data-dependent TIN:
    std::string delaunay_order;          ///< "3", "none"
    std::optional<double> sum;           ///< of creases
    std::optional<double> sum_delaunay;  ///< before flipping
    std::optional<double> flips;
    std::optional<double> refused;
    bool is_from_file = false;

    /// The norm of that name; Euclidean where there is none, or no such.
    [[nodiscard]] Norm edge_norm() const { return find_norm(norm).value_or(Norm()); }
};

/// The unit of lengths in an unknown one.
inline constexpr const char* kUnknownLengthUnit = "CRS unit";

/// What measures are multiplied by to be told: slopes are measured in z units over CRS units, and told as
/// ratios. `z_factor`: CRS units in a unit of z.
double told_factor(Criterion criterion, double z_factor);

/// The report on a TIN made with `options`. `z_factor`: as above.
CriterionReport make_criterion_report(const TriangulationOptions& options, const TriangulateReport& result,
                                      const io::Crs& crs, double z_factor = 1);

/// What a file says. Keys that are missing or unreadable are left empty.
CriterionReport read_criterion_report(const io::TinMetadata& metadata);

/// TINWRIGHT_CRITERION and what belongs to it (docs/formats.md), without what is empty.
io::TinMetadata criterion_metadata(const CriterionReport& report);

/// The object `criterion` of the JSON report.
JsonValue criterion_json(const CriterionReport& report);

/// Lines for people, without indentation; none for a Delaunay TIN.
std::vector<std::string> criterion_lines(const CriterionReport& report);

/// What the user has to be warned of: a result that is not proven because the work was stopped.
std::vector<std::string> criterion_warnings(const TriangulationOptions& options,
                                            const TriangulateReport& result);

/// Whether slopes decide on the TIN, or are told of it.
bool is_about_slopes(const TriangulationOptions& options);

/// A warning where a unit that slopes need is not known, and the other is; else empty. To be said once a run,
/// by commands that tell slopes.
std::string slope_warning(const io::Crs& crs, const std::string& z_unit);

}  // namespace tinwright::tools

#endif
