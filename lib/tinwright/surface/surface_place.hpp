#ifndef TINWRIGHT_SURFACE_SURFACE_PLACE_HPP
#define TINWRIGHT_SURFACE_SURFACE_PLACE_HPP

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

/// Where on a surface it is read.
struct SurfacePlace {
    /// A terrain face whose closure holds the place; the place may lie outside it by half a step where it was
    /// rounded.
    FaceId face{};
    Key2 at{};  ///< in steps of the TIN's `QueryLattice`
};

/// The lattice that places on a TIN's surface are rounded to: the TIN's own, each step divided by a power of
/// two, as fine as predicates allow. Vertices lie on it, and the offsets of vertices from a place are exact.
class QueryLattice {
  public:
    /// O(vertices).
    explicit QueryLattice(const Tin& tin);

    /// Steps to a step of the TIN's lattice: a power of two.
    [[nodiscard]] double scale() const { return scale_; }
    /// Length of a step, CRS units.
    [[nodiscard]] double step() const { return step_; }
    /// A key of the TIN in steps of this lattice; exact.
    [[nodiscard]] Key2 scaled(Key2 key) const { return {key.x * scale_, key.y * scale_}; }
    /// The step nearest to a position in CRS units; that of the TIN's key where the position is a key's, to
    /// the precision of its double. Positions far outside the TIN give keys that predicates do not take:
    /// see `is_near`.
    [[nodiscard]] Key2 at(Point2 position) const;
    /// Whether predicates are exact for this place and the vertices: all places within the TIN's bounds are.
    [[nodiscard]] static bool is_near(Key2 at);
    /// CRS units, correctly rounded for keys of the TIN, to a few units in the last place else.
    [[nodiscard]] Point2 position(Key2 at) const;

  private:
    Lattice lattice_;
    double scale_ = 1;
    double step_ = 1;
};

}  // namespace tinwright

#endif
