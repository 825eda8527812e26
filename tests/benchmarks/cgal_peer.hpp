#ifndef TINWRIGHT_TESTS_BENCHMARKS_CGAL_PEER_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_CGAL_PEER_HPP

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"

#include "benchmarks/measure.hpp"

/// CGAL's Delaunay triangulations, exact predicates and inexact constructions, by range insertion.
namespace tinwright_benchmarks {

/// Whether the benchmarks were built with CGAL; nothing below may be called if not.
bool has_cgal();
/// "CGAL" and its version.
std::string cgal_name();

/// Measures the insertion alone: the points are CGAL's already. Notes the number of faces.
void measure_cgal(std::span<const tinwright::Point3> points, Meter& meter);

/// Corners of the Delaunay faces of `points`, three indices a face, counter-clockwise.
std::vector<std::uint32_t> cgal_faces(std::span<const tinwright::Point3> points);

/// Measures Boost's Kruskal on the triangulation of the points, which is made before. Notes the number of
/// edges.
void measure_cgal_spanning_tree(std::span<const tinwright::Point3> points, Meter& meter);

/// Distinct points, and segments between them by index, none of which cross.
struct Network {
    std::vector<tinwright::Point3> points;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;
};

/// Measures the constrained triangulation of a network that is CGAL's already, by insertion of all points and
/// segments at once: its fastest way. Notes the number of faces.
void measure_cgal_constrained(const Network& network, Meter& meter);

/// Measures only what makes a constrained triangulation conforming. Notes the number of points added.
void measure_cgal_conforming(const Network& network, Meter& meter);

}  // namespace tinwright_benchmarks

#endif
