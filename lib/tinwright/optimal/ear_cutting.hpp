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

/// The measure that every new face has to stay below. Counts measures that cannot be told from it.
class MeasureLimit {
  public:
    explicit MeasureLimit(double limit)
        : limit_(limit), almost_(limit * (1 - kNoise)), just_above_(limit * (1 + kNoise)) {}

    [[nodiscard]] double value() const { return limit_; }
    [[nodiscard]] std::size_t ties() const { return ties_; }
    bool admits(double measure) {
        if (measure < almost_) {
            return true;
        }
        ties_ += measure <= just_above_ ? 1 : 0;
        return measure < limit_;
    }

  private:
    /// Relative error of a measure with room to spare.
    static constexpr double kNoise = 1.0 / (1ULL << 44U);

    double limit_;
    double almost_;
    double just_above_;
    std::size_t ties_ = 0;
};

/// Lets a search look as deep as it wants.
inline constexpr unsigned kNoHorizon = std::numeric_limits<unsigned>::max();

enum class Side : std::uint8_t { Left, Right };

/// The polygon on one side of an edge q s that is being tried: its vertices from q on, less those that ears
/// have cut off, and those ears. The polygon is closed by s, the tip.
template <Side kSide>
class EarStack {
  public:
    using Across = CavityFace::Across;

    struct Mark {
        std::size_t vertices;
        std::size_t ears;
    };

    /// Begins with q and its neighbour in the face to be improved; `edge`: the half-edge between them there.
    void start(VertexId q, VertexId neighbour, HalfEdgeId edge) {
        ring_.clear();
        ears_.clear();
        size_ = 0;
        append(q, {});
        append(neighbour, Across::rim(edge));
    }

    /// Cuts ears at `tip` until one does not turn inwards or is not admitted, or only `kept` vertices are
    /// left. `edge`: the half-edge between the last vertex and the tip. Returns whether `kept` are left.
    template <FaceCriterion C>
    bool cut(const SearchSpace<C>& space, MeasureLimit& limit, VertexId tip, Across edge, std::size_t kept) {
        tip_edge_ = edge;
        while (size_ > kept) {
            const RingVertex& last = ring_[size_ - 1];
            const VertexId before = ring_[size_ - 2].vertex;
            const int turn = space.orient(before, last.vertex, tip);
            if (turn != (kSide == Side::Left ? -1 : 1) ||
                !limit.admits(space.criterion.measure(before, last.vertex, tip))) {
                return false;
            }
            add_ear(before, last, tip);
            --size_;
        }
        return true;
    }

    /// Adds the face of q, its neighbour and the tip, when only those are left.
    void close(VertexId tip) {
        add_ear(ring_[0].vertex, ring_[1], tip);
        size_ = 1;
    }

    /// The tip becomes the last vertex of the polygon.
    void push(VertexId tip) { append(tip, tip_edge_); }

    [[nodiscard]] Mark mark() const { return {size_, ears_.size()}; }
    /// Puts back ears cut since, if nothing was pushed since.
    void restore(Mark mark) {
        size_ = mark.vertices;
        ears_.resize(mark.ears);
    }

    [[nodiscard]] const std::vector<CavityFace>& ears() const { return ears_; }
    /// The side of q s, once only q is left.
    [[nodiscard]] Across closing_edge() const { return tip_edge_; }

  private:
    struct RingVertex {
        VertexId vertex;
        Across edge;  ///< to the vertex before
    };

    void append(VertexId vertex, Across edge) {
        ring_.resize(size_);
        ring_.push_back({vertex, edge});
        ++size_;
    }

    void add_ear(VertexId before, const RingVertex& last, VertexId tip) {
        // Counter-clockwise: on the left the ring runs clockwise around the ears.
        constexpr bool kIsLeft = kSide == Side::Left;
        constexpr unsigned kRingEdge = 0;
        constexpr unsigned kTipEdge = kIsLeft ? 2 : 1;
        constexpr unsigned kNewEdge = kIsLeft ? 1 : 2;
        const auto ear = static_cast<std::uint32_t>(ears_.size());
        CavityFace& face = ears_.emplace_back();
        face.vertex[0] = kIsLeft ? last.vertex : before;
        face.vertex[1] = kIsLeft ? before : last.vertex;
        face.vertex[2] = tip;
        face.across[kRingEdge] = last.edge;
        face.across[kTipEdge] = tip_edge_;
        for (const unsigned edge : {kRingEdge, kTipEdge}) {
            const Across across = face.across[edge];
            if (!across.is_rim()) {
                ears_[across.face()].across[across.edge()] = Across::inner(ear, edge);
            }
        }
        tip_edge_ = Across::inner(ear, kNewEdge);
    }

    std::vector<RingVertex> ring_;  ///< beyond `size_`: what ears have cut off
    std::size_t size_ = 0;
    std::vector<CavityFace> ears_;
    Across tip_edge_;
};

/// An improvement: the faces crossed by an edge q s, and those that take their place.
struct Refill {
    std::vector<FaceId> slots;
    std::vector<CavityFace> faces;

    /// Joins the ears of both sides along q s.
    void join(const EarStack<Side::Left>& left, const EarStack<Side::Right>& right) {
        using Across = CavityFace::Across;
        faces = left.ears();
        const auto shift = static_cast<std::uint32_t>(faces.size());
        const auto shifted = [shift](Across across) {
            return across.is_rim() ? across : Across::inner(across.face() + shift, across.edge());
        };
        for (CavityFace face : right.ears()) {
            for (Across& across : face.across) {
                across = shifted(across);
            }
            faces.push_back(face);
        }
        const Across of_left = left.closing_edge();
        const Across of_right = shifted(right.closing_edge());
        faces[of_left.face()].across[of_left.edge()] = of_right;
        faces[of_right.face()].across[of_right.edge()] = of_left;
    }
};

}  // namespace tinwright::internal

#endif
