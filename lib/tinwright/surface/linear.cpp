#include "tinwright/surface/linear.hpp"

#include <algorithm>
#include <array>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

class LinearReader final : public SurfaceReader {
  public:
    LinearReader(const Tin& tin, const QueryLattice& lattice) : tin_(tin), lattice_(lattice) {}

    double elevation(const SurfacePlace& place) override {
        enter(place.face);
        const std::array<double, 3> share = shares(place.at);
        const double z = share[0] * z_[0] + share[1] * z_[1] + share[2] * z_[2];
        return std::clamp(z, lowest_, highest_);
    }

    SurfaceReading read(const SurfacePlace& place) override {
        const double z = elevation(place);
        return {z, gradient_};
    }

    void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) override {
        enter(place.face);
        const std::array<double, 3> share = shares(place.at);
        weights.clear();
        for (unsigned i = 0; i < 3; ++i) {
            weights.push_back({tin_.mesh.vertex(place.face, corner_[i]), share[i]});
        }
    }

  private:
    void enter(FaceId face);
    /// Shares of the corners: exact areas over an exact area, so good for needles too, and 1 and 0 at a
    /// vertex.
    [[nodiscard]] std::array<double, 3> shares(Key2 at) const {
        const auto& [a, b, c] = key_;
        return {doubled_area(at, b, c) / area_, doubled_area(a, at, c) / area_,
                doubled_area(a, b, at) / area_};
    }

    const Tin& tin_;
    const QueryLattice& lattice_;
    FaceId face_{0xFFFFFFFFU};  // the one that the rest is of
    std::array<unsigned, 3> corner_{};
    std::array<Key2, 3> key_{};
    std::array<double, 3> z_{};
    double area_ = 1;
    double lowest_ = 0;
    double highest_ = 0;
    Point2 gradient_{};
};

void LinearReader::enter(FaceId face) {
    if (face == face_) {
        return;
    }
    face_ = face;
    const auto& v = tin_.mesh.face(face).vertex;
    const unsigned first = smallest_corner(tin_.mesh, face);
    corner_ = {first, next_corner(first), previous_corner(first)};
    for (unsigned i = 0; i < 3; ++i) {
        key_[i] = lattice_.scaled(tin_.key(v[corner_[i]]));
        z_[i] = tin_.z[v[corner_[i]].value];
    }
    area_ = doubled_area(key_[0], key_[1], key_[2]);
    lowest_ = std::min({z_[0], z_[1], z_[2]});
    highest_ = std::max({z_[0], z_[1], z_[2]});
    const double ab_z = z_[1] - z_[0];
    const double ac_z = z_[2] - z_[0];
    const double scale = area_ * lattice_.step();
    gradient_ = {(ab_z * (key_[2].y - key_[0].y) - ac_z * (key_[1].y - key_[0].y)) / scale,
                 (ac_z * (key_[1].x - key_[0].x) - ab_z * (key_[2].x - key_[0].x)) / scale};
}

class LinearInterpolator final : public Interpolator {
  public:
    explicit LinearInterpolator(const Tin& tin) : tin_(tin), lattice_(tin) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        return std::make_unique<LinearReader>(tin_, lattice_);
    }

  private:
    const Tin& tin_;
    QueryLattice lattice_;
};

}  // namespace

std::unique_ptr<Interpolator> make_linear(const Tin& tin) {
    return std::make_unique<LinearInterpolator>(tin);
}

}  // namespace tinwright
