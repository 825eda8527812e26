#ifndef TINWRIGHT_TESTS_SURFACE_CONTOUR_PIECES_HPP
#define TINWRIGHT_TESTS_SURFACE_CONTOUR_PIECES_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "tinwright/mesh/tin.hpp"

#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

/// Small TINs full of ties to be contoured, and a slow oracle that cuts face by face.
namespace tinwright_tests {

/// A grid with few different whole elevations: plateaus, level valleys and ridges, saddles everywhere.
inline tinwright::Tin tied_grid(Random& random, int columns, int rows, int highest) {
    tinwright::Tin tin = delaunay_tin(grid_keys(columns, rows));
    for (double& z : tin.z) {
        z = static_cast<double>(random.integer(0, highest));
    }
    return tin;
}

/// A TIN for a seed: tied grids and the families of optimising, whole elevations or not, voids or not.
inline tinwright::Tin contour_tin(Random& random, std::size_t kind) {
    const std::size_t general = general_families().size();
    const std::size_t degenerate = degenerate_families().size();
    tinwright::Tin tin;
    kind %= general + degenerate + 3;
    if (kind < general) {
        tin = general_families()[kind].make(random, 24);
    } else if (kind < general + degenerate) {
        tin = degenerate_families()[kind - general].make(random, 24);
    } else {
        tin = tied_grid(random, 6, 5, static_cast<int>(kind - general - degenerate) + 1);
    }
    if (random.integer(0, 1) == 0) {
        for (double& z : tin.z) {
            z = std::round(z);
        }
    }
    if (tin.mesh.count_terrain() > 1 && random.integer(0, 2) == 0) {
        make_voids_at_random(random, tin, 3);
    }
    return tin;
}

/// The greatest coordinate, CRS units.
inline double extent_of(const tinwright::Tin& tin) {
    double extent = 0;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const tinwright::Point3 p = tin.position({v});
        extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
    }
    return extent;
}

/// Levels that pass through vertices, and others.
inline std::vector<double> contour_levels_for(Random& random, const tinwright::Tin& tin) {
    std::vector<double> levels;
    for (int i = 0; i < 4; ++i) {
        const auto last = static_cast<std::int64_t>(tin.vertex_count()) - 1;
        const double z = tin.z[static_cast<std::size_t>(random.integer(0, last))];
        const double other = tin.z[static_cast<std::size_t>(random.integer(0, last))];
        levels.push_back(random.integer(0, 1) == 0 ? z : (z + other) / 2);
    }
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    return levels;
}

namespace oracle {

using Rational = boost::multiprecision::cpp_rational;

struct Spot {
    Rational x;
    Rational y;
    friend bool operator==(const Spot&, const Spot&) = default;
    friend bool operator<(const Spot& a, const Spot& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
};

inline int side(const Spot& a, const Spot& b, const Spot& c) {
    const Rational area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

/// A piece of a contour in one face, higher ground on its left; in exact numbers.
struct Piece {
    Spot from;
    Spot to;
    std::array<std::uint32_t, 2> from_edge;
    std::array<std::uint32_t, 2> to_edge;
};

inline Spot spot_of(const tinwright::Tin& tin, std::uint32_t v) {
    const tinwright::Point3 p = tin.position({v});
    return {Rational(p.x), Rational(p.y)};
}

/// Where the level meets the edge from `low` to `high`.
inline Spot cut(const tinwright::Tin& tin, std::uint32_t low, std::uint32_t high, double level) {
    const Rational t =
        (Rational(level) - Rational(tin.z[low])) / (Rational(tin.z[high]) - Rational(tin.z[low]));
    const Spot a = spot_of(tin, low);
    const Spot b = spot_of(tin, high);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// The pieces of a level, what lies at it counted as below.
inline std::vector<Piece> cut_faces(const tinwright::Tin& tin, double level) {
    std::vector<Piece> pieces;
    for (const auto& face : terrain_of(tin.mesh)) {
        std::vector<std::uint32_t> high;
        std::vector<std::uint32_t> low;
        for (const std::uint32_t v : face) {
            (tin.z[v] > level ? high : low).push_back(v);
        }
        if (high.empty() || low.empty()) {
            continue;
        }
        const std::uint32_t alone = high.size() == 1 ? high[0] : low[0];
        const std::vector<std::uint32_t>& pair = high.size() == 1 ? low : high;
        std::array<Spot, 2> ends;
        for (std::size_t i = 0; i < 2; ++i) {
            ends[i] = high.size() == 1 ? cut(tin, pair[i], alone, level) : cut(tin, alone, pair[i], level);
        }
        const auto edge = [&](std::size_t i) {
            return std::array{std::min(alone, pair[i]), std::max(alone, pair[i])};
        };
        // Seen from the vertex that is alone, the pair lies left to right or right to left.
        const bool is_left = side(spot_of(tin, alone), spot_of(tin, pair[0]), spot_of(tin, pair[1])) > 0;
        // A vertex alone above must be on the left of the piece.
        const std::size_t first = is_left == (high.size() == 1) ? 0 : 1;
        pieces.push_back({ends[first], ends[1 - first], edge(first), edge(1 - first)});
    }
    return pieces;
}

}  // namespace oracle

}  // namespace tinwright_tests

#endif
