#include "tinwright/surface/locator.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {

namespace {

std::vector<FaceId> terrain_faces(const TriangleMesh& mesh) {
    std::vector<FaceId> faces;
    faces.reserve(mesh.slot_count());
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (mesh.is_terrain({f})) {
            faces.push_back({f});
        }
    }
    return faces;
}

BoxTree make_tree(const Tin& tin, const std::vector<FaceId>& faces) {
    std::vector<KeyBox> boxes;
    boxes.reserve(faces.size());
    for (const FaceId f : faces) {
        const auto& v = tin.mesh.face(f).vertex;
        boxes.push_back(KeyBox::of(std::array{tin.key(v[0]), tin.key(v[1]), tin.key(v[2])}));
    }
    return BoxTree(boxes);
}

}  // namespace

/// Boxes are in keys of the TIN, which a place divided by the lattice's scale can be compared with exactly.
struct SurfaceLocator::State {
    explicit State(const Tin& of)
        : tin(of), lattice(of), faces(terrain_faces(of.mesh)), tree(make_tree(of, faces)) {}

    [[nodiscard]] bool holds(FaceId f, Key2 at) const {
        const auto& v = tin.mesh.face(f).vertex;
        const Key2 a = lattice.scaled(tin.key(v[0]));
        const Key2 b = lattice.scaled(tin.key(v[1]));
        const Key2 c = lattice.scaled(tin.key(v[2]));
        return orient2d(a, b, at) >= 0 && orient2d(b, c, at) >= 0 && orient2d(c, a, at) >= 0;
    }

    const Tin& tin;
    QueryLattice lattice;
    std::vector<FaceId> faces;
    BoxTree tree;
};

SurfaceLocator::SurfaceLocator(const Tin& tin) : state_(std::make_unique<State>(tin)) {}
SurfaceLocator::~SurfaceLocator() = default;

std::optional<SurfacePlace> SurfaceLocator::find(Key2 at) const {
    if (!QueryLattice::is_near(at)) {
        return std::nullopt;
    }
    const Key2 key{at.x / state_->lattice.scale(), at.y / state_->lattice.scale()};
    std::optional<FaceId> found;
    state_->tree.visit_meeting(
        {key, key}, [](const KeyBox&) { return false; },
        [&](std::uint32_t item) {
            const FaceId f = state_->faces[item];
            if ((!found || f < *found) && state_->holds(f, at)) {
                found = f;
            }
            return true;
        });
    return found ? std::optional(SurfacePlace{*found, at}) : std::nullopt;
}

std::optional<SurfacePlace> SurfaceLocator::find(Point2 position) const {
    return find(state_->lattice.at(position));
}

const QueryLattice& SurfaceLocator::lattice() const { return state_->lattice; }

}  // namespace tinwright
