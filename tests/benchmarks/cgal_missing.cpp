#include <stdexcept>

#include "benchmarks/cgal_neighbor_peer.hpp"
#include "benchmarks/cgal_peer.hpp"

namespace tinwright_benchmarks {

bool has_cgal() { return false; }

std::string cgal_name() { return "CGAL (not found at build time)"; }

void measure_cgal(std::span<const tinwright::Point3> /*points*/, Meter& /*meter*/) {
    throw std::runtime_error("built without CGAL");
}

std::vector<std::uint32_t> cgal_faces(std::span<const tinwright::Point3> /*points*/) {
    throw std::runtime_error("built without CGAL");
}

void measure_cgal_spanning_tree(std::span<const tinwright::Point3> /*points*/, Meter& /*meter*/) {
    throw std::runtime_error("built without CGAL");
}

void measure_cgal_constrained(const Network& /*network*/, Meter& /*meter*/) {
    throw std::runtime_error("built without CGAL");
}

void measure_cgal_conforming(const Network& /*network*/, Meter& /*meter*/) {
    throw std::runtime_error("built without CGAL");
}

void measure_cgal_natural_neighbors(std::span<const tinwright::Point3> /*points*/,
                                    const tinwright::GridGeometry& /*grid*/, Meter& /*meter*/) {
    throw std::runtime_error("built without CGAL");
}

}  // namespace tinwright_benchmarks
