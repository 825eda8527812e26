#include "tinwright/water/flow.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "tinwright/water/fall_graph.hpp"

namespace tinwright {

namespace {

/// The ends of links by node. Links of a node with itself are left out.
class LinkGraph {
  public:
    LinkGraph(std::size_t node_count, std::span<const FlowLink> links) : starts_(node_count + 1, 0) {
        for (const FlowLink& link : links) {
            if (link.a != link.b) {
                ++starts_[link.a + 1];
                ++starts_[link.b + 1];
            }
        }
        for (std::size_t node = 0; node < node_count; ++node) {
            starts_[node + 1] += starts_[node];
        }
        neighbors_.resize(starts_.back());
        std::vector<std::size_t> ends = starts_;
        for (const FlowLink& link : links) {
            if (link.a != link.b) {
                neighbors_[ends[link.a]++] = link.b;
                neighbors_[ends[link.b]++] = link.a;
            }
        }
    }

    std::size_t size() const { return starts_.size() - 1; }
    /// The other ends of the links of a node.
    std::span<const std::uint32_t> neighbors(std::uint32_t node) const {
        return std::span(neighbors_).subspan(starts_[node], starts_[node + 1] - starts_[node]);
    }
    bool is_end(std::uint32_t node) const { return neighbors(node).size() == 1; }

  private:
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> neighbors_;
};

/// Calls `visit` with the nodes of each connected part of which `is_taken` says no node is taken.
void visit_parts(const LinkGraph& graph, std::vector<bool> is_taken,
                 const std::function<void(std::span<const std::uint32_t>)>& visit) {
    std::vector<std::uint32_t> part;
    for (std::uint32_t start = 0; start < graph.size(); ++start) {
        if (is_taken[start]) {
            continue;
        }
        part.assign(1, start);
        is_taken[start] = true;
        for (std::size_t i = 0; i < part.size(); ++i) {
            for (const std::uint32_t neighbor : graph.neighbors(part[i])) {
                if (!is_taken[neighbor]) {
                    is_taken[neighbor] = true;
                    part.push_back(neighbor);
                }
            }
        }
        visit(part);
    }
}

constexpr std::uint32_t kNotTaken = std::numeric_limits<std::uint32_t>::max();

/// Takes nodes from given ones upward, the lowest next to those taken first.
class Flooding {
  public:
    Flooding(const LinkGraph& graph, std::span<const double> elevations)
        : graph_(graph), elevations_(elevations), order_(graph.size(), kNotTaken) {}

    void add(std::uint32_t node) { queue_.emplace(elevations_[node], node); }

    void run() {
        while (!queue_.empty()) {
            const std::uint32_t node = queue_.top().second;
            queue_.pop();
            if (order_[node] != kNotTaken) {
                continue;
            }
            order_[node] = taken_++;
            for (const std::uint32_t neighbor : graph_.neighbors(node)) {
                if (order_[neighbor] == kNotTaken) {
                    add(neighbor);
                }
            }
        }
    }

    /// How many nodes were taken before each one, or `kNotTaken`.
    const std::vector<std::uint32_t>& order() const { return order_; }

  private:
    using Entry = std::pair<double, std::uint32_t>;

    const LinkGraph& graph_;
    std::span<const double> elevations_;
    std::vector<std::uint32_t> order_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
    std::uint32_t taken_ = 0;
};

}  // namespace

std::vector<std::uint32_t> find_outlets(std::span<const double> elevations, std::span<const FlowLink> links) {
    const LinkGraph graph(elevations.size(), links);
    std::vector<bool> is_alone(graph.size());
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
        is_alone[node] = graph.neighbors(node).empty();
    }
    std::vector<std::uint32_t> outlets;
    visit_parts(graph, is_alone, [&](std::span<const std::uint32_t> part) {
        const std::size_t before = outlets.size();
        std::copy_if(part.begin(), part.end(), std::back_inserter(outlets), [&](std::uint32_t node) {
            return graph.is_end(node) && elevations[node] < elevations[graph.neighbors(node).front()];
        });
        if (outlets.size() == before) {
            outlets.push_back(
                *std::min_element(part.begin(), part.end(), [&](std::uint32_t p, std::uint32_t q) {
                    return std::tuple(elevations[p], !graph.is_end(p), p) <
                           std::tuple(elevations[q], !graph.is_end(q), q);
                }));
        }
    });
    std::sort(outlets.begin(), outlets.end());
    return outlets;
}

std::vector<bool> orient_links(std::span<const double> elevations, std::span<const FlowLink> links,
                               std::span<const std::uint32_t> outlets) {
    const LinkGraph graph(elevations.size(), links);
    Flooding flooding(graph, elevations);
    for (const std::uint32_t outlet : outlets) {
        flooding.add(outlet);
    }
    flooding.run();
    std::vector<bool> is_taken(graph.size());
    for (std::uint32_t node = 0; node < graph.size(); ++node) {
        is_taken[node] = flooding.order()[node] != kNotTaken;
    }
    visit_parts(graph, is_taken, [&](std::span<const std::uint32_t> part) {
        flooding.add(*std::min_element(part.begin(), part.end(), [&](std::uint32_t p, std::uint32_t q) {
            return std::pair(elevations[p], p) < std::pair(elevations[q], q);
        }));
    });
    flooding.run();
    std::vector<bool> runs_back(links.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
        runs_back[i] = flooding.order()[links[i].b] > flooding.order()[links[i].a];
    }
    return runs_back;
}

std::vector<std::uint32_t> find_cycles(std::size_t node_count, std::span<const Fall> falls) {
    const FlowSteps steps = find_flow_steps(FallGraph(node_count, make_distinct(falls)));
    std::vector<std::uint32_t> sizes(steps.count, 0);
    for (const std::uint32_t step : steps.step) {
        ++sizes[step];
    }
    std::vector<std::uint32_t> numbers(steps.count, kNoCycle);
    std::vector<std::uint32_t> cycles(node_count, kNoCycle);
    std::uint32_t count = 0;
    for (std::size_t node = 0; node < node_count; ++node) {
        const std::uint32_t step = steps.step[node];
        if (sizes[step] > 1) {
            if (numbers[step] == kNoCycle) {
                numbers[step] = count++;
            }
            cycles[node] = numbers[step];
        }
    }
    return cycles;
}

}  // namespace tinwright
