#include "tinwright/surface/clough_tocher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/cubic_face.hpp"
#include "tinwright/surface/weight_sums.hpp"

namespace tinwright {

namespace {

struct Range {
    double lowest;
    double highest;
};

/// For each vertex the range of its own elevation and those of all that share a face with it. O(slots).
LargeVector<Range> find_ranges(const Tin& tin) {
    LargeVector<Range> ranges(tin.vertex_count());
    for (std::size_t v = 0; v < tin.vertex_count(); ++v) {
        ranges[v] = {tin.z[v], tin.z[v]};
    }
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        const auto& v = tin.mesh.face({f}).vertex;
        const auto [lowest, highest] = std::minmax({tin.z[v[0].value], tin.z[v[1].value], tin.z[v[2].value]});
        for (const VertexId each : v) {
            Range& range = ranges[each.value];
            range = {std::min(range.lowest, lowest), std::max(range.highest, highest)};
        }
    }
    return ranges;
}

/// What readers share.
struct CloughTocherSurface {
    CloughTocherSurface(const Tin& of_tin, const SharpEdges& its_sharp, const CloughTocherOptions& options)
        : tin(of_tin), sharp(its_sharp), lattice(of_tin), gradients(of_tin, its_sharp, options.gradients) {
        if (options.is_limited) {
            ranges = find_ranges(tin);
        }
    }

    const Tin& tin;
    SharpEdges sharp;
    QueryLattice lattice;
    CornerGradients gradients;
    LargeVector<Range> ranges;  // by vertex; empty if not limited
};

/// One face made ready to be read.
class FaceSurface {
  public:
    FaceSurface() = default;
    FaceSurface(const CloughTocherSurface& surface, FaceId face);

    [[nodiscard]] FaceId face() const { return face_; }
    [[nodiscard]] double elevation(Key2 at) const;
    [[nodiscard]] SurfaceReading read(Key2 at) const;
    void find_weights(const CloughTocherSurface& surface, Key2 at, std::vector<VertexWeight>& weights) const;

  private:
    static constexpr double kNeedle = 0x1p-10;  // flatter faces need exact areas for their shares

    [[nodiscard]] Shares shares(Key2 at) const;
    [[nodiscard]] std::array<Point2, 3> edges() const;
    [[nodiscard]] int corner_at(Key2 at) const;
    [[nodiscard]] Point2 gradient_of(const Shares& change) const;
    [[nodiscard]] double bound(double z, const Shares& share) const;

    FaceId face_{0xFFFFFFFFU};
    std::array<HalfEdgeId, 3> corner_{};  // that of the smallest vertex first, wherever the face starts
    std::array<Key2, 3> key_{};
    double area_ = 1;
    double inverse_area_ = 1;
    double step_ = 1;
    std::array<double, 3> z_{};
    std::array<Point2, 3> gradient_{};
    CubicFace cubic_;
    std::array<Range, 3> range_{};
    bool is_needle_ = false;
    bool is_limited_ = false;
};

double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

FaceSurface::FaceSurface(const CloughTocherSurface& surface, FaceId face)
    : face_(face), step_(surface.lattice.step()), is_limited_(!surface.ranges.empty()) {
    const Tin& tin = surface.tin;
    const auto& v = tin.mesh.face(face).vertex;
    unsigned corner = smallest_corner(tin.mesh, face);
    for (unsigned i = 0; i < 3; ++i, corner = next_corner(corner)) {
        corner_[i] = half_edge(face, corner);
        key_[i] = surface.lattice.scaled(tin.key(v[corner]));
        z_[i] = tin.z[v[corner].value];
        gradient_[i] = surface.gradients.at(corner_[i]);
        if (is_limited_) {
            range_[i] = surface.ranges[v[corner].value];
        }
    }
    const std::array<Point2, 3> edge = edges();
    const double first = edge[0].x * edge[2].y;
    const double second = edge[0].y * edge[2].x;
    is_needle_ = !(std::abs(second - first) > kNeedle * (std::abs(first) + std::abs(second)));
    area_ = doubled_area(key_[0], key_[1], key_[2]);
    inverse_area_ = 1 / area_;
    CubicFaceData data{z_, {}};
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned next = i == 2 ? 0 : i + 1;
        const bool is_sharp = surface.sharp.is_sharp(corner_[i]);  // and straight: see CornerGradients
        data.rise[i][0] = is_sharp ? z_[next] - z_[i] : dot(gradient_[i], edge[i]);
        data.rise[next][1] = is_sharp ? z_[i] - z_[next] : -dot(gradient_[next], edge[i]);
    }
    cubic_ = CubicFace(CubicFaceForm(edge), data);
}

/// From corner i to corner i + 1, CRS units.
std::array<Point2, 3> FaceSurface::edges() const {
    std::array<Point2, 3> edge;
    for (unsigned i = 0; i < 3; ++i) {
        const Key2 from = key_[i];
        const Key2 to = key_[i == 2 ? 0 : i + 1];
        edge[i] = {(to.x - from.x) * step_, (to.y - from.y) * step_};
    }
    return edge;
}

Shares FaceSurface::shares(Key2 at) const {
    const auto area = [&](unsigned i, unsigned j) {
        if (is_needle_) {
            return doubled_area(at, key_[i], key_[j]);
        }
        return (key_[i].x - at.x) * (key_[j].y - at.y) - (key_[i].y - at.y) * (key_[j].x - at.x);
    };
    const double b = area(2, 0) * inverse_area_;
    const double c = area(0, 1) * inverse_area_;
    return {1 - b - c, b, c};
}

