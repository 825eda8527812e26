#include "tinwright/water/river_findings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "tinwright/breaklines/line_segments.hpp"
#include "tinwright/breaklines/segment_distance.hpp"

namespace tinwright {

namespace {

using Kind = WaterFinding::Kind;

/// A river, or part of one, that runs one way: its vertices as they were drawn.
struct Course {
    std::uint32_t line = 0;
    bool is_reversed = false;
    std::vector<std::uint32_t> vertices;
    std::vector<double> chainages;
};

/// Joins the runs of a line that go on from each other.
std::vector<Course> find_courses(const WaterNetwork& network, const WaterFlow& flow) {
    std::vector<Course> courses;
    for (std::uint32_t r = 0; r < network.runs.size(); ++r) {
        const WaterRun& run = network.runs[r];
        if (run.is_between_banks) {
            continue;
        }
        const bool goes_on = !courses.empty() && courses.back().line == run.line &&
                             courses.back().is_reversed == flow.is_reversed[r] &&
                             courses.back().vertices.back() == run.stops.front();
        if (!goes_on) {
            courses.push_back({run.line, flow.is_reversed[r], {run.stops.front()}, {run.chainage}});
        }
        Course& course = courses.back();
        for (std::size_t i = 1; i < run.stops.size(); ++i) {
            course.chainages.push_back(course.chainages.back() +
                                       network.told_distance(run.stops[i - 1], run.stops[i]));
            course.vertices.push_back(run.stops[i]);
        }
    }
    return courses;
}

/// Rises along elevations as the water meets them.
class RiseFinder {
  public:
    RiseFinder(const WaterNetwork& network, const Course& course, double tolerance,
               std::vector<WaterFinding>& findings)
        : network_(network), course_(course), tolerance_(tolerance), findings_(findings) {}

    void pass(std::size_t i, double z) {
        if (is_first_ || z <= low_) {
            finish();
            low_ = z;
            low_at_ = i;
            is_first_ = false;
        } else if (z - low_ > tolerance_ && (!has_top_ || z > top_z_)) {
            has_top_ = true;
            top_ = i;
            top_z_ = z;
        }
    }
    void finish() {
        if (has_top_) {
            WaterFinding finding =
                make_finding(Kind::RunsUphill, network_, course_.line, course_.vertices[top_]);
            finding.z = top_z_;
            finding.other_z = low_;
            finding.amount = top_z_ - low_;
            finding.chainage = course_.chainages[top_];
            finding.length = std::abs(course_.chainages[top_] - course_.chainages[low_at_]);
            finding.is_repaired = true;
            findings_.push_back(finding);
        }
        has_top_ = false;
    }

