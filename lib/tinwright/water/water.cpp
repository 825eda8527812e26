#include "tinwright/water/water.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "tinwright/breaklines/keyed_lines.hpp"
#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/water/area_findings.hpp"
#include "tinwright/water/lake_levels.hpp"
#include "tinwright/water/near_samples.hpp"
#include "tinwright/water/reaches.hpp"
#include "tinwright/water/river_findings.hpp"
#include "tinwright/water/water_elevations.hpp"
#include "tinwright/water/water_flow.hpp"
#include "tinwright/water/water_network.hpp"

namespace tinwright {

namespace {

using Kind = WaterFinding::Kind;

void require_not_negative(const std::optional<double>& value, const char* what) {
    if (value && !(*value >= 0 && std::isfinite(*value))) {
        throw UsageError(std::string(what) + " must be zero or more");
    }
}

void require_positive(const std::optional<double>& value, const char* what) {
    if (value && !(*value > 0 && std::isfinite(*value))) {
        throw UsageError(std::string(what) + " must be above zero");
    }
}

void check_options(const WaterOptions& options, std::span<const Breakline> lines) {
    const LevelRule& rule = options.lake_level;
    if (rule.kind == LevelRule::Kind::Percentile && !(rule.percent >= 0 && rule.percent <= 100)) {
        throw UsageError("the percentile of a lake's level must be from 0 to 100");
    }
    require_positive(options.shore_width, "the width of the shore");
    require_positive(options.station_spacing, "the spacing of stations");
    require_positive(options.burn, "the depth to burn rivers in");
    require_not_negative(options.shore_clearance, "the clearance of the shore");
    require_not_negative(options.river_width, "the width of a river");
    require_not_negative(options.max_drop, "the most that a river is dug in");
    require_not_negative(options.max_lift, "the most that a river is lifted");
    require_not_negative(options.tolerance, "the tolerance of levels");
    const bool has_areas = std::any_of(lines.begin(), lines.end(),
                                       [](const Breakline& line) { return is_cleared_role(line.role); });
    if (options.burn && has_areas) {
        throw UsageError("burning rivers in and levelling lakes or banks are kept apart: do one of them");
    }
}

/// Twice the mean distance of samples, had they a square each, rounded down to 1, 2 or 5 times a power of
/// ten. Without samples the same of the longest side of the water's extent by a thousand.
double choose_shore_width(std::span<const Point3> samples, std::span<const Breakline> lines) {
    Box box;
    double width = 0;
    if (samples.size() > 2) {
        for (const Point3& sample : samples) {
            box.add(sample.x, sample.y);
        }
        const double area = (box.x_max - box.x_min) * (box.y_max - box.y_min);
        width = 2 * std::sqrt(area / static_cast<double>(samples.size()));
    }
    if (!(width > 0)) {
        for (const Breakline& line : lines) {
            for (const Point3& point : line.points) {
                box.add(point.x, point.y);
            }
        }
        width = std::max(box.x_max - box.x_min, box.y_max - box.y_min) / 1000;
    }
    if (!(width > 0)) {
        return 1;
    }
    const double power = std::pow(10.0, std::floor(std::log10(width)));
    const double digits = width / power;
    return power * (digits >= 5 ? 5 : digits >= 2 ? 2 : 1);
}

/// One level_water().
class Leveler {
  public:
    Leveler(std::span<const Point3> samples, std::span<const Breakline> lines, const WaterOptions& options)
        : lines_(lines),
          options_(options),
          lattice_(shared_lattice(lines, samples)),
          samples_(samples, lattice_),
          lakes_(network_, lines, samples_, options, out_.report) {
        WaterReport& report = out_.report;
        report.shore_width = options.shore_width.value_or(choose_shore_width(samples, lines));
        report.river_width = options.river_width.value_or(report.shore_width);
        report.station_spacing = options.station_spacing.value_or(report.shore_width);
    }

