#ifndef TINWRIGHT_OPTIMAL_EAR_CUTTING_HPP
#define TINWRIGHT_OPTIMAL_EAR_CUTTING_HPP

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/geometry/predicates_internal.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/triangle_mesh.hpp"

/// Filling the two sides of an inserted edge with ears [tan1993, Sec. 3.4.1, 3.4.3]. Reads, never edits, so
/// that a try that fails has nothing to undo. Built without contraction of multiply and add; not installed.
namespace tinwright::internal {

/// What a search for an improvement reads.
template <FaceCriterion C>
struct SearchSpace {
    const TriangleMesh& mesh;
    std::span<const Key2> keys;
    const C& criterion;
    std::span<const double> measures;  ///< one a slot; infinite where there is no terrain

    [[nodiscard]] int orient(VertexId a, VertexId b, VertexId c) const {
        const Key2 origin = keys[c.value];
        return turn(direction(keys[a.value], origin), direction(keys[b.value], origin));
    }
    /// Whether an insertion that improves a face of measure `limit` may cross `h` into the face behind it: a
    /// worse face is already as good as it can be, and no terrain has an infinite measure.
    [[nodiscard]] bool may_cross(HalfEdgeId h, double limit) const {
        return !mesh.is_constrained(h) && measures[face_of(mesh.twin(h)).value] <= limit;
    }
};

/// The measure that every new face has to stay below, by more than the margin for ties: on a plane, where all
/// slopes are equal, nothing is to be changed for the last bits. Counts measures within the margin.
class MeasureLimit {
  public:
    explicit MeasureLimit(double limit)
        : limit_(limit), below_(limit * (1 - kTieMargin)), above_(limit * (1 + kTieMargin)) {}

    [[nodiscard]] double value() const { return limit_; }
    [[nodiscard]] std::size_t ties() const { return ties_; }
    bool admits(double measure) {
        if (measure < below_) {
            return true;
        }
        ties_ += measure <= above_ ? 1 : 0;
        return false;
    }

  private:
    double limit_;
    double below_;
    double above_;
    std::size_t ties_ = 0;
};

/// Lets a search look as deep as it wants.
inline constexpr unsigned kNoHorizon = std::numeric_limits<unsigned>::max();

enum class Side : std::uint8_t { Left, Right };

/// The faces crossed by an edge q s, and those that take their place.
struct Refill {
    std::vector<FaceId> slots;
    std::vector<CavityFace> faces;
};

/// Cuts ears off the two polygons that an edge q s leaves, while the way to s is still being sought. What has
/// been cut stays as it is when a way forks or a tip is given up: chains share their past.
class EarCutter {
  public:
    using Across = CavityFace::Across;

    /// The polygon on one side: its vertices from q to the last, less those that ears have cut off, and those
    /// ears. The tip, a vertex beyond the last, closes it. Copying a chain keeps its state.
    struct Chain {
        std::uint32_t last;
        std::uint32_t size;
        std::uint32_t ears;
        Across tip_edge;  ///< between the last vertex and the tip
    };

    void clear() {
        ring_.clear();
        ears_.clear();
    }

    /// A chain of q and its neighbour in the face to be improved; `edge`: the half-edge between them there.
    Chain start(VertexId q, VertexId neighbour, HalfEdgeId edge) {
        ring_.push_back({q, kNone, {}});
        Chain chain{static_cast<std::uint32_t>(ring_.size() - 1), 1, kNone, Across::rim(edge)};
        push(chain, neighbour);
        return chain;
    }

    /// The tip becomes the last vertex.
    void push(Chain& chain, VertexId tip) {
        ring_.push_back({tip, chain.last, chain.tip_edge});
        chain.last = static_cast<std::uint32_t>(ring_.size() - 1);
        ++chain.size;
    }

    /// Cuts the last vertex off if the ear with the tip turns inwards and is admitted.
    template <Side kSide, FaceCriterion C>
    bool cut_one(const SearchSpace<C>& space, MeasureLimit& limit, Chain& chain, VertexId tip) {
        const RingVertex& last = ring_[chain.last];
        const VertexId before = ring_[last.before].vertex;
        if (space.orient(before, last.vertex, tip) != (kSide == Side::Left ? -1 : 1) ||
            !limit.admits(space.criterion.measure(before, last.vertex, tip))) {
            return false;
        }
        add_ear<kSide>(chain, tip);
        return true;
    }

    /// Cuts ears until one cannot be cut or only `kept` vertices are left. Returns whether `kept` are left.
    template <Side kSide, FaceCriterion C>
    bool cut(const SearchSpace<C>& space, MeasureLimit& limit, Chain& chain, VertexId tip,
             std::uint32_t kept) {
        while (chain.size > kept && cut_one<kSide>(space, limit, chain, tip)) {
        }
        return chain.size == kept;
    }

    /// Cuts the last vertex off, whatever the ear.
    template <Side kSide>
    void add_ear(Chain& chain, VertexId tip) {
        // Counter-clockwise: on the left the ring runs clockwise around the ears.
        constexpr bool kIsLeft = kSide == Side::Left;
        constexpr unsigned kTipEdge = kIsLeft ? 2 : 1;
        constexpr unsigned kNewEdge = kIsLeft ? 1 : 2;
        const RingVertex& last = ring_[chain.last];
        const VertexId before = ring_[last.before].vertex;
        const auto ear = static_cast<std::uint32_t>(ears_.size());
        CavityFace face;
        face.vertex = {kIsLeft ? last.vertex : before, kIsLeft ? before : last.vertex, tip};
        face.across[0] = last.edge;
        face.across[kTipEdge] = chain.tip_edge;
        ears_.push_back({face, chain.ears, 0});
        chain.ears = ear;
        chain.tip_edge = Across::inner(ear, kNewEdge);
        chain.last = last.before;
        --chain.size;
    }

    /// Ears cut since `clear`, those given up included.
    [[nodiscard]] std::size_t ear_count() const { return ears_.size(); }

    /// The ears of two chains of which only q is left, joined along q s.
    void join(const Chain& left, const Chain& right, std::vector<CavityFace>& faces) {
        faces.clear();
        for (const Chain& chain : {left, right}) {
            for (std::uint32_t ear = chain.ears; ear != kNone; ear = ears_[ear].previous) {
                ears_[ear].number = static_cast<std::uint32_t>(faces.size());
                faces.push_back(ears_[ear].face);
            }
        }
        const auto link = [this, &faces](Across inner, std::uint32_t face, unsigned edge) {
            const std::uint32_t other = ears_[inner.face()].number;
            faces[other].across[inner.edge()] = Across::inner(face, edge);
            faces[face].across[edge] = Across::inner(other, inner.edge());
        };
        for (const Chain& chain : {left, right}) {
            for (std::uint32_t ear = chain.ears; ear != kNone; ear = ears_[ear].previous) {
                for (unsigned edge = 0; edge < 3; ++edge) {
                    const Across across = ears_[ear].face.across[edge];
                    if (!across.is_rim() && across.is_known()) {
                        link(across, ears_[ear].number, edge);
                    }
                }
            }
        }
        link(left.tip_edge, ears_[right.tip_edge.face()].number, right.tip_edge.edge());
    }

  private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    struct RingVertex {
        VertexId vertex;
        std::uint32_t before;
        Across edge;  ///< to the vertex before
    };
    struct Ear {
        CavityFace face;  ///< its third edge is known to the ear, or the side of q s, that comes upon it
        std::uint32_t previous;
        std::uint32_t number;  ///< among those joined
    };

    std::vector<RingVertex> ring_;
    std::vector<Ear> ears_;
};

}  // namespace tinwright::internal

#endif
