#include "tinwright/delaunay/delaunay.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <tbb/parallel_invoke.h>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/geometry/predicates_internal.hpp"

namespace tinwright {

namespace {

using Face = TriangleMesh::Face;
using Index = std::uint32_t;

constexpr Index kGhost = kGhostVertex.value;
// Ranges below this are not worth a task of their own.
constexpr std::size_t kTaskSize = 1U << 13U;

constexpr Index half_edge_of(Index face, Index corner) { return 4 * face + corner; }

// The vertices of a part that are extreme along the axes; ties are broken along the other axis, so that
// they are corners of the hull (the two ends, when all vertices are collinear).
struct Extremes {
    Index left, right, bottom, top;
};

// Builds the triangulation of a range of the curve from those of its two parts. A part [first, last) owns
// the face slots [2 first, 2 last - 2), all of them in use; joining two parts takes the two slots between.
//
// A ghost face (b, a, ghost) stands for the hull edge a -> b, counter-clockwise: its half-edge 0 is b -> a,
// half-edge 1 leaves a for the ghost vertex, half-edge 2 comes back from there to b.
class Builder {
  public:
    Builder(std::span<const Key2> keys, TriangleMesh::Faces& faces)
        : keys_(keys), key_(keys.data()), face_(faces.data()), hull_face_(keys.size()) {}

    Extremes build(std::size_t first, std::size_t last) {
        const std::size_t count = last - first;
        if (count == 1) {
            const auto v = static_cast<Index>(first);
            return {v, v, v, v};
        }
        if (count == 2) {
            return make_edge(static_cast<Index>(first));
        }
        if (count == 3) {
            const auto a = static_cast<Index>(first);
            const int side = turn(a, a + 1, a + 2);
            if (side != 0) {
                return make_triangle(a, side > 0 ? a + 1 : a + 2, side > 0 ? a + 2 : a + 1);
            }
        }
        const CurveSplit split = find_curve_split(keys_.subspan(first, count));
        const std::size_t middle = first + split.middle;
        Extremes low{};
        Extremes high{};
        if (count >= kTaskSize) {
            tbb::parallel_invoke([&] { low = build(first, middle); }, [&] { high = build(middle, last); });
        } else {
            low = build(first, middle);
            high = build(middle, last);
        }
        const bool by_x = split.axis == 0;
        join(static_cast<Index>(middle), by_x ? low.right : low.top, middle - first == 1,
             by_x ? high.left : high.bottom, last - middle == 1);
        return by_x ? Extremes{low.left, high.right, lower(low.bottom, high.bottom), upper(low.top, high.top)}
                    : Extremes{left(low.left, high.left), right(low.right, high.right), low.bottom, high.top};
    }

  private:
    [[nodiscard]] Index left(Index a, Index b) const { return precedes(key_[a], key_[b]) ? a : b; }
    [[nodiscard]] Index right(Index a, Index b) const { return precedes(key_[a], key_[b]) ? b : a; }
    [[nodiscard]] bool is_lower(Index a, Index b) const {
        return key_[a].y < key_[b].y || (key_[a].y == key_[b].y && key_[a].x < key_[b].x);
    }
    [[nodiscard]] Index lower(Index a, Index b) const { return is_lower(a, b) ? a : b; }
    [[nodiscard]] Index upper(Index a, Index b) const { return is_lower(a, b) ? b : a; }

    [[nodiscard]] Index vertex(Index face, Index corner) const { return face_[face].vertex[corner].value; }
    [[nodiscard]] Index twin(Index h) const { return face_[h >> 2U].twin[h & 3U].value; }
    // Fills a slot for the first time.
    void make_face(Index face, Index a, Index b, Index c) {
        set_face(face, a, b, c);
        face_[face].marks = 0;
        face_[face].scratch = 0;
    }
    void set_face(Index face, Index a, Index b, Index c) { face_[face].vertex = {{{a}, {b}, {c}}}; }
    void set_twin(Index h, Index other) { face_[h >> 2U].twin[h & 3U].value = other; }
    void link(Index h, Index g) {
        set_twin(h, g);
        set_twin(g, h);
    }

    [[nodiscard]] int turn(Index a, Index b, Index c) const {
        const int fast = internal::orient2d_double(key_[a], key_[b], key_[c]);
        return fast != internal::kUnsure ? fast : internal::orient2d_int128(key_[a], key_[b], key_[c]);
    }

    // A vertex seen from the base's left end.
    struct Seen {
        Index vertex = 0;
        internal::LocalKey at;
    };
    [[nodiscard]] Seen see(Index u, Index v) const { return {v, internal::localize(key_[v], key_[u])}; }
    [[nodiscard]] bool is_left_turn(Index u, const Seen& w, const Seen& p) const {
        const int fast = internal::orient2d_local(w.at, p.at);
        return (fast != internal::kUnsure ? fast : turn(u, w.vertex, p.vertex)) > 0;
    }
    // Whether q is inside the circle through u, w, p (counter-clockwise); ties are broken.
    [[nodiscard]] bool is_inside(Index u, const Seen& w, const Seen& p, const Seen& q) const {
        // Putting the origin first instead of last is an odd permutation, undone by swapping p and q.
        const int fast = internal::incircle_local(w.at, q.at, p.at);
        if (fast == 0) {
            return internal::incircle_tie(key_[u], key_[w.vertex], key_[p.vertex], key_[q.vertex]) > 0;
        }
        if (fast == internal::kUnsure) {
            return incircle_perturbed(key_[u], key_[w.vertex], key_[p.vertex], key_[q.vertex]) > 0;
        }
        return fast > 0;
    }

