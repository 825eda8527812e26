#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <vector>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_id_2.h>
#include <CGAL/Triangulation_vertex_base_with_id_2.h>
#include <CGAL/boost/graph/graph_traits_Delaunay_triangulation_2.h>
#include <boost/graph/kruskal_min_spanning_tree.hpp>

#include "benchmarks/cgal_peer.hpp"

namespace tinwright_benchmarks {

void measure_cgal_spanning_tree(std::span<const tinwright::Point3> points, Meter& meter) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Vertices = CGAL::Triangulation_vertex_base_with_id_2<Kernel>;
    using Faces = CGAL::Triangulation_face_base_with_id_2<Kernel>;
    using Structure = CGAL::Triangulation_data_structure_2<Vertices, Faces>;
    using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, Structure>;

    std::vector<Kernel::Point_2> positions;
    positions.reserve(points.size());
    for (const tinwright::Point3& p : points) {
        positions.emplace_back(p.x, p.y);
    }
    Triangulation triangulation;
    triangulation.insert(positions.begin(), positions.end());
    int count = 0;
    for (const auto vertex : vertices(triangulation)) {
        vertex->id() = count++;
    }
    meter.start();
    std::vector<boost::graph_traits<Triangulation>::edge_descriptor> tree;
    boost::kruskal_minimum_spanning_tree(triangulation, std::back_inserter(tree));
    meter.stop();
    if (tree.size() + 1 != triangulation.number_of_vertices()) {
        throw std::runtime_error("Boost's spanning tree has " + std::to_string(tree.size()) + " edges of " +
                                 std::to_string(triangulation.number_of_vertices()) + " vertices");
    }
    meter.note(static_cast<double>(tree.size()));
}

}  // namespace tinwright_benchmarks