    Water make() {
        network_ = make_water_network(
            lines_, lattice_, {out_.report.station_spacing, options_.station_spacing, options_.ground});
        report_progress(options_.progress, 0.2);
        lakes_.measure();
        report_progress(options_.progress, 0.4);
        elevations_ = measure_water(network_, lakes_.levels(), samples_, out_.report.river_width);
        report_progress(options_.progress, 0.6);
        flow_ = find_flow(network_, elevations_, options_.flow);
        find_faults();
        lakes_.order(find_lake_falls(network_, flow_));
        std::copy(lakes_.levels().begin(), lakes_.levels().end(), elevations_.begin());
        out_.lifted = lakes_.look_at_shores();
        report_progress(options_.progress, 0.7);
        fit();
        report_progress(options_.progress, 0.9);
        set_vertex_levels();
        out_.report.reaches = make_reaches(network_, flow_, levels_, vertex_levels_);
        measure_changes();
        write_lines();
        report_banks();
        measure_shores();
        sort_findings();
        report_progress(options_.progress, 1);
        return std::move(out_);
    }

  private:
    void add(const WaterFinding& finding) { out_.report.findings.push_back(finding); }
    void add(const std::vector<WaterFinding>& findings) {
        out_.report.findings.insert(out_.report.findings.end(), findings.begin(), findings.end());
    }

    void find_faults() {
        const double tolerance = options_.tolerance;
        add(find_rises(network_, flow_, elevations_, tolerance));
        add(find_rings(network_, flow_));
        add(find_dangling(network_, flow_, samples_, {tolerance, out_.report.shore_width}));
        add(find_passages(network_, elevations_, tolerance));
        add(find_disorder(network_, flow_, elevations_, tolerance));
        add(find_unlevel_sections(network_, tolerance));
        const std::vector<WaterFinding> overlaps = find_overlaps(network_);
        if (!overlaps.empty() && options_.meeting_levels == CrossingPolicy::Error && !options_.keeps_faults) {
            throw BreaklineError("banks overlap a lake or other banks at " +
                                     location_text(overlaps.front().location) +
                                     ", where the water cannot have both their levels; cut one off at the "
                                     "other's shore, or say which elevation to take with --crossing-z "
                                     "mean|first|min|max",
                                 {overlaps.front().line});
        }
        add(overlaps);
        if (options_.flow == FlowRule::Auto) {
            for (const WaterFinding& finding : out_.report.findings) {
                out_.report.rivers_turned += finding.kind == Kind::WrongDirection ? 1U : 0U;
            }
        }
    }

    /// Levels of lakes stand; all others come as near to their elevations as falls and bounds allow.
    void fit() {
        std::vector<LevelNode> nodes = make_level_nodes(network_, flow_, elevations_);
        for (std::size_t node = network_.first_section; node < nodes.size(); ++node) {
            if (nodes[node].lowest == nodes[node].highest) {
                continue;  // tied to a lake
            }
            if (options_.max_drop) {
                nodes[node].lowest = nodes[node].target - *options_.max_drop;
            }
            if (options_.max_lift) {
                nodes[node].highest = nodes[node].target + *options_.max_lift;
            }
        }
        const LevelFit fitted = fit_levels(nodes, flow_.falls, options_.river_fit);
        std::map<std::uint32_t, double> wanted;
        for (std::size_t i = 0; i < fitted.beyond.size(); ++i) {
            wanted[fitted.beyond[i]] = fitted.wanted[i];
        }
        levels_.resize(network_.node_count);
        for (std::uint32_t node = 0; node < network_.node_count; ++node) {
            levels_[node] = fitted.levels[flow_.first_of[node]];
        }
        report_beyond(wanted);
        if (options_.burn) {
            for (double& level : levels_) {
                level -= *options_.burn;
            }
        }
    }

    /// One finding a stretch.
    void report_beyond(const std::map<std::uint32_t, double>& wanted) {
        for (std::uint32_t r = 0; r < network_.runs.size() && !wanted.empty(); ++r) {
            const WaterRun& run = network_.runs[r];
            std::optional<WaterFinding> worst;
            for (const std::uint32_t stop : run.stops) {
                const std::uint32_t node = run.is_between_banks ? stop : network_.nearest_node(stop);
                const auto found = wanted.find(flow_.first_of[node]);
                if (found == wanted.end() || node < network_.first_section) {
                    if (worst) {
                        add(*worst);
                    }
                    worst.reset();
                    continue;
                }
                const double amount = std::abs(found->second - levels_[node]);
                if (!worst || amount > worst->amount) {
                    worst.emplace();
                    worst->kind = Kind::BeyondLimit;
                    worst->line = network_.lines[run.line];
                    worst->location = location_of(node);
                    worst->z = levels_[node];
                    worst->other_z = found->second;
                    worst->amount = amount;
                }
            }
            if (worst) {
                add(*worst);
            }
        }
    }

