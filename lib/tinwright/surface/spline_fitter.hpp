#ifndef TINWRIGHT_SURFACE_SPLINE_FITTER_HPP
#define TINWRIGHT_SURFACE_SPLINE_FITTER_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/local_spline.hpp"
#include "tinwright/surface/sharp_edges.hpp"
#include "tinwright/surface/smooth.hpp"
#include "tinwright/surface/spline_neighbors.hpp"

namespace tinwright {

/// What a vertex adds to the surface around it: elevations relative to its own, positions relative to it in
/// units of `reach`.
struct VertexSpline {
    static constexpr std::uint8_t kPlane = 0xFF;

    double reach = 0;   ///< distance to its farthest node, steps of the TIN's lattice
    Stretch stretch;    ///< applied to positions before distances are measured
    Point2 gradient{};  ///< of the drift, per unit
    double lowest = 0;  ///< of the nodes' elevations
    double highest = 0;
    std::uint32_t node_count = 0;  ///< the vertex itself is the first
    std::uint8_t kernel = kPlane;  ///< of the options; kPlane: on each face the plane through its corners
};

/// For each vertex that may have a spline a half-edge that starts there, of a terrain face, and kNoHalfEdge
/// for the others: those without terrain faces, and those where parts of the terrain touch in a point only,
/// on different sides of the border. O(slots).
std::vector<HalfEdgeId> find_spline_starts(const TriangleMesh& mesh);

/// What all splines of a surface are fitted from; what it refers to must outlive it.
struct SplineSources {
    const Tin& tin;
    const SharpEdges& sharp;
    const std::vector<HalfEdgeId>& starts;  ///< of `find_spline_starts`
    const SmoothOptions& options;
};

/// Fits splines to vertices, one after the other. On one thread; keeps memory, never what it found.
class SplineFitter {
  public:
    explicit SplineFitter(const SplineSources& sources);

    /// Appends the nodes of a vertex' spline and their coefficients. Vertices without a start, on sharp
    /// edges, or whose neighbours are too few or in a row have none: planes. O(k n^3) for k kernels, n nodes.
    VertexSpline fit(VertexId v, std::vector<VertexId>& nodes, std::vector<double>& coefficients);

    /// A spline fitted once more, to be asked for weights; empty for planes. `nodes`: as `fit` gave them.
    /// Valid until the next call.
    LocalSpline* fit_again(const VertexSpline& spline, std::span<const VertexId> nodes);

  private:
    VertexSpline place_nodes(std::span<const VertexId> ids);
    [[nodiscard]] double expected_error() const;
    [[nodiscard]] bool is_usable(const SmoothOptions::Kernel& kernel) const;
    [[nodiscard]] bool is_plane_better(double handicap) const;

    SplineSources sources_;
    SplineNeighbors neighbors_;
    LocalSpline spline_;
    std::vector<VertexId> ids_;
    std::vector<SplineNode> nodes_;
    std::vector<double> nearness_;     // of the nodes, for what their errors count
    std::vector<double> best_errors_;  // of the nodes, in the best spline so far
};

}  // namespace tinwright

#endif
