#include "tinwright/surface/stretch_direction.hpp"

#include <array>
#include <cmath>

namespace tinwright {

namespace {

/// Sums over faces of weights times moments of gradients.
class GradientSpread {
  public:
    /// The face of a half-edge, which its corners are counted from: the same bits wherever the face starts.
    void add(const Tin& tin, HalfEdgeId h) {
        const std::array<VertexId, 3> v{tin.mesh.origin(h), tin.mesh.destination(h),
                                        tin.mesh.origin(previous(h))};
        const Key2 a = tin.key(v[0]);
        const Key2 b = tin.key(v[1]);
        const Key2 c = tin.key(v[2]);
        const double bx = b.x - a.x;
        const double by = b.y - a.y;
        const double cx = c.x - a.x;
        const double cy = c.y - a.y;
        const double area = bx * cy - by * cx;
        const double bz = tin.z[v[1].value] - tin.z[v[0].value];
        const double cz = tin.z[v[2].value] - tin.z[v[0].value];
        // Gradients times area: needles, whose gradients mean little, do not divide by next to nothing.
        const Point2 g{bz * cy - cz * by, cz * bx - bz * cx};
        if (area > 0) {
            weight_ += area;
            sum_.x += g.x;
            sum_.y += g.y;
            xx_ += g.x * g.x / area;
            xy_ += g.x * g.y / area;
            yy_ += g.y * g.y / area;
        }
    }

    [[nodiscard]] Point2 direction() const {
        const double xx = xx_ - sum_.x * sum_.x / weight_;
        const double xy = xy_ - sum_.x * sum_.y / weight_;
        const double yy = yy_ - sum_.y * sum_.y / weight_;
        const double half = (xx - yy) / 2;
        const double root = std::hypot(half, xy);
        // The eigenvector of the greater eigenvalue, from whichever row loses no digits.
        const Point2 along = half >= 0 ? Point2{half + root, xy} : Point2{xy, root - half};
        const double length = std::hypot(along.x, along.y);
        return length > 0 && std::isfinite(length) ? Point2{along.x / length, along.y / length}
                                                   : Point2{1, 0};
    }

  private:
    double weight_ = 0;
    Point2 sum_{};
    double xx_ = 0;
    double xy_ = 0;
    double yy_ = 0;
};

}  // namespace

Point2 find_direction_of_change(const Tin& tin, const SharpEdges& sharp, const VertexFan& fan) {
    const TriangleMesh& mesh = tin.mesh;
    GradientSpread spread;
    visit_fan(mesh, fan, [&](HalfEdgeId spoke) {
        spread.add(tin, spoke);
        // Clockwise around the spoke's other end from the one of its faces to the other, which are this
        // fan's.
        constexpr int kMostFaces = 32;  // of a hub
        HalfEdgeId h = next(spoke);
        for (int faces = 0; !is_wall(mesh, sharp, h) && faces < kMostFaces; ++faces) {
            h = next_clockwise(mesh, h);
            if (mesh.destination(h) == mesh.origin(spoke)) {
                break;
            }
            spread.add(tin, h);  // faces at the fan's rim are two fans' and count twice
        }
    });
    return spread.direction();
}

}  // namespace tinwright
