#ifndef TINWRIGHT_TESTS_BENCHMARKS_TERRAIN_POINTS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_TERRAIN_POINTS_HPP

#include <cstddef>

#include "benchmarks/point_files.hpp"

/// The point sets on which optimal TINs are measured: ordinary terrain, and what is hard for edge insertion.
/// All are seeded; the areas grow with the number of points, but for `noisy_points` and the curves.
namespace tinwright_benchmarks {

/// `uniform_points`, z off the rolling terrain by up to 6 cm.
Points noisy_points(std::size_t count);
/// Random places 4 m apart on average on a rough terrain: noise of wavelengths from 2 km to 4 m, the heights
/// falling with the power 0.8 of the wavelength, like those of mountains.
Points fractal_points(std::size_t count);

/// Whole numbers near a circle: all faces of the Delaunay TIN are thin, and an edge may cross nearly all of
/// them. z is random.
Points circle_points(std::size_t count);
/// Vertices of a convex curve whose radii differ, a spiral of one turn; z is random.
Points convex_points(std::size_t count);
/// Random places on a plain at one level, cut by one cliff of 50 m.
Points cliff_points(std::size_t count);
/// The fractal terrain under a sea: two thirds lie at level 0.
Points sea_points(std::size_t count);
/// Two straight rows that face each other across a tenth of their length, each a wave of its own phase: what
/// is level with a sample lies far along the other row.
Points facing_points(std::size_t count);
/// Whole numbers near two arcs that go all around, one within the other, half of them on each: the distance
/// between the arcs grows along them from a quarter of the radius to a half, so that the relative
/// neighbourhood graph joins them at the narrow end only, and the inner one is open. What is left is one
/// polygon. z is random.
Points arc_points(std::size_t count);
/// Places in clusters of a thousand on the fractal terrain, to the centimetre: the denser the nearer to the
/// cluster's centre, most of the plane empty.
Points cluster_points(std::size_t count);
/// A square grid of whole numbers on the rolling terrain, row by row.
Points square_points(std::size_t count);

}  // namespace tinwright_benchmarks

#endif
