#ifndef TINWRIGHT_OPTIMAL_TRIANGULATE_HPP
#define TINWRIGHT_OPTIMAL_TRIANGULATE_HPP

#include <cstddef>
#include <optional>
#include <span>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/edge_insertion.hpp"

/// The front door: samples and options in, a TIN and a report out.
namespace tinwright {

struct TriangulateOptions {
    DuplicateOptions duplicates;
    DomainRule domain;
    std::optional<double> max_edge;  ///< faces with a longer edge (CRS units) are voids
    /// Makes the TIN optimal after the domain is decided; empty: it stays Delaunay.
    std::optional<OptimizeOptions> optimize;
    int threads = 1;  ///< 0: all processors; the result does not depend on it
    Progress progress;
};

struct TriangulateReport {
    std::size_t samples = 0;
    Box bounds;  ///< of the samples, CRS units
    DuplicateReport duplicates;
    std::size_t faces = 0;          ///< terrain faces
    std::size_t hull_vertices = 0;  ///< vertices on the convex hull, collinear ones included
    DomainReport domain;
    std::optional<OptimizeReport> optimize;
    double triangulate_seconds = 0;  ///< lattice, sort and Delaunay
    double constrain_seconds = 0;    ///< domain
};

struct Triangulated {
    Tin tin;
    TriangulateReport report;
};

/// Builds the TIN of the samples within the domain asked for: the Delaunay one, or the one that is optimal
/// under a criterion.
///
/// `samples`: n >= 3, CRS units, any order. Same set of samples and options, same TIN.
/// Throws InputError: fewer than three distinct locations, all of them collinear, and what
/// `make_sample_vertices` and `optimize` throw; UsageError for options out of range; Cancelled.
/// O(n log n); at most 110 bytes a sample at the peak, the samples themselves not counted. To be optimised
/// costs extra, see `optimize`.
Triangulated triangulate(std::span<const Point3> samples, const TriangulateOptions& options = {});

}  // namespace tinwright

#endif
