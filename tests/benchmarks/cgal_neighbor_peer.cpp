#include "benchmarks/cgal_neighbor_peer.hpp"

#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/interpolation_functions.h>
#include <CGAL/natural_neighbor_coordinates_2.h>

namespace tinwright_benchmarks {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<double, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertices>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
using Share = std::pair<Delaunay::Vertex_handle, double>;

/// A neighbour and its share, as they are.
struct Same {
    using result_type = Share;
    Share operator()(const Share& share) const { return share; }
};

/// The elevation at a vertex, and that there is one.
struct Elevation {
    using argument_type = Delaunay::Vertex_handle;
    using result_type = std::pair<double, bool>;
    result_type operator()(const Delaunay::Vertex_handle& vertex) const { return {vertex->info(), true}; }
};

}  // namespace

void measure_cgal_natural_neighbors(std::span<const tinwright::Point3> points,
                                    const tinwright::GridGeometry& grid, Meter& meter) {
    std::vector<std::pair<Kernel::Point_2, double>> samples;
    samples.reserve(points.size());
    for (const tinwright::Point3& p : points) {
        samples.emplace_back(Kernel::Point_2(p.x, p.y), p.z);
    }
    const Delaunay triangulation(samples.begin(), samples.end());
    std::vector<double> values(static_cast<std::size_t>(grid.columns));
    std::vector<Share> shares;
    Delaunay::Face_handle row_start;
    double sum = 0;
    meter.start();
    for (std::int64_t row = 0; row < grid.rows; ++row) {
        Delaunay::Face_handle face = row_start;
        for (std::int64_t column = 0; column < grid.columns; ++column) {
            const Kernel::Point_2 at(grid.x_min + (static_cast<double>(column) + 0.5) * grid.cell_width,
                                     grid.y_max - (static_cast<double>(row) + 0.5) * grid.cell_height);
            face = triangulation.locate(at, face);
            row_start = column == 0 ? face : row_start;
            shares.clear();
            const auto found = CGAL::natural_neighbor_coordinates_2(triangulation, at,
                                                                    std::back_inserter(shares), Same(), face);
            values[static_cast<std::size_t>(column)] =
                found.third && found.second > 0
                    ? CGAL::linear_interpolation(shares.begin(), shares.end(), found.second, Elevation())
                    : 0;
        }
        for (const double value : values) {
            sum += value;
        }
    }
    meter.stop();
    meter.note(sum);
}

}  // namespace tinwright_benchmarks