    // Two vertices: the hull goes there and back again.
    Extremes make_edge(Index a) {
        const Index b = a + 1;
        const Index there = 2 * a;
        const Index back = there + 1;
        make_face(there, b, a, kGhost);
        make_face(back, a, b, kGhost);
        link(half_edge_of(there, 0), half_edge_of(back, 0));
        link(half_edge_of(there, 1), half_edge_of(back, 2));
        link(half_edge_of(there, 2), half_edge_of(back, 1));
        hull_face_[a] = there;
        hull_face_[b] = back;
        return {left(a, b), right(a, b), lower(a, b), upper(a, b)};
    }

    // Three vertices of a range, in counter-clockwise order; `a` is the first of the range.
    Extremes make_triangle(Index a, Index b, Index c) {
        const Index inner = 2 * a;
        make_face(inner, a, b, c);
        const std::array<Index, 3> corners{a, b, c};
        for (Index i = 0; i < 3; ++i) {
            const Index ghost = inner + 1 + i;
            const Index next_ghost = inner + 1 + (i + 1) % 3;
            make_face(ghost, corners[(i + 1) % 3], corners[i], kGhost);
            link(half_edge_of(inner, i), half_edge_of(ghost, 0));
            link(half_edge_of(ghost, 2), half_edge_of(next_ghost, 1));
            hull_face_[corners[i]] = ghost;
        }
        return {left(a, left(b, c)), right(a, right(b, c)), lower(a, lower(b, c)), upper(a, upper(b, c))};
    }

    // The ghost faces of the hull edges before and after a ghost face's own.
    [[nodiscard]] Index ghost_before(Index ghost) const { return twin(half_edge_of(ghost, 1)) >> 2U; }
    [[nodiscard]] Index ghost_after(Index ghost) const { return twin(half_edge_of(ghost, 2)) >> 2U; }

    // Joins two parts that a line separates, the left one with vertex u nearest to that line and the right
    // one with w, by the rising bubble of [guibas1985]: the base edge u w moves from the lower common tangent
    // of the hulls to the upper one, taking in the ghost faces on either side of the gap.
    void join(Index middle, Index u, bool u_is_alone, Index w, bool w_is_alone) {
        // Hull edges that leave and enter u and w, by their ghost faces.
        Index u_leaves = u_is_alone ? 0 : hull_face_[u];
        Index u_enters = u_is_alone ? 0 : ghost_before(u_leaves);
        Index w_leaves = w_is_alone ? 0 : hull_face_[w];
        Index w_enters = w_is_alone ? 0 : ghost_before(w_leaves);
        // Down along both hulls until nothing of either lies below the line through u and w.
        for (bool w_moved = true; w_moved;) {
            while (!u_is_alone && turn(u, w, vertex(u_enters, 1)) < 0) {
                u = vertex(u_enters, 1);
                u_leaves = std::exchange(u_enters, ghost_before(u_enters));
            }
            w_moved = false;
            while (!w_is_alone && turn(u, w, vertex(w_leaves, 0)) < 0) {
                w = vertex(w_leaves, 0);
                w_enters = std::exchange(w_leaves, ghost_after(w_leaves));
                w_moved = true;
            }
        }

        // The edge u w with a ghost face on its outer side, and one that rides on the base.
        const Index outer = 2 * middle - 2;
        const Index rider = outer + 1;
        make_face(outer, w, u, kGhost);
        hull_face_[u] = outer;
        Index left_link = half_edge_of(outer, 1);
        Index right_link = half_edge_of(outer, 2);
        if (!u_is_alone) {
            link(half_edge_of(outer, 1), half_edge_of(u_enters, 2));
            left_link = half_edge_of(u_leaves, 1);
        }
        if (!w_is_alone) {
            link(half_edge_of(outer, 2), half_edge_of(w_leaves, 1));
            right_link = half_edge_of(w_enters, 2);
        }
        const Base top = raise({u, w, half_edge_of(outer, 0), left_link, right_link}, u_is_alone, w_is_alone);

        make_face(rider, top.u, top.w, kGhost);
        link(half_edge_of(rider, 0), top.below);
        link(half_edge_of(rider, 1), top.right_link);
        link(half_edge_of(rider, 2), top.left_link);
        hull_face_[top.w] = rider;
    }

    // The base edge: its ends, the half-edge w -> u below it, and the half-edges that lead from the ghost
    // faces above it to its own: u -> ghost on the left, ghost -> w on the right.
    struct Base {
        Index u, w;
        Index below;
        Index left_link, right_link;
    };

