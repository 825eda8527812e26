#include "tinwright/optimal/edge_flip.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"

namespace tinwright {

namespace {

/// Whether the other diagonal of the quadrilateral around `h` makes a better worst face.
template <FaceCriterion C>
bool is_worth_flipping(const Tin& tin, const C& criterion, HalfEdgeId h) {
    const TriangleMesh& mesh = tin.mesh;
    const HalfEdgeId t = mesh.twin(h);
    if (mesh.is_constrained(h) || !mesh.is_terrain(face_of(h)) || !mesh.is_terrain(face_of(t))) {
        return false;
    }
    const VertexId a = mesh.origin(h);
    const VertexId b = mesh.origin(t);
    const VertexId c = mesh.origin(previous(h));
    const VertexId d = mesh.origin(previous(t));
    if (orient2d(tin.key(d), tin.key(c), tin.key(a)) <= 0 ||
        orient2d(tin.key(c), tin.key(d), tin.key(b)) <= 0) {
        return false;
    }
    return std::max(criterion.measure(d, c, a), criterion.measure(c, d, b)) <
           std::max(criterion.measure(a, b, c), criterion.measure(b, a, d));
}

}  // namespace

std::size_t flip_edges(Tin& tin, Criterion criterion) {
    return visit_criterion(criterion, tin, [&tin](const FaceCriterion auto& code) {
        std::size_t flips = 0;
        std::vector<HalfEdgeId> pending;
        const auto push_edges = [&pending](FaceId f) {
            for (unsigned i = 0; i < 3; ++i) {
                pending.push_back(half_edge(f, i));
            }
        };
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            push_edges({f});
            while (!pending.empty()) {
                const HalfEdgeId h = pending.back();
                pending.pop_back();
                if (is_worth_flipping(tin, code, h)) {
                    flip_edge(tin.mesh, h);
                    ++flips;
                    push_edges(face_of(h));
                    push_edges(face_of(tin.mesh.twin(h)));
                }
            }
        }
        return flips;
    });
}

}  // namespace tinwright
