#include "tinwright/water/bank_outlets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace tinwright {

namespace {

class OutletFinder {
  public:
    explicit OutletFinder(const WaterNetwork& network) : network_(network) {
        for (std::uint32_t line = 0; line < network.prepared.size(); ++line) {
            if (network.prepared[line].role == LineRole::River) {
                add_steps(line);
            }
        }
        std::sort(steps_.begin(), steps_.end());
        std::sort(sources_.begin(), sources_.end());
    }

    std::vector<std::uint32_t> find() const {
        std::vector<std::uint32_t> outlets;
        for (const WaterRun& run : network_.runs) {
            if (!run.is_between_banks && run.from >= network_.first_section &&
                run.from < network_.first_vertex) {
                outlets.push_back(run.from);
            }
        }
        for (const Step& step : steps_) {
            if (std::binary_search(sources_.begin(), sources_.end(), step.to)) {
                continue;  // goes on
            }
            if (const auto end = nearest_end(step.bank, step.to); end && comes_nearer(step, *end)) {
                outlets.push_back(network_.banks[step.bank].first_node + *end);
            }
        }
        return outlets;
    }

  private:
    /// A piece of a river between banks.
    struct Step {
        std::uint32_t to;
        std::uint32_t from;
        std::uint32_t bank;
        friend auto operator<=>(const Step&, const Step&) = default;
    };

    void add_steps(std::uint32_t line) {
        const auto chain = network_.chain(line);
        for (std::size_t i = 1; i < chain.size(); ++i) {
            const std::uint32_t bank = network_.bank_around(line, chain[i - 1], chain[i]);
            if (bank != kNoNode) {
                steps_.push_back({chain[i], chain[i - 1], bank});
            }
            sources_.push_back(chain[i - 1]);
        }
    }

    [[nodiscard]] double distance(std::uint32_t bank, std::uint32_t section, std::uint32_t vertex) const {
        const Point2 middle = network_.banks[bank].network.sections[section].middle;
        return std::hypot(middle.x - network_.key(vertex).x, middle.y - network_.key(vertex).y);
    }

    [[nodiscard]] std::optional<std::uint32_t> nearest_end(std::uint32_t bank, std::uint32_t vertex) const {
        double least = std::numeric_limits<double>::infinity();
        std::optional<std::uint32_t> nearest;
        for (const std::uint32_t end : network_.banks[bank].network.ends) {
            if (const double away = distance(bank, end, vertex); away < least) {
                least = away;
                nearest = end;
            }
        }
        return nearest;
    }

    /// Whether rivers come to the end of a step, between the same banks, from farther away from an end.
    [[nodiscard]] bool comes_nearer(const Step& last, std::uint32_t end) const {
        const double far =
            distance(last.bank, end, last.to) + network_.banks[last.bank].network.sections[end].width;
        std::set<std::uint32_t> seen{last.to, last.from};
        std::vector<std::uint32_t> todo{last.from};
        while (!todo.empty()) {
            const std::uint32_t vertex = todo.back();
            todo.pop_back();
            if (distance(last.bank, end, vertex) >= far) {
                return true;
            }
            for (auto step = std::lower_bound(steps_.begin(), steps_.end(), Step{vertex, 0, 0});
                 step != steps_.end() && step->to == vertex; ++step) {
                if (step->bank == last.bank && seen.insert(step->from).second) {
                    todo.push_back(step->from);
                }
            }
        }
        return false;
    }

    const WaterNetwork& network_;
    std::vector<Step> steps_;             // by their lower ends
    std::vector<std::uint32_t> sources_;  // vertices that rivers lead on from, ascending
};

}  // namespace

std::vector<std::uint32_t> find_bank_outlets(const WaterNetwork& network) {
    return OutletFinder(network).find();
}

}  // namespace tinwright