    [[nodiscard]] Point2 location_of(std::uint32_t node) const {
        if (node >= network_.first_vertex) {
            return lattice_.position(network_.key(network_.vertex_of[node - network_.first_vertex]));
        }
        for (const BankWater& bank : network_.banks) {
            if (node >= bank.first_node && node < bank.first_node + bank.network.sections.size()) {
                const Point2 middle = bank.network.sections[node - bank.first_node].middle;
                return lattice_.position({std::round(middle.x), std::round(middle.y)});
            }
        }
        return {};
    }

    void set_vertex_levels() {
        const std::size_t count = network_.noded.keys.size();
        vertex_levels_.assign(count, kDraped);
        for (std::uint32_t v = 0; v < count; ++v) {
            const BankStand& stand = network_.stand_of[v];
            if (network_.node_of[v] != kNoNode) {
                vertex_levels_[v] = levels_[network_.node_of[v]];
            } else if (stand.a != kNoNode) {
                const auto [low, high] = std::minmax(levels_[stand.a], levels_[stand.b]);
                const double z = levels_[stand.a] + stand.part * (levels_[stand.b] - levels_[stand.a]);
                vertex_levels_[v] = std::clamp(z, low, high);
            }
        }
        // Rivers between banks: on the surface of the water.
        network_.noded.z = vertex_levels_;
        WaterAreas areas(network_.noded, network_.prepared);
        for (std::uint32_t v = 0; v < count; ++v) {
            if (std::isnan(vertex_levels_[v])) {
                if (const auto area = areas.around(network_.key(v))) {
                    vertex_levels_[v] = areas.level(*area, network_.key(v));
                }
            }
        }
    }

    /// How far reaches are below and above what they were made from.
    void measure_changes() {
        for (std::uint32_t r = 0; r < network_.runs.size(); ++r) {
            const WaterRun& run = network_.runs[r];
            Reach& reach = out_.report.reaches[r];
            for (const std::uint32_t stop : run.stops) {
                const std::uint32_t node = run.is_between_banks ? stop : network_.node_of[stop];
                if (node != kNoNode && node >= network_.first_section) {
                    reach.most_dug = std::max(reach.most_dug, elevations_[node] - levels_[node]);
                    reach.most_lifted = std::max(reach.most_lifted, levels_[node] - elevations_[node]);
                }
            }
        }
    }

    void write_lines() {
        out_.lines.assign(lines_.begin(), lines_.end());
        out_.origin.resize(lines_.size());
        for (std::uint32_t i = 0; i < lines_.size(); ++i) {
            out_.origin[i] = i;
        }
        for (std::uint32_t line = 0; line < network_.prepared.size(); ++line) {
            std::vector<Point3>& points = out_.lines[network_.lines[line]].points;
            points.clear();
            for (const std::uint32_t v : network_.chain(line)) {
                points.push_back(point_of(v));
            }
        }
        for (const BankWater& bank : network_.banks) {
            const std::uint32_t ring = network_.lines[bank.polygon.rings.front()];
            for (const BankSection& section : bank.network.sections) {
                if (!section.is_straight) {
                    continue;
                }
                const auto end = [&](std::size_t k) {
                    const auto& [r, i] = section.vertices[k];
                    return point_of(bank.rings[r][i]);
                };
                const Point3 a = end(0);
                const Point3 b = end(1);
                if (a.z != b.z) {
                    a.z > b.z ? add_slanting(ring, a, b) : add_slanting(ring, b, a);
                    continue;
                }
                Breakline line{{a, b}, LineRole::Section, lines_[ring].is_sharp, bank.polygon.number};
                out_.lines.push_back(std::move(line));
                out_.origin.push_back(ring);
            }
        }
    }

