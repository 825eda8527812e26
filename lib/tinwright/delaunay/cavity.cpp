#include "tinwright/delaunay/cavity.hpp"

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

class Walker {
  public:
    Walker(const TriangleMesh& mesh, std::span<const Key2> keys, Cavity& cavity)
        : mesh_(mesh), keys_(keys), cavity_(cavity) {}

    void walk(HalfEdgeId start, VertexId to) {
        from_ = key(mesh_.origin(start));
        to_ = key(to);
        cavity_.begin = mesh_.origin(start);
        const HalfEdgeId h = find_way_out(start, to);
        if (cavity_.edge) {
            return;
        }
        cavity_.slots.push_back(face_of(h));
        cavity_.right_rim.push_back(h);
        cavity_.left_rim.push_back(previous(h));
        cross(next(h));
    }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return keys_[v.value]; }
    [[nodiscard]] int side(VertexId v) const { return orient2d(from_, to_, key(v)); }
    // Whether a vertex on the line through the segment lies on the side of its end.
    [[nodiscard]] bool is_ahead(VertexId v) const { return angle_sign(key(v), from_, to_) > 0; }

    // The half-edge at the origin whose face the segment goes into, or finds the edge that it runs along.
    HalfEdgeId find_way_out(HalfEdgeId start, VertexId to) {
        HalfEdgeId h = start;
        for (;;) {
            const VertexId right = mesh_.destination(h);
            if (right != kGhostVertex) {
                const int side_of_right = right == to ? 0 : side(right);
                if (side_of_right == 0 && is_ahead(right)) {
                    cavity_.end = right;
                    cavity_.edge = h;
                    return h;
                }
                const VertexId left = mesh_.origin(previous(h));
                if (side_of_right < 0 && left != kGhostVertex && side(left) > 0) {
                    return h;
                }
            }
            h = next_around(mesh_, h);
            assert(h != start);
        }
    }

    // `h`: a crossed edge, from its right to its left end, of the face already in the cavity.
    void cross(HalfEdgeId h) {
        for (;;) {
            if (mesh_.is_constrained(h)) {
                cavity_.obstacle = h;
                return;
            }
            const HalfEdgeId t = mesh_.twin(h);
            const VertexId apex = mesh_.origin(previous(t));
            cavity_.slots.push_back(face_of(t));
            const int side_of_apex = side(apex);
            if (side_of_apex >= 0) {
                cavity_.left_rim.push_back(previous(t));
            }
            if (side_of_apex <= 0) {
                cavity_.right_rim.push_back(next(t));
            }
            if (side_of_apex == 0) {
                cavity_.end = apex;
                return;
            }
            h = side_of_apex > 0 ? next(t) : previous(t);
        }
    }

    const TriangleMesh& mesh_;
    std::span<const Key2> keys_;
    Cavity& cavity_;
    Key2 from_{};
    Key2 to_{};
};

/// Faces for one side of the segment after the other.
class Refiller {
  public:
    Refiller(const TriangleMesh& mesh, std::span<const Key2> keys, std::vector<CavityFace>& faces)
        : mesh_(mesh), keys_(keys), faces_(faces) {}

    // `rim`: half-edges from the base's end around to its begin, the polygon on their left. Returns the
    // number of the face on the base, whose edge 0 it is.
    std::uint32_t fill(VertexId base_begin, VertexId base_end, std::span<const HalfEdgeId> rim) {
        rim_ = rim;
        const auto first = static_cast<std::uint32_t>(faces_.size());
        parts_.clear();
        parts_.push_back({base_begin, base_end, 0, rim.size(), 0, 0, true});
        while (!parts_.empty()) {
            const Part part = parts_.back();
            parts_.pop_back();
            fill_part(part);
        }
        return first;
    }

  private:
    // A polygon yet to be filled: base u -> v, then rim_[first, last) from v back to u.
    struct Part {
        VertexId u;
        VertexId v;
        std::size_t first;
        std::size_t last;
        std::uint32_t face;  // the face behind the base, and the base's edge in it
        unsigned edge;
        bool is_outermost;  // behind whose base lies no face of this polygon
    };

    [[nodiscard]] Key2 key(VertexId v) const { return keys_[v.value]; }

