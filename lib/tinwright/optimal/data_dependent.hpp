#ifndef TINWRIGHT_OPTIMAL_DATA_DEPENDENT_HPP
#define TINWRIGHT_OPTIMAL_DATA_DEPENDENT_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/optimize.hpp"

/// Triangulations that let the elevations choose the edges: as little crease as possible, all together
/// [dyn1990]. What they are and what they are worth: docs/criteria.md.
namespace tinwright {

/// How much of a crease an edge is between the planes of its two faces.
enum class CreaseMeasure : std::uint8_t {
    NormalAngle,  ///< angle between the normals of the faces [dyn1990], radians
    NormalJump    ///< jump of the slope across the edge [dyn1990; quak1990], a ratio
};
/// Names as in `--criterion`.
inline constexpr std::array kCreaseMeasures{
    std::pair{std::string_view("normal-angle"), CreaseMeasure::NormalAngle},
    std::pair{std::string_view("normal-jump"), CreaseMeasure::NormalJump}};

struct DataDependentOptions {
    CreaseMeasure measure = CreaseMeasure::NormalAngle;
    /// A flip is made only if the new edge is a Delaunay edge of this order: some circle through its ends has
    /// at most so many vertices inside [gudmundsson2002]. Of all circles those two are looked at that pass
    /// through an end of the old edge as well. At least 0: then only co-circular vertices get other edges.
    /// Empty: whatever the faces' shape.
    std::optional<int> delaunay_order = 3;
    double z_factor = 1;                        ///< CRS units in a unit of z, which creases count
    std::optional<double> budget_seconds = {};  ///< stop after this time
    Progress progress = {};                     ///< asked often; false stops the work like a budget
};

struct DataDependentReport {
    double sum_before = 0;  ///< over the edges that count
    double sum_after = 0;
    std::size_t edges = 0;  ///< that count: between two terrain faces and not constrained
    std::size_t flips = 0;
    std::size_t refused = 0;  ///< flips that would have lowered the sum and exceeded the order
    StoppedBy stopped_by = StoppedBy::Finished;
    double seconds = 0;
};

/// Of an edge between two terrain faces. `z_factor`: CRS units in a unit of z. The same bits for both
/// half-edges and any order of corners.
double measure_crease(const Tin& tin, HalfEdgeId h, CreaseMeasure measure, double z_factor = 1);

/// Flips edges as long as the sum of creases gets less, the largest gain first, ties by the edge's vertices.
/// Constrained edges stay and do not count: a crease there is meant. So do vertices and the domain.
///
/// A heuristic: no single flip that is allowed lowers the sum any further by more than rounding
/// (kTieMargin), but other triangulations may have a lower sum, and to find the lowest is not feasible.
/// Meant to start from a Delaunay TIN. From the same vertices and edges always the same result. Stopped
/// early, `tin` is a valid triangulation with a sum no greater than at the start. Throws UsageError for a
/// negative order. O((n + flips) log n) in practice; about 150 bytes a vertex of scratch.
DataDependentReport flip_creases(Tin& tin, const DataDependentOptions& options);

}  // namespace tinwright

#endif
