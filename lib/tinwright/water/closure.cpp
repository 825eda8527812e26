#include "tinwright/water/closure.hpp"

#include <algorithm>
#include <limits>

namespace tinwright {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Push and relabel, the highest label first. Gains are pushed from node to node: up a fall as much as one
/// likes, down it what was pushed up before. A node with a loss left is a sink for so much.
///
/// Invariants: 1. `label_` of a node is at most the number of pushes that it takes from there to a loss that
/// is left, or `unreachable()`. 2. Nodes with a gain left and a label below `unreachable()` are in the bucket
/// of their label.
class GainFlow {
  public:
    GainFlow(const FallGraph& graph, std::vector<Gain> gains)
        : graph_(graph),
          gains_(std::move(gains)),
          label_(graph.size()),
          way_starts_(graph.size() + 1, 0),
          next_(graph.size()),
          first_(graph.size(), kNone),
          after_(graph.size(), kNone),
          before_(graph.size(), kNone),
          buckets_(graph.size() + 1) {
        for (std::uint32_t node = 0; node < graph.size(); ++node) {
            way_starts_[node + 1] = way_starts_[node] + graph.uppers(node).size() + graph.lowers(node).size();
        }
        flow_.resize(way_starts_.back(), 0);
        reverse_.resize(way_starts_.back());
        std::vector<std::size_t> used(graph.size());
        for (std::uint32_t node = 0; node < graph.size(); ++node) {
            used[node] = way_starts_[node] + graph.uppers(node).size();
        }
        // Ways of a node: to its uppers, then to its lowers.
        for (std::uint32_t node = 0; node < graph.size(); ++node) {
            std::size_t way = way_starts_[node];
            for (const std::uint32_t upper : graph.uppers(node)) {
                reverse_[way] = used[upper];
                reverse_[used[upper]++] = way++;
            }
        }
    }

    std::vector<bool> run() {
        sweep();
        relabel_all();
        while (true) {
            while (highest_ > 0 && buckets_[highest_].empty()) {
                --highest_;
            }
            if (buckets_[highest_].empty()) {
                break;
            }
            const std::uint32_t node = buckets_[highest_].back();
            buckets_[highest_].pop_back();
            // A node may have got another label since, or have been taken out of another bucket.
            if (label_[node] == highest_ && gains_[node] > 0) {
                discharge(node);
                if (work_ > 8 * (flow_.size() + graph_.size())) {
                    relabel_all();
                }
            }
        }
        relabel_all();
        std::vector<bool> is_inside(graph_.size());
        for (std::uint32_t node = 0; node < graph_.size(); ++node) {
            is_inside[node] = label_[node] == unreachable();
        }
        return is_inside;
    }

  private:
    std::uint32_t unreachable() const { return static_cast<std::uint32_t>(graph_.size()); }

    std::uint32_t end_of(std::uint32_t node, std::size_t way) const {
        const std::size_t i = way - way_starts_[node];
        const auto uppers = graph_.uppers(node);
        return i < uppers.size() ? uppers[i] : graph_.lowers(node)[i - uppers.size()];
    }
    bool is_up(std::uint32_t node, std::size_t way) const {
        return way - way_starts_[node] < graph_.uppers(node).size();
    }
    bool is_open(std::uint32_t node, std::size_t way) const {
        return is_up(node, way) || flow_[reverse_[way]] > 0;
    }

    void activate(std::uint32_t node) {
        if (label_[node] < unreachable()) {
            buckets_[label_[node]].push_back(node);
            highest_ = std::max(highest_, label_[node]);
        }
    }

    /// Pushes gains up once, from the mouth to the springs, first of all to losses next above: most that can
    /// be made up for is then.
    void sweep() {
        for (std::uint32_t node = unreachable(); node-- > 0;) {
            const auto uppers = graph_.uppers(node);
            for (std::size_t i = 0; i < uppers.size() && gains_[node] > 0; ++i) {
                if (gains_[uppers[i]] < 0) {
                    move(node, way_starts_[node] + i, std::min(gains_[node], -gains_[uppers[i]]));
                }
            }
            if (gains_[node] > 0 && !uppers.empty()) {
                move(node, way_starts_[node], gains_[node]);
            }
        }
    }

    void move(std::uint32_t node, std::size_t way, Gain amount) {
        flow_[way] += amount;
        gains_[node] -= amount;
        gains_[end_of(node, way)] += amount;
    }

    /// For a node that is in no list.
    void set_label(std::uint32_t node, std::uint32_t label) {
        label_[node] = label;
        if (label == unreachable()) {
            return;
        }
        top_ = std::max(top_, label);
        before_[node] = kNone;
        after_[node] = first_[label];
        if (first_[label] != kNone) {
            before_[first_[label]] = node;
        }
        first_[label] = node;
    }