/// The corner that a place is at, or -1.
int FaceSurface::corner_at(Key2 at) const {
    for (int i = 0; i < 3; ++i) {
        if (at == key_[static_cast<unsigned>(i)]) {
            return i;
        }
    }
    return -1;
}

/// Per CRS unit, of something that changes so with each share.
Point2 FaceSurface::gradient_of(const Shares& change) const {
    const auto& [a, b, c] = key_;
    const double to_b = change[1] - change[0];
    const double to_c = change[2] - change[0];
    const double scale = area_ * step_;
    return {(to_b * (c.y - a.y) - to_c * (b.y - a.y)) / scale,
            (to_c * (b.x - a.x) - to_b * (c.x - a.x)) / scale};
}

double FaceSurface::elevation(Key2 at) const {
    const int corner = corner_at(at);
    if (corner >= 0) {
        return z_[static_cast<unsigned>(corner)];
    }
    const Shares share = shares(at);
    const double z = cubic_.at(share).z;
    return is_limited_ ? bound(z, share) : z;
}

/// `z` within what the corners' ranges come to at a place: linear on each face, so the same on both sides of
/// an edge.
double FaceSurface::bound(double z, const Shares& share) const {
    double lowest = 0;
    double highest = 0;
    for (unsigned i = 0; i < 3; ++i) {
        lowest += share[i] * range_[i].lowest;
        highest += share[i] * range_[i].highest;
    }
    return std::max(lowest, std::min(z, highest));
}

SurfaceReading FaceSurface::read(Key2 at) const {
    const int corner = corner_at(at);
    if (corner >= 0) {
        return {z_[static_cast<unsigned>(corner)], gradient_[static_cast<unsigned>(corner)]};
    }
    const Shares share = shares(at);
    const CubicFace::Value value = cubic_.at(share);
    if (!is_limited_) {
        return {value.z, gradient_of(value.change)};
    }
    const double z = bound(value.z, share);
    if (z > value.z) {
        return {z, gradient_of({range_[0].lowest, range_[1].lowest, range_[2].lowest})};
    }
    if (z < value.z) {
        return {z, gradient_of({range_[0].highest, range_[1].highest, range_[2].highest})};
    }
    return {z, gradient_of(value.change)};
}

void FaceSurface::find_weights(const CloughTocherSurface& surface, Key2 at,
                               std::vector<VertexWeight>& weights) const {
    weights.clear();
    const int corner = corner_at(at);
    if (corner >= 0) {
        weights.push_back({surface.tin.mesh.origin(corner_[static_cast<unsigned>(corner)]), 1});
        return;
    }
    const Shares share = shares(at);
    const std::array<Point2, 3> edge = edges();
    const CubicFaceForm form(edge);
    for (unsigned i = 0; i < 3; ++i) {  // the surface is linear in all that it is made of: one at a time
        CubicFaceData unit;
        unit.z[i] = 1;
        weights.push_back({surface.tin.mesh.origin(corner_[i]), CubicFace(form, unit).at(share).z});
        Point2 of_gradient;
        for (unsigned side = 0; side < 2; ++side) {
            CubicFaceData rise;
            rise.rise[i][side] = 1;
            const double factor = CubicFace(form, rise).at(share).z;
            const Point2 along = side == 0 ? edge[i] : edge[i == 0 ? 2 : i - 1];
            const double sign = side == 0 ? 1 : -1;
            of_gradient.x += sign * factor * along.x;
            of_gradient.y += sign * factor * along.y;
        }
        for (const GradientWeight& each : surface.gradients.weights(corner_[i])) {
            weights.push_back({each.vertex, dot(of_gradient, each.weight)});
        }
    }
    sum_weights(weights);
}

class CloughTocherReader final : public SurfaceReader {
  public:
    explicit CloughTocherReader(const CloughTocherSurface& surface) : surface_(surface), kept_(kKept) {}

    double elevation(const SurfacePlace& place) override { return at(place.face).elevation(place.at); }
    SurfaceReading read(const SurfacePlace& place) override { return at(place.face).read(place.at); }
    void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) override {
        at(place.face).find_weights(surface_, place.at, weights);
    }

  private:
    static constexpr std::size_t kKept = 4096;

    const FaceSurface& at(FaceId face) {
        FaceSurface& kept = kept_[face.value % kKept];
        if (kept.face() != face) {
            kept = FaceSurface(surface_, face);
        }
        return kept;
    }

    const CloughTocherSurface& surface_;
    std::vector<FaceSurface> kept_;
};

class CloughTocherInterpolator final : public Interpolator {
  public:
    CloughTocherInterpolator(const Tin& tin, const SharpEdges& sharp, const CloughTocherOptions& options)
        : surface_(tin, sharp, options) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        return std::make_unique<CloughTocherReader>(surface_);
    }

  private:
    CloughTocherSurface surface_;
};

}  // namespace

std::unique_ptr<Interpolator> make_clough_tocher(const Tin& tin, const SharpEdges& sharp,
                                                 const CloughTocherOptions& options) {
    return std::make_unique<CloughTocherInterpolator>(tin, sharp, options);
}

}  // namespace tinwright
