#include "support/insertion_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/triangulation_oracle.hpp"

namespace tinwright_tests::oracle {

using namespace tinwright;

Crossings::Crossings(const Tin& tin) : tin_(tin), corners_(tin.vertex_count()) {
    const TriangleMesh& mesh = tin.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; mesh.is_terrain({f}) && i < 3; ++i) {
            corners_[mesh.vertex({f}, i).value].push_back(half_edge({f}, i));
        }
    }
}

std::optional<Corridor> Crossings::find(VertexId q, VertexId s) const {
    const TriangleMesh& mesh = tin_.mesh;
    const auto key = [this](VertexId v) { return tin_.key(v); };
    for (const HalfEdgeId at_q : corners_[q.value]) {
        HalfEdgeId h = next(at_q);
        if (!do_cross(key(q), key(s), key(mesh.origin(h)), key(mesh.destination(h)))) {
            continue;
        }
        Corridor corridor{{face_of(h)}, {}, {q, mesh.destination(h)}, {q, mesh.origin(h)}};
        while (true) {
            const HalfEdgeId t = mesh.twin(h);
            if (mesh.is_constrained(h) || !mesh.is_terrain(face_of(t))) {
                return std::nullopt;
            }
            corridor.crossed.push_back({mesh.origin(h), mesh.destination(h)});
            corridor.faces.push_back(face_of(t));
            const VertexId apex = mesh.origin(previous(t));
            if (apex == s) {
                corridor.right.push_back(s);
                corridor.left.push_back(s);
                std::reverse(corridor.left.begin(), corridor.left.end());
                return corridor;
            }
            const int side = turn(key(q), key(s), key(apex));
            if (side == 0) {
                return std::nullopt;  // an edge may end there, not pass
            }
            (side > 0 ? corridor.left : corridor.right).push_back(apex);
            h = side > 0 ? next(t) : previous(t);
        }
    }
    return std::nullopt;
}

bool can_fill(const Tin& tin, const std::vector<VertexId>& polygon, const IsGood& is_good) {
    const std::size_t n = polygon.size();
    std::vector<bool> is_filled_to(n * n, false);
    for (std::size_t length = 1; length < n; ++length) {
        for (std::size_t i = 0; i + length < n; ++i) {
            const std::size_t j = i + length;
            bool is_filled = length == 1;
            for (std::size_t k = i + 1; k < j && !is_filled; ++k) {
                is_filled = is_filled_to[i * n + k] && is_filled_to[k * n + j] &&
                            turn(tin.key(polygon[i]), tin.key(polygon[k]), tin.key(polygon[j])) > 0 &&
                            is_good(polygon[i], polygon[k], polygon[j]);
            }
            is_filled_to[i * n + j] = is_filled;
        }
    }
    return is_filled_to[n - 1];
}

std::optional<BetterInsertion> find_better_insertion(const Tin& tin, Criterion criterion, long double least) {
    const auto badness_of = [&](VertexId a, VertexId b, VertexId c) {
        const auto site = [&tin](VertexId v) { return Site{tin.key(v), tin.z[v.value]}; };
        return badness(criterion, site(a), site(b), site(c));
    };
    const Crossings crossings(tin);
    const auto n = static_cast<std::uint32_t>(tin.vertex_count());
    for (std::uint32_t q = 0; q < n; ++q) {
        for (std::uint32_t s = q + 1; s < n; ++s) {
            const std::optional<Corridor> corridor = crossings.find({q}, {s});
            if (!corridor) {
                continue;
            }
            long double worst = -INFINITY;
            for (const FaceId f : corridor->faces) {
                const auto& face = tin.mesh.face(f).vertex;
                worst = std::max(worst, badness_of(face[0], face[1], face[2]));
            }
            const long double limit = worst - 1e-9L * std::fabs(worst);
            const auto is_better = [&](VertexId a, VertexId b, VertexId c) {
                return badness_of(a, b, c) < limit;
            };
            if (worst >= least && can_fill(tin, corridor->left, is_better) &&
                can_fill(tin, corridor->right, is_better)) {
                return BetterInsertion{{q}, {s}, worst};
            }
        }
    }
    return std::nullopt;
}

}  // namespace tinwright_tests::oracle
