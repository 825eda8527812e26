#include "tinwright/water/water_elevations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tinwright/breaklines/line_segments.hpp"
#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/constructions.hpp"

namespace tinwright {

namespace {

/// Rivers with z of their own, to be met by sections.
class OwnRivers {
  public:
    explicit OwnRivers(const WaterNetwork& network) : lines_(lines_of(network)), segments_(lines_) {}

    /// The lowest elevation that a river has on the segment from a to b; NaN where none crosses it.
    [[nodiscard]] double elevation(Key2 a, Key2 b) const {
        double lowest = std::numeric_limits<double>::quiet_NaN();
        segments_.visit_meeting(
            KeyBox::of(std::vector<Key2>{a, b}), [&](const LineSegments::Segment& segment) {
                const Key2 c = segments_.start(segment);
                const Key2 d = segments_.end(segment);
                if (!do_segments_meet(a, b, c, d)) {
                    return;
                }
                const double before = doubled_area(a, b, c);
                const double whole = before - doubled_area(a, b, d);
                const double z =
                    segments_.elevation(segment, whole != 0 ? std::clamp(before / whole, 0.0, 1.0) : 0);
                if (std::isfinite(z) && !(z >= lowest)) {
                    lowest = z;
                }
            });
        return lowest;
    }

  private:
    static std::vector<CleanLine> lines_of(const WaterNetwork& network) {
        std::vector<CleanLine> lines;
        for (std::uint32_t line = 0; line < network.prepared.size(); ++line) {
            if (network.prepared[line].role != LineRole::River ||
                !std::isfinite(network.prepared[line].points.front().z)) {
                continue;
            }
            CleanLine& clean = lines.emplace_back();
            for (const std::uint32_t v : network.chain(line)) {
                clean.keys.push_back(network.key(v));
                clean.z.push_back(network.noded.z[v]);
            }
        }
        return lines;
    }

    std::vector<CleanLine> lines_;
    LineSegments segments_;
};

double measure_section(const WaterNetwork& network, const BankWater& bank, const BankSection& section,
                       const OwnRivers& rivers, NearSamples& samples, double reach) {
    std::vector<std::uint32_t> vertices;
    for (const auto& [ring, number] : section.vertices) {
        vertices.push_back(bank.rings[ring][number]);
    }
    double crossing = std::numeric_limits<double>::quiet_NaN();
    double own = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t next = vertices[(i + 1) % vertices.size()];
        const double z = rivers.elevation(network.key(vertices[i]), network.key(next));
        crossing = std::isfinite(z) && !(z >= crossing) ? z : crossing;
        const double of_bank = network.noded.z[vertices[i]];
        own = std::isfinite(of_bank) && !(of_bank >= own) ? of_bank : own;
    }
    if (std::isfinite(crossing)) {
        return crossing;
    }
    if (std::isfinite(own)) {
        return own;
    }
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < vertices.size() || i == 0; ++i) {
        const std::uint32_t next = vertices[std::min(i + 1, vertices.size() - 1)];
        lowest = std::min(lowest, samples.lowest(network.key(vertices[i]), network.key(next), reach));
    }
    return lowest;
}

}  // namespace

std::vector<double> measure_water(const WaterNetwork& network, std::span<const double> lake_levels,
                                  NearSamples& samples, double river_width) {
    const double reach = river_width / network.lattice.quantum();
    std::vector<double> elevations(lake_levels.begin(), lake_levels.end());
    elevations.reserve(network.node_count);
    const OwnRivers rivers(network);
    for (const BankWater& bank : network.banks) {
        for (const BankSection& section : bank.network.sections) {
            elevations.push_back(measure_section(network, bank, section, rivers, samples, reach));
        }
    }
    for (const std::uint32_t v : network.vertex_of) {
        const double own = network.noded.z[v];
        elevations.push_back(std::isfinite(own) ? own
                                                : samples.lowest(network.key(v), network.key(v), reach));
    }
    return elevations;
}

std::vector<LevelNode> make_level_nodes(const WaterNetwork& network, const WaterFlow& flow,
                                        std::span<const double> elevations) {
    std::vector<double> lengths(network.node_count, 0);
    const auto add_half = [&](std::uint32_t node, double length) { lengths[node] += length / 2; };
    for (const WaterRun& run : network.runs) {
        for (std::size_t i = 1; i < run.stops.size(); ++i) {
            if (run.is_between_banks) {
                double length = 0;
                const std::vector<Point2>& path = run.paths[i - 1];
                for (std::size_t k = 1; k < path.size(); ++k) {
                    length += std::hypot(path[k].x - path[k - 1].x, path[k].y - path[k - 1].y);
                }
                length *= network.lattice.quantum();
                add_half(run.stops[i - 1], length);
                add_half(run.stops[i], length);
            } else {
                const double length = network.distance(run.stops[i - 1], run.stops[i]);
                add_half(network.nearest_node(run.stops[i - 1]), length);
                add_half(network.nearest_node(run.stops[i]), length);
            }
        }
    }
    std::vector<LevelNode> nodes(network.node_count);
    for (std::uint32_t node = 0; node < network.node_count; ++node) {
        // A place of no length has a say too, if nobody else has.
        nodes[node] = {elevations[node], std::max(lengths[node], network.lattice.quantum())};
        if (node < network.first_section) {
            nodes[node].lowest = nodes[node].highest = elevations[node];
        }
    }
    for (std::uint32_t node = 0; node < network.node_count; ++node) {
        LevelNode& first = nodes[flow.first_of[node]];
        if (flow.first_of[node] != node && first.lowest != first.highest) {
            const double weight = first.weight + nodes[node].weight;
            first.target += (nodes[node].target - first.target) * (nodes[node].weight / weight);
            first.weight = weight;
        }
    }
    return nodes;
}

}  // namespace tinwright
