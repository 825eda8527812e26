#include "tinwright/surface/sample_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

/// Squared distances closer than this part of themselves are compared exactly; they are rounded five times.
constexpr double kRounding = 0x1p-50;

constexpr KeyBox kEmptyBox{
    {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
    {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}};

/// Squared distance to a box of unscaled keys, never above the true one but for rounding.
double squared_distance_to(const KeyBox& box, Key2 at) {
    const double x = std::max({box.low.x - at.x, 0.0, at.x - box.high.x});
    const double y = std::max({box.low.y - at.y, 0.0, at.y - box.high.y});
    return x * x + y * y;
}

}  // namespace

struct SampleTree::Search {
    Key2 at{};
    Key2 unscaled{};  // of `at`, on the TIN's lattice
    std::optional<VertexId> best;
    double squared = std::numeric_limits<double>::infinity();  // of `best`, in steps of the TIN's lattice
};

SampleTree::SampleTree(const Tin& tin) : tin_(tin), lattice_(tin) {
    are_all_made_ = std::all_of(tin.sample.begin(), tin.sample.end(),
                                [](std::uint32_t sample) { return sample >= Tin::kInserted; });
    const std::size_t n = tin.vertex_count();
    std::vector<KeyBox> boxes((n + kRun - 1) / kRun, kEmptyBox);
    for (std::uint32_t v = 0; v < n; ++v) {
        if (is_given({v})) {
            boxes[v / kRun].add({tin.keys[v], tin.keys[v]});
        }
    }
    while (!boxes.empty()) {
        levels_.push_back(boxes);
        if (boxes.size() == 1) {
            break;
        }
        std::vector<KeyBox> above((boxes.size() + kRun - 1) / kRun, kEmptyBox);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            above[i / kRun].add(boxes[i]);
        }
        boxes = std::move(above);
    }
}

bool SampleTree::is_given(VertexId v) const { return are_all_made_ || tin_.sample[v.value] < Tin::kInserted; }

void SampleTree::visit(std::size_t level, std::size_t node, Search& search) const {
    if (level == 0) {
        const std::size_t end = std::min((node + 1) * kRun, tin_.vertex_count());
        for (auto i = static_cast<std::uint32_t>(node * kRun); i < end; ++i) {
            const double squared = squared_distance(tin_.keys[i], search.unscaled);
            if (squared > search.squared * (1 + kRounding) || !is_given({i})) {
                continue;
            }
            bool is_nearer = !search.best || squared < search.squared * (1 - kRounding);
            if (!is_nearer) {
                const int sign = compare_distances(search.at, lattice_.scaled(tin_.keys[i]), search.at,
                                                   lattice_.scaled(tin_.key(*search.best)));
                is_nearer = sign < 0 || (sign == 0 && i < search.best->value);
            }
            if (is_nearer) {
                search.best = VertexId{i};
                search.squared = squared;
            }
        }
        return;
    }
    // Nearest boxes first: the sooner a near vertex is met, the fewer boxes are opened.
    struct Child {
        double squared;
        std::size_t node;
    };
    std::array<Child, kRun> child;
    std::size_t children = 0;
    const std::vector<KeyBox>& below = levels_[level - 1];
    const std::size_t end = std::min((node + 1) * kRun, below.size());
    for (std::size_t i = node * kRun; i < end; ++i) {
        const double squared = squared_distance_to(below[i], search.unscaled);
        if (squared <= search.squared * (1 + kRounding)) {
            std::size_t place = children++;
            for (; place > 0 && child[place - 1].squared > squared; --place) {
                child[place] = child[place - 1];
            }
            child[place] = {squared, i};
        }
    }
    for (std::size_t i = 0; i < children; ++i) {
        if (child[i].squared <= search.squared * (1 + kRounding)) {
            visit(level - 1, child[i].node, search);
        }
    }
}

std::optional<VertexId> SampleTree::nearest(Key2 at, std::optional<VertexId> near) const {
    Search search{at, {at.x / lattice_.scale(), at.y / lattice_.scale()}, std::nullopt};
    if (levels_.empty()) {
        return std::nullopt;
    }
    if (near && is_given(*near)) {
        search.best = near;
        search.squared = squared_distance(tin_.key(*near), search.unscaled);
    }
    visit(levels_.size() - 1, 0, search);
    return search.best;
}

double SampleTree::distance(Key2 at, VertexId v) const {
    return std::sqrt(squared_distance(lattice_.scaled(tin_.key(v)), at)) * lattice_.step();
}

}  // namespace tinwright
