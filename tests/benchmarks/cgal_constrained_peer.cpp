#include <cstddef>
#include <utility>
#include <vector>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_conformer_2.h>

#include "benchmarks/cgal_peer.hpp"

namespace tinwright_benchmarks {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Position = Kernel::Point_2;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel>;

/// What CGAL takes.
struct Input {
    std::vector<Position> positions;
    std::vector<std::pair<std::size_t, std::size_t>> segments;

    explicit Input(const Network& network) : segments(network.segments.begin(), network.segments.end()) {
        positions.reserve(network.points.size());
        for (const tinwright::Point3& p : network.points) {
            positions.emplace_back(p.x, p.y);
        }
    }
    void insert_in(Triangulation& triangulation) const {
        triangulation.insert_constraints(positions.begin(), positions.end(), segments.begin(),
                                         segments.end());
    }
};

}  // namespace

void measure_cgal_constrained(const Network& network, Meter& meter) {
    const Input input(network);
    meter.start();
    Triangulation triangulation;
    input.insert_in(triangulation);
    meter.stop();
    meter.note(static_cast<double>(triangulation.number_of_faces()));
}

void measure_cgal_conforming(const Network& network, Meter& meter) {
    Triangulation triangulation;
    Input(network).insert_in(triangulation);
    const std::size_t before = triangulation.number_of_vertices();
    meter.start();
    CGAL::make_conforming_Delaunay_2(triangulation);
    meter.stop();
    meter.note(static_cast<double>(triangulation.number_of_vertices() - before));
}

}  // namespace tinwright_benchmarks
