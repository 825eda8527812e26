#ifndef TINWRIGHT_SURFACE_FACE_CIRCLES_HPP
#define TINWRIGHT_SURFACE_FACE_CIRCLES_HPP

#include <cmath>

#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// The circles through the corners of terrain faces, kept to tell quickly which places are inside. The answer
/// is exact all the same: where rounding could change it, `incircle` is asked.
class FaceCircles {
  public:
    /// Both must outlive it. 32 bytes a slot. O(slots), parallel inside the caller's task arena.
    FaceCircles(const Tin& tin, const QueryLattice& lattice);

    /// Whether a place is strictly inside the circle of a face; of one that is no terrain, never.
    [[nodiscard]] bool is_inside(FaceId f, Key2 at) const {
        const Circle& circle = circles_[f.value];
        const double x = at.x - circle.x;
        const double y = at.y - circle.y;
        const double depth = circle.square - (x * x + y * y);
        if (std::abs(depth) > circle.doubt) [[likely]] {  // one branch, as a rule taken
            return depth > 0;
        }
        return is_inside_exactly(f, at);
    }

  private:
    /// `square`: of the radius, less than zero where there is no circle. `doubt`: depths up to which the sign
    /// of the square less the squared distance from the centre may be wrong.
    struct Circle {
        double x;
        double y;
        double square;
        double doubt;
    };

    [[nodiscard]] Circle make_circle(FaceId f) const;
    [[nodiscard]] bool is_inside_exactly(FaceId f, Key2 at) const;

    const Tin& tin_;
    const QueryLattice& lattice_;
    LargeVector<Circle> circles_;
};

}  // namespace tinwright

#endif
