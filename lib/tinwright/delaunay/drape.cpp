#include "tinwright/delaunay/drape.hpp"

#include <algorithm>
#include <limits>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

Drape::Drape(std::span<const Key2> keys, std::span<const double> z)
    : keys_(keys), z_(z), mesh_(make_delaunay(keys)) {
    std::uint32_t ghost = 0;
    while (!mesh_.is_ghost({ghost})) {
        ++ghost;
    }
    // Half-edge 0 of a ghost face runs along the hull, clockwise; half-edge 2 leads to the next ghost face.
    HalfEdgeId h = half_edge({ghost}, 0);
    do {
        hull_.push_back(mesh_.destination(h));
        h = half_edge(face_of(mesh_.twin(previous(h))), 0);
    } while (h != half_edge({ghost}, 0));
    if (hull_.size() == mesh_.slot_count()) {
        throw InputError(
            "lines without z cannot be draped: all samples lie on one line; give the lines' z with z=FIELD "
            "or "
            "z=NUMBER");
    }
    from_ = mesh_.twin(half_edge({ghost}, 0));
}

Drape::Elevation Drape::at(Key2 key) {
    // A walk that crosses any edge with the place beyond it ends in a Delaunay triangulation [devillers2002].
    HalfEdgeId h = from_;
    for (unsigned agreed = 0; agreed < 3;) {
        if (orient2d(keys_[mesh_.origin(h).value], keys_[mesh_.destination(h).value], key) >= 0) {
            h = next(h);
            ++agreed;
            continue;
        }
        const HalfEdgeId across = mesh_.twin(h);
        if (mesh_.is_ghost(face_of(across))) {
            from_ = h;
            return {nearest_on_hull(key), true};
        }
        h = next(across);
        agreed = 1;
    }
    from_ = h;
    return {interpolate(face_of(h), key), false};
}

double Drape::interpolate(FaceId face, Key2 key) const {
    const auto& [a, b, c] = mesh_.face(face).vertex;
    const Key2 p = keys_[a.value];
    const Key2 q = keys_[b.value];
    const Key2 r = keys_[c.value];
    const double whole = doubled_area(p, q, r);
    const double z = z_[a.value];
    return z + (doubled_area(p, key, r) * (z_[b.value] - z) + doubled_area(p, q, key) * (z_[c.value] - z)) /
                   whole;
}

double Drape::nearest_on_hull(Key2 key) const {
    double best = std::numeric_limits<double>::infinity();
    double z = 0;
    for (std::size_t i = 0; i < hull_.size(); ++i) {
        const VertexId a = hull_[i];
        const VertexId b = hull_[(i + 1) % hull_.size()];
        const Key2 p = keys_[a.value];
        const Key2 q = keys_[b.value];
        const double share = std::clamp(inner_product(key, p, q) / squared_distance(p, q), 0.0, 1.0);
        const double dx = key.x - (p.x + share * (q.x - p.x));
        const double dy = key.y - (p.y + share * (q.y - p.y));
        if (dx * dx + dy * dy < best) {
            best = dx * dx + dy * dy;
            z = z_[a.value] + share * (z_[b.value] - z_[a.value]);
        }
    }
    return z;
}

}  // namespace tinwright
