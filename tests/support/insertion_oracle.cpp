#include "support/insertion_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/triangulation_oracle.hpp"

namespace tinwright_tests::oracle {

using namespace tinwright;

namespace {

class Brute {
  public:
    Brute(const Tin& tin, Criterion criterion)
        : tin_(tin), mesh_(tin.mesh), criterion_(criterion), corners_(tin.vertex_count()) {
        for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
            for (unsigned i = 0; mesh_.is_terrain({f}) && i < 3; ++i) {
                corners_[mesh_.vertex({f}, i).value].push_back(half_edge({f}, i));
            }
        }
    }

    std::optional<BetterInsertion> find(long double least) {
        const auto n = static_cast<std::uint32_t>(tin_.vertex_count());
        for (std::uint32_t q = 0; q < n; ++q) {
            for (std::uint32_t s = q + 1; s < n; ++s) {
                if (cross({q}, {s}) && worst_ >= least && can_fill(left_) && can_fill(right_)) {
                    return BetterInsertion{{q}, {s}, worst_};
                }
            }
        }
        return std::nullopt;
    }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return tin_.key(v); }
    [[nodiscard]] long double badness_of(VertexId a, VertexId b, VertexId c) const {
        const auto site = [this](VertexId v) { return Site{key(v), tin_.z[v.value]}; };
        return badness(criterion_, site(a), site(b), site(c));
    }
    void cross_face(FaceId f) {
        const auto& [a, b, c] = mesh_.face(f).vertex;
        worst_ = std::max(worst_, badness_of(a, b, c));
    }

    /// Walks from q to s; the polygons on both sides, counter-clockwise, and the worst badness on the way.
    /// False if there is no way, or none to be made because q s is an edge already.
    bool cross(VertexId q, VertexId s) {
        for (const HalfEdgeId at_q : corners_[q.value]) {
            HalfEdgeId h = next(at_q);
            if (!do_cross(key(q), key(s), key(mesh_.origin(h)), key(mesh_.destination(h)))) {
                continue;
            }
            worst_ = -INFINITY;
            right_.assign({q, mesh_.origin(h)});
            left_.assign({q, mesh_.destination(h)});
            cross_face(face_of(h));
            while (true) {
                const HalfEdgeId t = mesh_.twin(h);
                if (mesh_.is_constrained(h) || !mesh_.is_terrain(face_of(t))) {
                    return false;
                }
                cross_face(face_of(t));
                const VertexId apex = mesh_.origin(previous(t));
                if (apex == s) {
                    right_.push_back(s);
                    left_.push_back(s);
                    std::reverse(left_.begin(), left_.end());
                    return true;
                }
                const int side = turn(key(q), key(s), key(apex));
                if (side == 0) {
                    return false;  // an edge may end there, not pass
                }
                (side > 0 ? left_ : right_).push_back(apex);
                h = side > 0 ? next(t) : previous(t);
            }
        }
        return false;
    }

    /// Whether the polygon can be cut into counter-clockwise faces better than the worst one crossed. A
    /// polygon whose faces are all counter-clockwise is covered by them once, cracks or not.
    bool can_fill(const std::vector<VertexId>& polygon) {
        const std::size_t n = polygon.size();
        const long double limit = worst_ - 1e-9L * std::fabs(worst_);
        is_filled_.assign(n * n, false);
        for (std::size_t length = 1; length < n; ++length) {
            for (std::size_t i = 0; i + length < n; ++i) {
                const std::size_t j = i + length;
                bool is_filled = length == 1;
                for (std::size_t k = i + 1; k < j && !is_filled; ++k) {
                    is_filled = is_filled_[i * n + k] && is_filled_[k * n + j] &&
                                turn(key(polygon[i]), key(polygon[k]), key(polygon[j])) > 0 &&
                                badness_of(polygon[i], polygon[k], polygon[j]) < limit;
                }
                is_filled_[i * n + j] = is_filled;
            }
        }
        return is_filled_[n - 1];
    }

    const Tin& tin_;
    const TriangleMesh& mesh_;
    Criterion criterion_;
    std::vector<std::vector<HalfEdgeId>> corners_;  ///< of terrain faces, by vertex
    std::vector<VertexId> left_;
    std::vector<VertexId> right_;
    long double worst_ = 0;
    std::vector<bool> is_filled_;
};

}  // namespace

std::optional<BetterInsertion> find_better_insertion(const Tin& tin, Criterion criterion, long double least) {
    return Brute(tin, criterion).find(least);
}

}  // namespace tinwright_tests::oracle
