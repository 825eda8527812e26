#ifndef TINWRIGHT_TESTS_SUPPORT_LINE_SETS_HPP
#define TINWRIGHT_TESTS_SUPPORT_LINE_SETS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/geometry/point.hpp"

#include "support/point_sets.hpp"

/// Seeded families of lines: the ordinary kinds, and those that other tools crash on, hang on or drop.
namespace tinwright_tests {

struct LineSet {
    std::vector<tinwright::Breakline> lines;
    std::vector<tinwright::Point3> samples;  ///< where the family is about samples too, else none
};

/// A kind of line sets; `make` gives about `size` segments, 1 or more. Coordinates are decimal, to the
/// centimetre; all elevations are those of `plane_z`, so that no two lines disagree where they meet.
struct LineFamily {
    const char* name;
    LineSet (*make)(Random& random, std::size_t size);
};

/// All kinds. Lines have no z that is to be draped; only the families about polygons have boundaries and
/// holes.
std::span<const LineFamily> line_families();

/// Elevation of the tilted plane that all families lie on.
double plane_z(double x, double y);

/// The location of two whole numbers of centimetres from an origin in UTM metres, with the plane's z.
tinwright::Point3 survey_point(std::int64_t x, std::int64_t y);

/// The lines in a random order, about half of them reversed.
std::vector<tinwright::Breakline> shuffled_and_reversed(Random& random,
                                                        std::vector<tinwright::Breakline> lines);

/// The lower bound of [tan1993, Fig. 6.1]: `edges` parallel edges close to each other, and as samples `pairs`
/// pairs of points, the points of a pair on both sides of the edges.
LineSet close_parallel_edges(std::size_t edges, std::size_t pairs);

/// `count` lines from one point, `angle_deg` apart (all around where there are enough), `length` metres long.
std::vector<tinwright::Breakline> fan(std::size_t count, double angle_deg, double length);

}  // namespace tinwright_tests

#endif