  private:
    const WaterNetwork& network_;
    const Course& course_;
    double tolerance_;
    std::vector<WaterFinding>& findings_;
    bool is_first_ = true;
    double low_ = 0;
    std::size_t low_at_ = 0;
    bool has_top_ = false;
    std::size_t top_ = 0;
    double top_z_ = 0;
};

/// Elevations at both ends of each river, and how much of it was drawn against the flow.
struct Ends {
    double first = 0;
    double last = 0;
    std::uint32_t last_vertex = 0;
    double chainage = 0;
    double length = 0;
    double against = 0;
};

std::map<std::uint32_t, Ends> find_ends(const WaterNetwork& network, std::span<const Course> courses,
                                        std::span<const double> elevations) {
    std::map<std::uint32_t, Ends> ends;
    for (const Course& course : courses) {
        const auto [place, is_new] = ends.try_emplace(course.line);
        Ends& of_line = place->second;
        if (is_new) {
            of_line.first = elevations[network.nearest_node(course.vertices.front())];
        }
        of_line.last_vertex = course.vertices.back();
        of_line.last = elevations[network.nearest_node(of_line.last_vertex)];
        of_line.chainage = course.chainages.back();
        const double length = course.chainages.back() - course.chainages.front();
        of_line.length += length;
        of_line.against += course.is_reversed ? length : 0;
    }
    return ends;
}

/// Number of runs that begin and end at each node, seen in flow direction.
struct Degrees {
    std::vector<std::uint32_t> in;
    std::vector<std::uint32_t> out;
};

Degrees count_runs(const WaterNetwork& network, const WaterFlow& flow) {
    Degrees degrees{std::vector<std::uint32_t>(network.node_count),
                    std::vector<std::uint32_t>(network.node_count)};
    for (std::uint32_t r = 0; r < network.runs.size(); ++r) {
        ++degrees.out[flow.first_of[flow.upper_end(network, r)]];
        ++degrees.in[flow.first_of[flow.lower_end(network, r)]];
    }
    return degrees;
}

/// Rises from section to section, each told at a vertex of the section.
void add_bank_rises(const WaterNetwork& network, const WaterFlow& flow, std::span<const double> elevations,
                    double tolerance, std::vector<WaterFinding>& findings) {
    for (std::uint32_t r = 0; r < network.runs.size(); ++r) {
        const WaterRun& run = network.runs[r];
        if (!run.is_between_banks) {
            continue;
        }
        const BankWater& bank = network.banks[run.bank];
        Course course{run.line, flow.is_reversed[r], {}, {0}};
        for (std::size_t i = 0; i < run.stops.size(); ++i) {
            const auto& [ring, number] =
                bank.network.sections[run.stops[i] - bank.first_node].vertices.front();
            course.vertices.push_back(bank.rings[ring][number]);
            if (i > 0) {
                course.chainages.push_back(course.chainages.back() + network.told_length(run.paths[i - 1]));
            }
        }
        RiseFinder rises(network, course, tolerance, findings);
        for (std::size_t k = 0; k < run.stops.size(); ++k) {
            const std::size_t i = course.is_reversed ? run.stops.size() - 1 - k : k;
            rises.pass(i, elevations[run.stops[i]]);
        }
        rises.finish();
    }
}

}  // namespace

std::vector<WaterFinding> find_rises(const WaterNetwork& network, const WaterFlow& flow,
                                     std::span<const double> elevations, double tolerance) {
    std::vector<WaterFinding> findings;
    const std::vector<Course> courses = find_courses(network, flow);
    std::set<std::uint32_t> turned;
    for (const auto& [line, ends] : find_ends(network, courses, elevations)) {
        const double rise = ends.last - ends.first;
        const bool is_against = 2 * ends.against > ends.length;
        if (is_against || (rise > tolerance && ends.against == 0)) {
            WaterFinding finding = make_finding(Kind::WrongDirection, network, line, ends.last_vertex);
            finding.z = ends.last;
            finding.other_z = ends.first;
            finding.amount = std::max(0.0, rise);
            finding.chainage = ends.chainage;
            finding.length = ends.length;
            finding.is_repaired = is_against;
            findings.push_back(finding);
            if (!is_against) {
                turned.insert(line);
            }
        }
    }
    for (const Course& course : courses) {
        if (turned.contains(course.line)) {
            continue;  // all of it runs uphill
        }
        RiseFinder rises(network, course, tolerance, findings);
        for (std::size_t k = 0; k < course.vertices.size(); ++k) {
            const std::size_t i = course.is_reversed ? course.vertices.size() - 1 - k : k;
            rises.pass(i, elevations[network.nearest_node(course.vertices[i])]);
        }
        rises.finish();
    }
    add_bank_rises(network, flow, elevations, tolerance, findings);
    return findings;
}

std::vector<WaterFinding> find_rings(const WaterNetwork& network, const WaterFlow& flow) {
    std::vector<WaterFinding> findings;
    const std::vector<std::uint32_t> vertex = find_node_vertices(network);
    const std::vector<std::uint32_t> line = find_node_lines(network);
    const auto add = [&](Kind kind, std::uint32_t node) {
        if (vertex[node] != kNoNode) {
            findings.push_back(make_finding(kind, network, line[node], vertex[node]));
            findings.back().is_repaired = true;
        }
    };
    std::set<std::uint32_t> seen;
    const std::vector<std::uint32_t> cycles = find_cycles(network.node_count, flow.falls);
    for (std::uint32_t node = 0; node < cycles.size(); ++node) {
        if (cycles[node] != kNoCycle && seen.insert(cycles[node]).second) {
            add(Kind::Loop, node);
        }
    }
    for (const std::uint32_t node : find_braids(network.node_count, flow.falls)) {
        add(Kind::Braid, node);
    }
    return findings;
}

std::vector<WaterFinding> find_dangling(const WaterNetwork& network, const WaterFlow& flow,
                                        NearSamples& samples, const RiverFindingOptions& options) {
    std::vector<WaterFinding> findings;
    const Degrees degrees = count_runs(network, flow);
    const double reach = options.shore_width / network.lattice.quantum();
    std::vector<CleanLine> chains(network.prepared.size());
    for (std::uint32_t line = 0; line < chains.size(); ++line) {
        for (const std::uint32_t v : network.chain(line)) {
            chains[line].keys.push_back(network.key(v));
            chains[line].z.push_back(0);
        }
    }
    const LineSegments segments(chains);
    const auto is_near_other = [&](std::uint32_t line, Key2 key) {
        bool is_near = false;
        segments.visit_meeting(box_around(key, reach), [&](const LineSegments::Segment& segment) {
            is_near =
                is_near || (segment.line != line &&
                            measure_distance(key, segments.start(segment), segments.end(segment)).squared <=
                                reach * reach);
        });
        return is_near;
    };
    for (std::uint32_t r = 0; r < network.runs.size(); ++r) {
        const WaterRun& run = network.runs[r];
        const std::uint32_t node = flow.first_of[flow.lower_end(network, r)];
        if (run.is_between_banks || node < network.first_vertex || degrees.in[node] != 1 ||
            degrees.out[node] != 0) {
            continue;
        }
        const std::uint32_t v = flow.is_reversed[r] ? run.stops.front() : run.stops.back();
        const Key2 key = network.key(v);
        const bool is_dangling =
            samples.is_empty() ? is_near_other(run.line, key) : !samples.is_at_border(key, reach);
        if (is_dangling) {
            findings.push_back(make_finding(Kind::DanglingReach, network, run.line, v));
        }
    }
    return findings;
}

}  // namespace tinwright
