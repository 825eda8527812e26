#ifndef TINWRIGHT_OPTIMAL_TRIANGULATE_HPP
#define TINWRIGHT_OPTIMAL_TRIANGULATE_HPP

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/domain.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/delaunay/conforming_delaunay.hpp"
#include "tinwright/delaunay/constrained_tin.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/data_dependent.hpp"
#include "tinwright/optimal/optimize.hpp"

/// The front door: samples, lines and options in, a TIN and a report out.
namespace tinwright {

struct TriangulateOptions {
    DuplicateOptions duplicates;
    NodingOptions noding;  ///< its progress is not used
    /// Samples closer than this to a line (CRS units, >= 0), but not on it, are reported.
    double line_tolerance = 0;
    /// Makes the triangulation conform to the lines by Steiner points; empty: constrained Delaunay.
    std::optional<ConformingOptions> conforming;
    DomainRule domain;
    std::optional<double> max_edge;  ///< faces with a longer edge (`ground.unit`) are voids
    GroundMeasures ground{};         ///< what `max_edge` is measured by
    /// Makes the TIN optimal after the domain is decided; empty: it stays Delaunay.
    std::optional<OptimizeOptions> optimize;
    /// Instead of the former: flips edges to where the elevations ask for less of a crease.
    std::optional<DataDependentOptions> data_dependent;
    /// Called once the domain is decided and its border constrained, before anything is optimised: may flip
    /// unconstrained edges and put vertices into terrain faces, after which the TIN must be constrained
    /// Delaunay again if something is to be optimised. `is_water` is what `find_water_faces` says. Empty:
    /// nothing is done.
    std::function<void(Tin& tin, const std::vector<bool>& is_water)> before_optimum;
    int threads = 1;  ///< 0: all processors; the result does not depend on it
    Progress progress;
};

struct TriangulateReport {
    std::size_t samples = 0;
    Box bounds;  ///< of the samples and lines, CRS units
    DuplicateReport duplicates;
    LinesReport lines;
    /// Whether every edge of every line has an empty disk; true without lines.
    bool is_conforming = true;
    std::optional<ConformingReport> conforming;  ///< only when asked for
    std::size_t faces = 0;                       ///< terrain faces
    std::size_t hull_vertices = 0;               ///< vertices on the convex hull, collinear ones included
    DomainReport domain;
    std::optional<OptimizeReport> optimize;
    std::optional<DataDependentReport> data_dependent;
    double triangulate_seconds = 0;  ///< lattice, sort and Delaunay
    double constrain_seconds = 0;    ///< lines, Steiner points and domain

    /// Whether nothing was flipped or inserted after the Delaunay triangulation.
    [[nodiscard]] bool is_left_delaunay() const { return !optimize && !data_dependent; }
};

struct Triangulated {
    Tin tin;
    TriangulateReport report;
};

/// Builds the TIN of samples and lines within the domain asked for: the Delaunay one, constrained by or
/// conforming to the lines, or the one that is optimal under a criterion, or data-dependent, with the lines
/// in it.
///
/// `samples`: n of them, CRS units, any order. `lines`: any order, with crossings, overlaps and what else
/// `node_lines` sorts out; samples and points of lines have three distinct locations or more. Same set of
/// samples and lines and same options, same TIN. Every line is in the result as a chain of constrained edges
/// (`Tin::traces`). A sample on a line is treated as a duplicate of the line there.
/// Order of work: Delaunay of all vertices, lines, Steiner points, boundary and holes, domain rule,
/// `before_optimum`, optimum, voids. The area outside samples and lines with z of their own is no terrain,
/// whatever is draped there. Throws InputError: too few locations, all of them collinear, and what
/// `make_sample_vertices`, `node_lines` and `optimize` throw; UsageError for options out of range; Cancelled.
/// O(n log n); at most 110 bytes a sample at the peak, the samples themselves not counted. To be optimised
/// costs extra, see `optimize`.
Triangulated triangulate(std::span<const Point3> samples, std::span<const Breakline> lines,
                         const TriangulateOptions& options = {});
Triangulated triangulate(std::span<const Point3> samples, const TriangulateOptions& options = {});

/// The Delaunay triangulation of the samples' distinct locations as it is, of which graphs of neighbours are
/// made (`delaunay/proximity_graphs.hpp`): two locations are enough, and all may lie on one line.
/// Of `options` count what becomes of duplicates, threads and progress. Throws InputError: fewer than two
/// locations, and what `make_sample_vertices` throws; Cancelled. O(n log n).
Triangulated triangulate_locations(std::span<const Point3> samples, const TriangulateOptions& options = {});

}  // namespace tinwright

#endif
