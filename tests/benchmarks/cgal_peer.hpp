#ifndef TINWRIGHT_TESTS_BENCHMARKS_CGAL_PEER_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_CGAL_PEER_HPP

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"

#include "benchmarks/measure.hpp"

/// CGAL's Delaunay triangulation, exact predicates and inexact constructions, by range insertion.
namespace tinwright_benchmarks {

/// Whether the benchmarks were built with CGAL; nothing below may be called if not.
bool has_cgal();
/// "CGAL" and its version.
std::string cgal_name();

/// Measures the insertion alone: the points are CGAL's already. Notes the number of faces.
void measure_cgal(std::span<const tinwright::Point3> points, Meter& meter);

/// Corners of the Delaunay faces of `points`, three indices a face, counter-clockwise.
std::vector<std::uint32_t> cgal_faces(std::span<const tinwright::Point3> points);

}  // namespace tinwright_benchmarks

#endif
