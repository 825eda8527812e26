#include "tinwright/breaklines/keyed_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "tinwright/geometry/error.hpp"

namespace tinwright {
namespace {

constexpr double kSnapShare = 0.001;    // of the median segment: a centimetre where points are 10 m apart
constexpr double kDanglingFactor = 50;  // times the default snapping distance

void check_distance(const char* name, double distance) {
    if (!(distance >= 0) || std::isinf(distance)) {
        throw UsageError(std::string(name) + " must be a distance of at least 0");
    }
}

/// Median length of the segments in CRS units; 0 if there are none.
double median_segment(std::span<const Breakline> lines) {
    std::vector<double> squares;
    for (const Breakline& line : lines) {
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            const double dx = line.points[i].x - line.points[i - 1].x;
            const double dy = line.points[i].y - line.points[i - 1].y;
            if (dx != 0 || dy != 0) {
                squares.push_back(dx * dx + dy * dy);
            }
        }
    }
    if (squares.empty()) {
        return 0;
    }
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return std::sqrt(*middle);
}

/// The power of ten at or below `value`, so that a small change of the lines mostly changes nothing.
double round_to_power_of_ten(double value) {
    return value > 0 ? std::pow(10.0, std::floor(std::log10(value))) : 0.0;
}

/// Chains of lines left out are empty.
void renumber_chains(NodedLines& noded, const std::vector<std::uint32_t>& number, std::size_t lines) {
    if (noded.chain_start.empty()) {
        return;
    }
    std::vector<std::uint32_t> start(lines + 1, 0);
    for (std::size_t i = 0; i < number.size(); ++i) {
        start[number[i] + 1] = noded.chain_start[i + 1] - noded.chain_start[i];
    }
    for (std::size_t i = 0; i < lines; ++i) {
        start[i + 1] += start[i];
    }
    noded.chain_start = std::move(start);
}

}  // namespace

Lattice shared_lattice(std::span<const Breakline> lines, std::span<const Point3> samples) {
    std::vector<Point3> line_points;
    for (const Breakline& line : lines) {
        line_points.insert(line_points.end(), line.points.begin(), line.points.end());
    }
    const FoundLattice found = find_lattice(samples, line_points);
    if (found.bounds.is_empty()) {
        return found.lattice;
    }
    const Key2 largest = found.lattice.key({found.bounds.x_max, found.bounds.y_max});
    return found.lattice.refined(found.lattice.refinement_room(std::max(largest.x, largest.y)));
}

std::vector<LineTraits> complete_traits(std::span<const Breakline> lines, std::span<const LineTraits> given) {
    std::vector<LineTraits> traits(given.begin(), given.end());
    traits.resize(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!is_polygon_role(lines[i].role)) {
            continue;
        }
        traits[i].is_ring = true;
        traits[i].polygon = lines[i].polygon;
        if (given.empty()) {
            traits[i].is_draped = std::all_of(lines[i].points.begin(), lines[i].points.end(),
                                              [](const Point3& point) { return std::isnan(point.z); });
        }
    }
    return traits;
}

KeyedLines key_lines(std::span<const Breakline> lines, const Lattice& lattice,
                     const LineCheckOptions& options, CrossingPolicy crossing_z) {
    check_distance("the crossing tolerance", options.crossing_tolerance);
    check_distance("the line tolerance", options.line_tolerance);
    const double automatic = round_to_power_of_ten(kSnapShare * median_segment(lines));
    const double snap = options.snap.value_or(automatic);
    const double dangling = options.dangling.value_or(kDanglingFactor * automatic);
    check_distance("the snapping distance", snap);
    check_distance("the distance of dangling ends", dangling);
    KeyedLines keyed;
    keyed.lattice = lattice;
    keyed.snap = snap / keyed.lattice.quantum();
    keyed.dangling = dangling / keyed.lattice.quantum();
    keyed.traits = complete_traits(lines, options.traits);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const CleanOptions clean{keyed.snap, keyed.traits[i].is_ring, crossing_z};
        keyed.faults.emplace_back();
        keyed.lines.push_back(clean_line(lines[i].points, keyed.lattice, clean, keyed.faults.back()));
    }
    return keyed;
}

NodedLines node_keyed_lines(const KeyedLines& keyed, std::span<const Breakline> source,
                            const NodingOptions& options) {
    std::vector<Breakline> lines;
    std::vector<std::uint32_t> number;  // of each of these: in `source`
    for (std::uint32_t i = 0; i < keyed.lines.size(); ++i) {
        const CleanLine& clean = keyed.lines[i];
        if (clean.keys.size() < 2) {
            continue;
        }
        Breakline line{{}, source[i].role, source[i].is_sharp, source[i].polygon};
        for (std::size_t p = 0; p < clean.keys.size(); ++p) {
            const Point2 at = keyed.lattice.position(clean.keys[p]);
            line.points.push_back({at.x, at.y, clean.z[p]});
        }
        lines.push_back(std::move(line));
        number.push_back(i);
    }
    NodedLines noded = node_lines(lines, keyed.lattice, options);
    for (NodedPiece& piece : noded.pieces) {
        piece.line = number[piece.line];
    }
    renumber_chains(noded, number, keyed.lines.size());
    for (LineConflict& conflict : noded.conflicts) {
        for (std::uint32_t* const line : {&conflict.line_a, &conflict.line_b}) {
            *line = *line == LineConflict::kNone ? *line : number[*line];
        }
    }
    return noded;
}

}  // namespace tinwright
