#include "tinwright/water/reaches.hpp"

#include <algorithm>
#include <cmath>

namespace tinwright {

namespace {

class ReachMaker {
  public:
    ReachMaker(const WaterNetwork& network, const WaterFlow& flow, std::span<const double> levels,
               std::span<const double> level_of)
        : network_(network), flow_(flow), levels_(levels), level_of_(level_of) {}

    std::vector<Reach> make() {
        for (std::uint32_t r = 0; r < network_.runs.size(); ++r) {
            add(r);
        }
        link();
        set_orders();
        return std::move(reaches_);
    }

  private:
    void add(std::uint32_t r) {
        const WaterRun& run = network_.runs[r];
        Reach reach;
        reach.line = network_.lines[run.line];
        reach.is_reversed = !run.is_between_banks && flow_.is_reversed[r];
        reach.is_between_banks = run.is_between_banks;
        reach.from = flow_.first_of[flow_.upper_end(network_, r)];
        reach.to = flow_.first_of[flow_.lower_end(network_, r)];
        run.is_between_banks ? add_middle(r, reach) : add_river(r, reach);
        for (std::size_t i = 1; i < reach.points.size(); ++i) {
            const Point3& p = reach.points[i - 1];
            const Point3& q = reach.points[i];
            reach.length += network_.ground.length({p.x, p.y}, {q.x, q.y});
        }
        reaches_.push_back(std::move(reach));
    }

    void add_river(std::uint32_t r, Reach& reach) const {
        for (const std::uint32_t v : flow_.stops(network_, r)) {
            const Point2 at = network_.lattice.position(network_.key(v));
            reach.points.push_back({at.x, at.y, level_of_[v]});
        }
    }

    /// The middle between banks falls evenly from section to section.
    void add_middle(std::uint32_t r, Reach& reach) const {
        const WaterRun& run = network_.runs[r];
        for (std::size_t i = 0; i < run.paths.size(); ++i) {
            const std::vector<Point2>& path = run.paths[i];
            std::vector<double> way(path.size(), 0);
            for (std::size_t k = 1; k < path.size(); ++k) {
                way[k] = way[k - 1] + std::hypot(path[k].x - path[k - 1].x, path[k].y - path[k - 1].y);
            }
            const double z_a = levels_[run.stops[i]];
            const double z_b = levels_[run.stops[i + 1]];
            for (std::size_t k = i == 0 ? 0 : 1; k < path.size(); ++k) {
                const double part = way.back() > 0 ? way[k] / way.back() : 1;
                // Paths lead over places between the lattice's.
                const double quantum = network_.lattice.quantum();
                const Point2 origin = network_.lattice.position({0, 0});
                reach.points.push_back({origin.x + path[k].x * quantum, origin.y + path[k].y * quantum,
                                        part == 1 ? z_b : z_a + part * (z_b - z_a)});
            }
        }
        if (flow_.is_reversed[r]) {
            std::reverse(reach.points.begin(), reach.points.end());
        }
    }

    /// Which reach goes on where one ends: of the same line, if there is one, or the first.
    void link() {
        std::vector<std::uint32_t> by_start(reaches_.size());
        for (std::uint32_t r = 0; r < reaches_.size(); ++r) {
            by_start[r] = r;
        }
        const auto before = [&](std::uint32_t a, std::uint32_t b) {
            return reaches_[a].from < reaches_[b].from;
        };
        std::stable_sort(by_start.begin(), by_start.end(), before);
        for (Reach& reach : reaches_) {
            auto next = std::lower_bound(
                by_start.begin(), by_start.end(), reach.to,
                [&](std::uint32_t r, std::uint32_t place) { return reaches_[r].from < place; });
            for (; next != by_start.end() && reaches_[*next].from == reach.to; ++next) {
                const Reach& candidate = reaches_[*next];
                if (&candidate == &reach || candidate.to == reach.to) {
                    continue;
                }
                if (reach.downstream == Reach::kNone || candidate.line == reach.line) {
                    reach.downstream = *next;
                }
                if (candidate.line == reach.line) {
                    break;
                }
            }
        }
    }

    /// Strahler's orders along the links; what runs in circles keeps the order that it has when it comes
    /// round.
    void set_orders() {
        std::vector<std::uint32_t> above(reaches_.size());
        for (const Reach& reach : reaches_) {
            if (reach.downstream != Reach::kNone) {
                ++above[reach.downstream];
            }
        }
        std::vector<std::uint32_t> highest(reaches_.size());
        std::vector<std::uint32_t> how_often(reaches_.size());
        std::vector<std::uint32_t> ready;
        for (std::uint32_t r = 0; r < reaches_.size(); ++r) {
            if (above[r] == 0) {
                ready.push_back(r);
            }
        }
        while (!ready.empty()) {
            const std::uint32_t r = ready.back();
            ready.pop_back();
            Reach& reach = reaches_[r];
            reach.order = highest[r] == 0 ? 1 : highest[r] + (how_often[r] > 1 ? 1 : 0);
            const std::uint32_t next = reach.downstream;
            if (next == Reach::kNone) {
                continue;
            }
            if (reach.order > highest[next]) {
                highest[next] = reach.order;
                how_often[next] = 1;
            } else if (reach.order == highest[next]) {
                ++how_often[next];
            }
            if (--above[next] == 0) {
                ready.push_back(next);
            }
        }
    }

    const WaterNetwork& network_;
    const WaterFlow& flow_;
    std::span<const double> levels_;
    std::span<const double> level_of_;
    std::vector<Reach> reaches_;
};

}  // namespace

std::vector<Reach> make_reaches(const WaterNetwork& network, const WaterFlow& flow,
                                std::span<const double> levels, std::span<const double> level_of) {
    return ReachMaker(network, flow, levels, level_of).make();
}

}  // namespace tinwright