    // Adds the face on the part's base, and what is left and right of it.
    void fill_part(const Part& part) {
        const std::size_t at = find_apex(part);
        const VertexId apex = mesh_.origin(rim_[at]);
        const auto number = static_cast<std::uint32_t>(faces_.size());
        CavityFace face;
        face.vertex = {part.u, part.v, apex};
        if (!part.is_outermost) {
            face.across[0] = CavityFace::Across::inner(part.face, part.edge);
            faces_[part.face].across[part.edge] = CavityFace::Across::inner(number, 0);
        }
        faces_.push_back(face);
        add_part({apex, part.v, part.first, at, number, 1, false});
        add_part({part.u, apex, at, part.last, number, 2, false});
    }

    void add_part(const Part& part) {
        if (part.last - part.first == 1) {
            faces_[part.face].across[part.edge] = CavityFace::Across::rim(rim_[part.first]);
        } else {
            parts_.push_back(part);
        }
    }

    // The rim's vertex whose circle with the base is empty of the others, as the half-edge that leaves it. A
    // vertex where a crack ends or forks is there more than once; the one whose angle holds the face is
    // taken.
    [[nodiscard]] std::size_t find_apex(const Part& part) const {
        const Key2 u = key(part.u);
        const Key2 v = key(part.v);
        std::size_t best = part.first + 1;
        bool is_found = false;
        for (std::size_t i = part.first + 1; i < part.last; ++i) {
            const VertexId c = mesh_.origin(rim_[i]);
            const VertexId apex = mesh_.origin(rim_[best]);
            if (is_found && c == apex) {
                if (!holds(best, u)) {
                    best = i;
                }
            } else if ((part.last - part.first == 2 || orient2d(u, v, key(c)) > 0) &&
                       (!is_found || incircle_perturbed(u, v, key(apex), key(c)) > 0)) {
                best = i;
                is_found = true;
            }
        }
        return best;
    }

    // Whether the polygon's angle at the origin of rim_[i] holds the direction to `to`; of its two sides, the
    // one that leaves the vertex belongs to it.
    [[nodiscard]] bool holds(std::size_t i, Key2 to) const {
        const Key2 c = key(mesh_.origin(rim_[i]));
        const VertexId after = mesh_.destination(rim_[i]);
        const VertexId before = mesh_.origin(rim_[i - 1]);
        if (after == before) {
            return true;
        }
        // Whether `to` is in the angle from `from` (included) counter-clockwise to `until`, below half a
        // turn.
        const auto is_between = [&](Key2 from, Key2 until) {
            const int turn = orient2d(c, from, to);
            return (turn > 0 || (turn == 0 && angle_sign(from, c, to) > 0)) && orient2d(c, to, until) > 0;
        };
        const int opening = orient2d(c, key(after), key(before));
        if (opening > 0) {
            return is_between(key(after), key(before));
        }
        if (opening < 0) {
            return !is_between(key(before), key(after));
        }
        const int turn = orient2d(c, key(after), to);
        return turn > 0 || (turn == 0 && angle_sign(key(after), c, to) > 0);
    }

    const TriangleMesh& mesh_;
    std::span<const Key2> keys_;
    std::vector<CavityFace>& faces_;
    std::span<const HalfEdgeId> rim_;
    std::vector<Part> parts_;
};

}  // namespace

void find_cavity(const TriangleMesh& mesh, std::span<const Key2> keys, HalfEdgeId start, VertexId to,
                 Cavity& cavity) {
    cavity.edge.reset();
    cavity.obstacle.reset();
    cavity.slots.clear();
    cavity.left_rim.clear();
    cavity.right_rim.clear();
    Walker(mesh, keys, cavity).walk(start, to);
}

HalfEdgeId retriangulate_cavity(TriangleMesh& mesh, std::span<const Key2> keys, const Cavity& cavity) {
    std::vector<CavityFace> faces;
    faces.reserve(cavity.slots.size());
    Refiller refiller(mesh, keys, faces);
    const std::vector<HalfEdgeId> left(cavity.left_rim.rbegin(), cavity.left_rim.rend());
    const std::uint32_t on_left = refiller.fill(cavity.begin, cavity.end, left);
    const std::uint32_t on_right = refiller.fill(cavity.end, cavity.begin, cavity.right_rim);
    faces[on_left].across[0] = CavityFace::Across::inner(on_right, 0);
    faces[on_right].across[0] = CavityFace::Across::inner(on_left, 0);
    refill_cavity(mesh, cavity.slots, faces);
    return half_edge(cavity.slots[on_left], 0);
}

}  // namespace tinwright
