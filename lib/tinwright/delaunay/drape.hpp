#ifndef TINWRIGHT_DELAUNAY_DRAPE_HPP
#define TINWRIGHT_DELAUNAY_DRAPE_HPP

#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

namespace tinwright {

/// Takes elevations from the Delaunay TIN of samples, on its facets' planes.
class Drape {
  public:
    /// `keys`: two or more, distinct, in curve order; `z`: one a key. Both must outlive this object. Throws
    /// InputError when the keys are collinear. O(n log n), parallel inside the caller's task arena.
    Drape(std::span<const Key2> keys, std::span<const double> z);

    /// Vertices on the convex hull, collinear ones included, counter-clockwise.
    [[nodiscard]] const std::vector<VertexId>& hull() const { return hull_; }

    struct Elevation {
        double z;
        bool is_outside;  ///< outside the hull: z is that of the nearest place on it
    };
    /// Elevation at a key; near the key asked for before, fast. O(sqrt n) at worst for keys far from it.
    [[nodiscard]] Elevation at(Key2 key);

  private:
    [[nodiscard]] double interpolate(FaceId face, Key2 key) const;
    [[nodiscard]] double nearest_on_hull(Key2 key) const;

    std::span<const Key2> keys_;
    std::span<const double> z_;
    TriangleMesh mesh_;
    std::vector<VertexId> hull_;
    HalfEdgeId from_{};
};

}  // namespace tinwright

#endif
