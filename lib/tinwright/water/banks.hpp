#ifndef TINWRIGHT_WATER_BANKS_HPP
#define TINWRIGHT_WATER_BANKS_HPP

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"

/// The water between two banks: where it is level, and how it hangs together.
namespace tinwright {

/// A place across the water that has one level: a straight section from bank to bank inside the polygon, or
/// the corners of the faces where the water divides or comes together.
struct BankSection {
    /// Vertices that it joins, as (ring, number in the ring): two of a straight section.
    std::vector<std::array<std::uint32_t, 2>> vertices;
    Point2 middle{};   ///< in keys
    double width = 0;  ///< length of a straight section; of others the longest side; in keys
    bool is_straight = true;
};

/// Two sections with nothing but water between them.
struct BankLink {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::vector<Point2> path;  ///< the middle of the water from a's middle to b's, both included; in keys
    double length = 0;         ///< of the path, in keys
};

/// Where a vertex of a ring stands between sections: its level is (1 - part) times that of a plus part times
/// that of b. At a section, and at an end of the water, a and b are the same.
struct BankPlace {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    double part = 0;
};

struct BankNetwork {
    std::vector<BankSection> sections;
    std::vector<BankLink> links;
    std::vector<std::vector<BankPlace>> places;  ///< one a vertex of each ring
    std::vector<std::uint32_t> ends;             ///< sections of one link: where the water can begin or end
};

/// Divides a polygon of running water by sections, along its medial axis [prasad1997]: the polygon's
/// constrained Delaunay triangulation has faces in a row wherever the water has two banks, and the edges
/// between them lead from bank to bank; sections are many of these that share no vertex and are square to
/// the water. Where the water divides (around an island) or is joined, the face with three such edges, and
/// all that share a vertex with it, are one level place; little bays do not count. The vertices of any face
/// stand between two sections that are linked, or at one: with levels that fall along links, so does all the
/// water. Each island makes a cycle of links, unless level places or a row without sections are all around
/// it.
///
/// `rings`: of one polygon, closed without the first vertex repeated, vertices distinct, on the lattice;
/// rings meet neither themselves nor each other. Vertices half a width apart or closer make sections
/// square to the water; see `add_stations`. Vertices that a triangulation must not miss are all there
/// already: no points are made. No two sections cross or share a vertex. There is at least one; where there
/// is no more than one, no links and no ends. Deterministic; does not depend on where rings begin, nor on
/// their order or direction. O(n log n), and the length of the paths.
BankNetwork make_bank_network(std::span<const std::vector<Key2>> rings);

}  // namespace tinwright

#endif
