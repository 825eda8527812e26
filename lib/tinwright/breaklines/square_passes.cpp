#include "tinwright/breaklines/square_passes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

#include <tbb/parallel_invoke.h>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {
namespace {

constexpr std::size_t kBlock = 1024;  // vertices of a task
constexpr std::size_t kFewVertices = 8;
constexpr std::size_t kFewSegments = 8;

double half_perimeter(const KeyBox& box) { return (box.high.x - box.low.x) + (box.high.y - box.low.y); }

class PassSearch {
  public:
    PassSearch(std::span<const Key2> vertices, std::span<const SegmentKeys> segments)
        : vertices_(vertices), segments_(segments), found_((vertices.size() + kBlock - 1) / kBlock) {}

    std::vector<VertexPass> find_all() {
        std::vector<std::uint32_t> all(segments_.size());
        std::iota(all.begin(), all.end(), 0U);
        if (!vertices_.empty()) {
            hand_down(0, vertices_.size(), all);
        }
        std::vector<VertexPass> passes;
        for (const std::vector<VertexPass>& part : found_) {
            passes.insert(passes.end(), part.begin(), part.end());
        }
        return passes;
    }

  private:
    /// The box of some vertices, and one with their squares in it.
    struct Target {
        KeyBox keys;
        KeyBox squares;
        double size;

        explicit Target(std::span<const Key2> vertices)
            : keys(KeyBox::of(vertices)),
              squares{{keys.low.x - 1, keys.low.y - 1}, {keys.high.x + 1, keys.high.y + 1}},
              size(half_perimeter(squares)) {}

        // A square that a segment passes has its centre in the segment's box.
        [[nodiscard]] bool may_be_passed(const SegmentKeys& ends) const {
            const KeyBox box = KeyBox::of(std::array{ends.a, ends.b});
            return keys.meets(box) &&
                   (half_perimeter(box) < size || side_of_line(ends.a, ends.b, squares) == 0);
        }
    };

    /// From the blocks of one half of the vertices to their own halves, in tasks.
    void hand_down(std::size_t first, std::size_t last, std::vector<std::uint32_t>& candidates) {
        if (candidates.empty()) {
            return;
        }
        if (last - first <= kBlock) {
            search(first, last, candidates, 0);
            return;
        }
        const std::size_t blocks = (last - first + kBlock - 1) / kBlock;
        const std::size_t middle = first + (blocks + 1) / 2 * kBlock;
        const auto take_half = [&](std::size_t from, std::size_t to) {
            std::vector<std::uint32_t> passing;
            append_passing(Target(vertices_.subspan(from, to - from)), candidates, 0, candidates.size(),
                           passing);
            hand_down(from, to, passing);
        };
        tbb::parallel_invoke([&] { take_half(first, middle); }, [&] { take_half(middle, last); });
    }

    /// Appends those of candidates[from, to) that may pass the target's squares; to the same vector perhaps.
    void append_passing(const Target& target, const std::vector<std::uint32_t>& candidates, std::size_t from,
                        std::size_t to, std::vector<std::uint32_t>& passing) const {
        for (std::size_t i = from; i < to; ++i) {
            const std::uint32_t segment = candidates[i];
            if (target.may_be_passed(segments_[segment])) {
                passing.push_back(segment);
            }
        }
    }

    /// Within a block; the segments to be tried are the last of `stack`, from `base` on.
    void search(std::size_t first, std::size_t last, std::vector<std::uint32_t>& stack, std::size_t base) {
        if (last - first <= kFewVertices || stack.size() - base <= kFewSegments) {
            try_all(first, last, std::span(stack).subspan(base));
            return;
        }
        const std::size_t middle = first + find_curve_split(vertices_.subspan(first, last - first)).middle;
        const std::size_t top = stack.size();
        for (const auto& [from, to] : {std::pair{first, middle}, std::pair{middle, last}}) {
            append_passing(Target(vertices_.subspan(from, to - from)), stack, base, top, stack);
            search(from, to, stack, top);
            stack.resize(top);
        }
    }

    void try_all(std::size_t first, std::size_t last, std::span<const std::uint32_t> candidates) {
        std::vector<VertexPass>& found = found_[first / kBlock];
        for (std::size_t v = first; v < last; ++v) {
            const auto vertex = static_cast<std::uint32_t>(v);
            const Key2 key = vertices_[v];
            for (const std::uint32_t s : candidates) {
                const SegmentKeys& ends = segments_[s];
                const SquarePass kind = pass_square(ends.a, ends.b, key);
                if (kind != SquarePass::Apart && ends.a != key && ends.b != key) {
                    found.push_back({vertex, s, kind});
                }
            }
        }
    }

    std::span<const Key2> vertices_;
    std::span<const SegmentKeys> segments_;
    std::vector<std::vector<VertexPass>> found_;  // by block of vertices
};

}  // namespace

std::vector<VertexPass> find_passes(std::span<const Key2> vertices, std::span<const SegmentKeys> segments) {
    return PassSearch(vertices, segments).find_all();
}

}  // namespace tinwright