    void take_from_list(std::uint32_t node) {
        if (before_[node] == kNone) {
            first_[label_[node]] = after_[node];
        } else {
            after_[before_[node]] = after_[node];
        }
        if (after_[node] != kNone) {
            before_[after_[node]] = before_[node];
        }
    }

    /// Without nodes of one label those above it do not get to any loss: a push goes down by one.
    void give_up_above(std::uint32_t label) {
        for (; top_ > label; --top_) {
            for (std::uint32_t node = first_[top_]; node != kNone; node = after_[node]) {
                label_[node] = unreachable();
            }
            first_[top_] = kNone;
        }
    }

    /// Sets all labels to what they are at most.
    void relabel_all() {
        work_ = 0;
        std::fill(label_.begin(), label_.end(), unreachable());
        std::fill(first_.begin(), first_.end(), kNone);
        top_ = 0;
        std::vector<std::uint32_t> queue;
        for (std::uint32_t node = 0; node < graph_.size(); ++node) {
            if (gains_[node] < 0) {
                set_label(node, 0);
                queue.push_back(node);
            }
        }
        for (std::size_t i = 0; i < queue.size(); ++i) {
            const std::uint32_t node = queue[i];
            for (std::size_t way = way_starts_[node]; way < way_starts_[node + 1]; ++way) {
                const std::uint32_t from = end_of(node, way);
                // The way from there is this one's reverse: up, when this one is down.
                const bool is_way_open = !is_up(node, way) || flow_[way] > 0;
                if (is_way_open && label_[from] == unreachable()) {
                    set_label(from, label_[node] + 1);
                    queue.push_back(from);
                }
            }
        }
        for (auto& bucket : buckets_) {
            bucket.clear();
        }
        highest_ = 0;
        for (std::uint32_t node = 0; node < graph_.size(); ++node) {
            next_[node] = way_starts_[node];
            if (gains_[node] > 0) {
                activate(node);
            }
        }
    }

    void push(std::uint32_t node, std::size_t way) {
        const std::uint32_t end = end_of(node, way);
        Gain amount = gains_[node];
        if (is_up(node, way)) {
            flow_[way] += amount;
        } else {
            Gain& pushed = flow_[reverse_[way]];
            amount = std::min(amount, pushed);
            pushed -= amount;
        }
        const bool was_active = gains_[end] > 0;
        gains_[node] -= amount;
        gains_[end] += amount;
        if (!was_active && gains_[end] > 0) {
            activate(end);
        }
    }

    void relabel(std::uint32_t node) {
        std::uint32_t lowest = unreachable();
        for (std::size_t way = way_starts_[node]; way < way_starts_[node + 1]; ++way) {
            if (is_open(node, way)) {
                lowest = std::min(lowest, label_[end_of(node, way)]);
            }
        }
        work_ += way_starts_[node + 1] - way_starts_[node] + 4;
        next_[node] = way_starts_[node];
        const std::uint32_t old = label_[node];
        take_from_list(node);
        set_label(node, std::min(unreachable(), lowest + 1));
        if (first_[old] == kNone) {
            give_up_above(old);
        }
    }

    /// Pushes on until nothing is left of the node's gain, or no loss can be reached.
    void discharge(std::uint32_t node) {
        while (gains_[node] > 0 && label_[node] < unreachable()) {
            if (next_[node] == way_starts_[node + 1]) {
                relabel(node);
                continue;
            }
            const std::size_t way = next_[node];
            if (label_[end_of(node, way)] + 1 == label_[node] && is_open(node, way)) {
                push(node, way);
                ++work_;
            } else {
                ++next_[node];
            }
        }
    }

    const FallGraph& graph_;
    std::vector<Gain> gains_;
    std::vector<std::uint32_t> label_;
    std::vector<std::size_t> way_starts_;
    std::vector<Gain> flow_;            ///< of each way up: what was pushed
    std::vector<std::size_t> reverse_;  ///< of each way: the same from its other end
    std::vector<std::size_t> next_;     ///< the way to try next
    std::vector<std::uint32_t> first_;  ///< of each label: the first node of its list
    std::vector<std::uint32_t> after_;  ///< of each node: the next of its list
    std::vector<std::uint32_t> before_;
    std::uint32_t top_ = 0;
    std::vector<std::vector<std::uint32_t>> buckets_;  ///< of each label: nodes with a gain left, and others
    std::uint32_t highest_ = 0;
    std::size_t work_ = 0;  ///< since all were relabelled
};

}  // namespace

std::vector<bool> find_largest_closure(const FallGraph& graph, std::vector<Gain> gains) {
    return GainFlow(graph, std::move(gains)).run();
}

}  // namespace tinwright
