#include "tinwright/mesh/mesh_check.hpp"

#include <cstdint>
#include <utility>

namespace tinwright {
namespace {

constexpr std::uint32_t kKnownMarks = 0xF;

std::string name_of(VertexId v) {
    return v == kGhostVertex ? std::string("the ghost vertex") : "vertex " + std::to_string(v.value);
}
std::string name_of(FaceId f) { return "face " + std::to_string(f.value); }
std::string name_of(HalfEdgeId h) {
    return "half-edge " + std::to_string(corner_of(h)) + " of " + name_of(face_of(h));
}

class MeshAudit {
  public:
    MeshAudit(const TriangleMesh& mesh, const MeshCheckOptions& options) : mesh_(mesh), options_(options) {}

    MeshCheckReport run() {
        const auto slots = static_cast<std::uint32_t>(mesh_.slot_count());
        for (std::uint32_t f = 0; f < slots; ++f) {
            check_corners({f});
            for (unsigned i = 0; i < 3; ++i) {
                check_twin(half_edge({f}, i));
            }
        }
        if (is_walkable_) {
            check_turns(slots);
        }
        return std::move(report_);
    }

  private:
    template <class MakeText>
    void report(int invariant, HalfEdgeId where, const MakeText& make_text) {
        ++report_.count;
        if (report_.violations.size() < options_.limit) {
            report_.violations.push_back({invariant, where, make_text()});
        }
        is_walkable_ = is_walkable_ && invariant > 4;
    }

    void check_corners(FaceId f) {
        const TriangleMesh::Face& face = mesh_.face(f);
        for (unsigned i = 0; i < 3; ++i) {
            const VertexId v = face.vertex[i];
            const HalfEdgeId here = half_edge(f, i);
            if (v == kGhostVertex && i != 2) {
                report(4, here, [&] {
                    return name_of(f) + ": the ghost vertex stands at corner " + std::to_string(i);
                });
            } else if (v != kGhostVertex && v.value >= mesh_.vertex_count()) {
                report(3, here, [&] { return name_of(f) + ": there is no " + name_of(v); });
            }
            if (v == face.vertex[next_corner(i)]) {
                report(3, here, [&] { return name_of(f) + ": " + name_of(v) + " is a corner twice"; });
            }
        }
        if ((face.marks & ~kKnownMarks) != 0) {
            report(6, half_edge(f, 0),
                   [&] { return name_of(f) + ": unknown marks " + std::to_string(face.marks); });
        }
        if (face.scratch != 0) {
            report(6, half_edge(f, 0), [&] { return name_of(f) + ": scratch is not cleared"; });
        }
    }

    [[nodiscard]] bool is_half_edge(HalfEdgeId h) const {
        return corner_of(h) < 3 && face_of(h).value < mesh_.slot_count();
    }

    void check_twin(HalfEdgeId h) {
        const HalfEdgeId t = mesh_.twin(h);
        if (!is_half_edge(t)) {
            report(1, h,
                   [&] { return name_of(h) + ": its twin " + std::to_string(t.value) + " is no half-edge"; });
            return;
        }
        if (mesh_.twin(t) != h) {
            report(1, h, [&] { return name_of(h) + ": the twin of its twin is another half-edge"; });
            return;
        }
        if (face_of(t) == face_of(h)) {
            report(1, h, [&] { return name_of(h) + ": its twin belongs to the same face"; });
            return;
        }
        if (mesh_.origin(t) != mesh_.destination(h) || mesh_.destination(t) != mesh_.origin(h)) {
            report(2, h, [&] { return name_of(h) + ": its twin, " + name_of(t) + ", has other ends"; });
        }
        if (mesh_.is_constrained(h) != mesh_.is_constrained(t) && h < t) {
            report(5, h, [&] { return name_of(h) + ": constrained in one of its two faces only"; });
        }
    }

    /// Follows every turn around every vertex once: the half-edges that leave it, counter-clockwise.
    void check_turns(std::uint32_t slots) {
        constexpr std::uint32_t kNever = 0;
        std::vector<bool> is_seen(4 * std::size_t{slots}, false);
        std::vector<std::uint32_t> turns(mesh_.vertex_count(), 0);
        std::vector<std::uint32_t> met_in_turn(mesh_.vertex_count(), kNever);
        std::uint32_t turn = kNever;
        for (std::uint32_t id = 0; id < 4 * slots; ++id) {
            const HalfEdgeId first{id};
            if (corner_of(first) == 3 || is_seen[id] || mesh_.origin(first) == kGhostVertex) {
                continue;
            }
            const VertexId center = mesh_.origin(first);
            ++turn;
            HalfEdgeId h = first;
            do {
                is_seen[h.value] = true;
                const VertexId end = mesh_.destination(h);
                if (end != kGhostVertex && std::exchange(met_in_turn[end.value], turn) == turn) {
                    report(7, h, [&] {
                        return name_of(center) + " has two edges to " + name_of(end) + " in one turn";
                    });
                }
                h = mesh_.twin(previous(h));
            } while (h != first);
            if (++turns[center.value] == options_.turns + 1 && options_.turns != 0) {
                report(8, first, [&] {
                    return name_of(center) + " has more than " + std::to_string(options_.turns) +
                           " turn(s) of faces around it";
                });
            }
        }
    }

    const TriangleMesh& mesh_;
    const MeshCheckOptions& options_;
    MeshCheckReport report_;
    bool is_walkable_ = true;
};

}  // namespace

MeshCheckReport check_mesh(const TriangleMesh& mesh, const MeshCheckOptions& options) {
    return MeshAudit(mesh, options).run();
}

}  // namespace tinwright
