#include "tinwright/surface/locator.hpp"

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/surface/face_tree.hpp"

namespace tinwright {

struct SurfaceLocator::State {
    explicit State(const Tin& tin) : faces(tin) {}

    [[nodiscard]] bool holds(FaceId f, Key2 at) const {
        const Key2 a = faces.corner(f, 0);
        const Key2 b = faces.corner(f, 1);
        const Key2 c = faces.corner(f, 2);
        return orient2d(a, b, at) >= 0 && orient2d(b, c, at) >= 0 && orient2d(c, a, at) >= 0;
    }

    FaceTree faces;
};

SurfaceLocator::SurfaceLocator(const Tin& tin) : state_(std::make_unique<State>(tin)) {}
SurfaceLocator::~SurfaceLocator() = default;

std::optional<SurfacePlace> SurfaceLocator::find(Key2 at) const {
    if (!QueryLattice::is_near(at)) {
        return std::nullopt;
    }
    std::optional<FaceId> found;
    state_->faces.visit_meeting(
        {at, at}, [](const KeyBox&) { return false; },
        [&](FaceId f) {
            if ((!found || f < *found) && state_->holds(f, at)) {
                found = f;
            }
            return true;
        });
    return found ? std::optional(SurfacePlace{*found, at}) : std::nullopt;
}

std::optional<SurfacePlace> SurfaceLocator::find(Point2 position) const {
    return find(state_->faces.lattice.at(position));
}

const QueryLattice& SurfaceLocator::lattice() const { return state_->faces.lattice; }

}  // namespace tinwright