    /// A section between water of two levels, which others set: lakes on both sides of a weir, say.
    void add_slanting(std::uint32_t ring, const Point3& high, const Point3& low) {
        WaterFinding finding;
        finding.kind = Kind::BanksNotLevel;
        finding.line = ring;
        finding.location = {high.x, high.y};
        finding.z = high.z;
        finding.other_z = low.z;
        finding.amount = high.z - low.z;
        finding.length = options_.ground.length({high.x, high.y}, {low.x, low.y});
        add(finding);
    }

    [[nodiscard]] Point3 point_of(std::uint32_t v) const {
        const Point2 at = lattice_.position(network_.key(v));
        return {at.x, at.y, vertex_levels_[v]};
    }

    void report_banks() {
        for (const BankWater& bank : network_.banks) {
            BanksReport report;
            report.line = network_.lines[bank.polygon.rings.front()];
            double width = 0;
            for (std::uint32_t s = 0; s < bank.network.sections.size(); ++s) {
                const double level = levels_[bank.first_node + s];
                report.z_up = s == 0 ? level : std::max(report.z_up, level);
                report.z_down = s == 0 ? level : std::min(report.z_down, level);
                if (bank.network.sections[s].is_straight) {
                    ++report.sections;
                    width += width_of(bank, bank.network.sections[s]);
                }
            }
            report.mean_width = report.sections > 0 ? width / static_cast<double>(report.sections) : 0;
            out_.report.banks.push_back(report);
        }
    }

    /// Of a straight section.
    [[nodiscard]] double width_of(const BankWater& bank, const BankSection& section) const {
        if (!options_.ground.is_geodesic()) {
            return section.width * lattice_.quantum();
        }
        const auto vertex = [&](std::size_t k) {
            return bank.rings[section.vertices[k][0]][section.vertices[k][1]];
        };
        return network_.told_distance(vertex(0), vertex(1));
    }

    /// Shores are measured in the plane, where their lengths weigh levels; they are told on the ground.
    void measure_shores() {
        if (!options_.ground.is_geodesic()) {
            return;
        }
        std::map<std::uint32_t, double> lengths;  // of polygons
        for (const Breakline& line : lines_) {
            for (std::size_t i = 1; i < line.points.size() && line.role == LineRole::Lake; ++i) {
                const Point3& p = line.points[i - 1];
                const Point3& q = line.points[i];
                lengths[line.polygon] += options_.ground.length({p.x, p.y}, {q.x, q.y});
            }
        }
        for (LakeLevel& lake : out_.report.lakes) {
            lake.shore_length = lengths[lines_[lake.line].polygon];
        }
    }

    void sort_findings() {
        std::stable_sort(out_.report.findings.begin(), out_.report.findings.end(),
                         [](const WaterFinding& a, const WaterFinding& b) {
                             return std::tie(a.kind, a.line, a.chainage, a.location.x, a.location.y) <
                                    std::tie(b.kind, b.line, b.chainage, b.location.x, b.location.y);
                         });
    }

    std::span<const Breakline> lines_;
    const WaterOptions& options_;
    Lattice lattice_;
    NearSamples samples_;
    WaterNetwork network_;
    Water out_;
    LakeLevels lakes_;
    std::vector<double> elevations_;  // of all nodes: given or measured
    WaterFlow flow_;
    std::vector<double> levels_;  // of all nodes
    std::vector<double> vertex_levels_;
};

}  // namespace

Water level_water(std::span<const Point3> samples, std::span<const Breakline> lines,
                  const WaterOptions& options) {
    check_options(options, lines);
    const auto start = std::chrono::steady_clock::now();
    const bool has_water = std::any_of(lines.begin(), lines.end(),
                                       [](const Breakline& line) { return is_water_role(line.role); });
    Water water;
    if (has_water) {
        water = Leveler(samples, lines, options).make();
    } else {
        water.lines.assign(lines.begin(), lines.end());
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            water.origin.push_back(i);
        }
    }
    water.report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return water;
}

}  // namespace tinwright