    Base raise(Base base, bool u_is_alone, bool w_is_alone) {
        for (;;) {
            // A lone vertex has no edge to offer; nor has a side whose next vertex is not above the base.
            const Index u = base.u;
            const Seen w = see(u, base.w);
            Seen p = see(u, u_is_alone ? base.w : vertex(base.left_link >> 2U, 0));
            Seen s = see(u, w_is_alone ? u : vertex(base.right_link >> 2U, 1));
            const bool has_left = p.vertex != base.w && is_left_turn(u, w, p);
            const bool has_right = s.vertex != u && is_left_turn(u, w, s);
            if (has_left) {
                clear_left(base, w, p);
            } else if (!has_right) {
                return base;
            }
            if (has_right) {
                clear_right(base, w, s);
            }
            if (!has_left || (has_right && is_inside(u, w, p, s))) {
                take_right(base, s.vertex);
            } else {
                take_left(base, p.vertex);
            }
        }
    }

    // Opens the edges from u into the left part that the base's circle shows not to be Delaunay, by flipping
    // them to the ghost vertex; p becomes the end of the first that stays.
    void clear_left(const Base& base, const Seen& w, Seen& p) {
        const Index ghost = base.left_link >> 2U;  // (p, u, ghost)
        for (;;) {
            const HalfEdgeId inner{twin(half_edge_of(ghost, 0))};  // u -> p
            const Index face = face_of(inner).value;
            const Index from_q = previous(inner).value;
            if (vertex(face, from_q & 3U) == kGhost) {
                return;
            }
            const Seen q = see(base.u, vertex(face, from_q & 3U));
            if (!is_inside(base.u, w, p, q)) {
                return;
            }
            const Index beyond_pq = twin(next(inner).value);
            const Index beyond_qu = twin(from_q);
            const Index after = twin(half_edge_of(ghost, 2));
            face_[ghost].vertex[0].value = q.vertex;
            link(half_edge_of(ghost, 0), beyond_qu);
            set_face(face, p.vertex, q.vertex, kGhost);
            link(half_edge_of(face, 0), beyond_pq);
            link(half_edge_of(face, 1), half_edge_of(ghost, 2));
            link(half_edge_of(face, 2), after);
            p = q;
        }
    }

    // The same for the edges from w into the right part.
    void clear_right(const Base& base, const Seen& w, Seen& s) {
        const Index ghost = base.right_link >> 2U;  // (w, s, ghost)
        for (;;) {
            const HalfEdgeId inner{twin(half_edge_of(ghost, 0))};  // s -> w
            const Index face = face_of(inner).value;
            const Index from_q = previous(inner).value;
            if (vertex(face, from_q & 3U) == kGhost) {
                return;
            }
            const Seen q = see(base.u, vertex(face, from_q & 3U));
            if (!is_inside(base.u, w, s, q)) {
                return;
            }
            const Index beyond_wq = twin(next(inner).value);
            const Index beyond_qs = twin(from_q);
            const Index before = twin(half_edge_of(ghost, 1));
            face_[ghost].vertex[1].value = q.vertex;
            link(half_edge_of(ghost, 0), beyond_wq);
            set_face(face, q.vertex, s.vertex, kGhost);
            link(half_edge_of(face, 0), beyond_qs);
            link(half_edge_of(face, 2), half_edge_of(ghost, 1));
            link(half_edge_of(face, 1), before);
            s = q;
        }
    }

    // The ghost face (p, u, ghost) becomes the face (p, u, w); the base rises to p w.
    void take_left(Base& base, Index p) {
        const Index face = base.left_link >> 2U;
        face_[face].vertex[2].value = base.w;
        base.left_link = twin(half_edge_of(face, 2));
        link(half_edge_of(face, 1), base.below);
        base.below = half_edge_of(face, 2);
        base.u = p;
    }

    // The ghost face (w, s, ghost) becomes the face (w, s, u); the base rises to u s.
    void take_right(Base& base, Index s) {
        const Index face = base.right_link >> 2U;
        face_[face].vertex[2].value = base.u;
        base.right_link = twin(half_edge_of(face, 1));
        link(half_edge_of(face, 2), base.below);
        base.below = half_edge_of(face, 1);
        base.w = s;
    }

    std::span<const Key2> keys_;
    const Key2* key_;
    Face* face_;
    // The ghost face of the hull edge that leaves a vertex; kept right for strictly convex corners of the
    // hull of the part the vertex is in.
    std::vector<Index> hull_face_;
};

}  // namespace

TriangleMesh make_delaunay(std::span<const Key2> vertices, std::size_t spare_vertices) {
    TriangleMesh::Faces faces;
    faces.reserve(2 * (vertices.size() + spare_vertices) - 2);
    faces.resize(2 * vertices.size() - 2);
    Builder(vertices, faces).build(0, vertices.size());
    return {vertices.size(), std::move(faces)};
}

}  // namespace tinwright
