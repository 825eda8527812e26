#ifndef TINWRIGHT_TESTS_BENCHMARKS_POINT_FILES_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_POINT_FILES_HPP

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"

/// The point sets that are measured, and the files they are read from.
namespace tinwright_benchmarks {

using Points = std::vector<tinwright::Point3>;

/// Uniform in a square of 4000 units, every bit of the coordinates in use.
Points uniform_points(std::size_t count);
/// Uniform in a square of 4000 m, to the millimetre.
Points survey_points(std::size_t count);
/// Air-borne scan rows in UTM metres, x, y and z to the centimetre, in the order they were flown; z is off
/// the terrain by up to 6 cm, as such measurements are.
Points scan_points(std::size_t count);
/// `side` by `side` whole numbers, row by row or in random order.
Points grid_points(int side, bool is_shuffled);

/// x y z lines with `decimals` decimals, without a header.
void write_xyz(const std::string& path, std::span<const tinwright::Point3> points, int decimals);
/// The same with commas and a header, and beside it PATH.vrt that makes a point layer of it, named as the
/// file: how users bring text to OGR programs.
void write_csv(const std::string& path, std::span<const tinwright::Point3> points, int decimals);
/// A point layer `points` with one attribute field.
void write_geopackage(const std::string& path, std::span<const tinwright::Point3> points);

}  // namespace tinwright_benchmarks

#endif
