#include "tinwright/water/flat_swaps.hpp"

#include <algorithm>
#include <cstdint>
#include <queue>
#include <tuple>
#include <vector>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"

namespace tinwright::internal {

namespace {

/// An edge from a to b that a flip would make one from c, of the flat face, to d.
struct Swap {
    double steepness;  ///< of the new edge, squared, z units over steps
    VertexId c;
    VertexId d;
    VertexId a;
    VertexId b;
    HalfEdgeId h;
    /// The least is the last to be made.
    friend bool operator<(const Swap& s, const Swap& t) {
        return std::tie(s.steepness, t.c, t.d, t.a, t.b) < std::tie(t.steepness, s.c, s.d, s.a, s.b);
    }
};

class Swapper {
  public:
    Swapper(Tin& tin, const FlatRegions& regions) : tin_(tin), regions_(regions) {}

    std::size_t run() {
        for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
            for (unsigned corner = 0; corner < 3 && regions_.is_treated({f}); ++corner) {
                consider(half_edge({f}, corner));
            }
        }
        std::size_t swapped = 0;
        while (!queue_.empty()) {
            const Swap swap = queue_.top();
            queue_.pop();
            if (is_current(swap)) {
                flip_edge(tin_.mesh, swap.h);
                ++swapped;
                consider_around(face_of(swap.h));
                consider_around(face_of(tin_.mesh.twin(swap.h)));
            }
        }
        return swapped;
    }

  private:
    /// Flips move half-edges to other slots.
    [[nodiscard]] bool is_current(const Swap& swap) const {
        const TriangleMesh& mesh = tin_.mesh;
        return mesh.origin(swap.h) == swap.a && mesh.destination(swap.h) == swap.b &&
               mesh.origin(previous(swap.h)) == swap.c && mesh.origin(previous(mesh.twin(swap.h))) == swap.d;
    }

    void consider_around(FaceId changed) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = tin_.mesh.twin(half_edge(changed, corner));
            if (!tin_.mesh.is_ghost(face_of(h)) && regions_.is_treated(face_of(h))) {
                consider(h);
            }
        }
    }

    void consider(HalfEdgeId h) {
        const TriangleMesh& mesh = tin_.mesh;
        if (regions_.kind(h) != FlatEdge::Opening) {
            return;
        }
        const VertexId a = mesh.origin(h);
        const VertexId b = mesh.destination(h);
        const VertexId c = mesh.origin(previous(h));
        const VertexId d = mesh.origin(previous(mesh.twin(h)));
        if (orient2d(tin_.key(d), tin_.key(c), tin_.key(a)) > 0 &&
            orient2d(tin_.key(c), tin_.key(d), tin_.key(b)) > 0) {
            const double rise = tin_.z[d.value] - tin_.z[c.value];
            queue_.push({rise * rise / squared_distance(tin_.key(c), tin_.key(d)), c, d, a, b, h});
        }
    }

    Tin& tin_;
    const FlatRegions& regions_;
    std::priority_queue<Swap> queue_;
};

}  // namespace

std::size_t swap_flat_edges(Tin& tin, const FlatRegions& regions) { return Swapper(tin, regions).run(); }

}  // namespace tinwright::internal
