#include "benchmarks/cgal_peer.hpp"

#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/version.h>

namespace tinwright_benchmarks {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Position = Kernel::Point_2;

}  // namespace

bool has_cgal() { return true; }

std::string cgal_name() { return "CGAL " CGAL_VERSION_STR; }

void measure_cgal(std::span<const tinwright::Point3> points, Meter& meter) {
    std::vector<Position> positions;
    positions.reserve(points.size());
    for (const tinwright::Point3& p : points) {
        positions.emplace_back(p.x, p.y);
    }
    meter.start();
    CGAL::Delaunay_triangulation_2<Kernel> triangulation;
    triangulation.insert(positions.begin(), positions.end());
    meter.stop();
    meter.note(static_cast<double>(triangulation.number_of_faces()));
}

std::vector<std::uint32_t> cgal_faces(std::span<const tinwright::Point3> points) {
    using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
    using Structure = CGAL::Triangulation_data_structure_2<Vertices>;
    std::vector<std::pair<Position, std::uint32_t>> positions;
    positions.reserve(points.size());
    for (const tinwright::Point3& p : points) {
        positions.emplace_back(Position(p.x, p.y), static_cast<std::uint32_t>(positions.size()));
    }
    CGAL::Delaunay_triangulation_2<Kernel, Structure> triangulation;
    triangulation.insert(positions.begin(), positions.end());
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * triangulation.number_of_faces());
    for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end(); ++face) {
        for (int corner = 0; corner < 3; ++corner) {
            corners.push_back(face->vertex(corner)->info());
        }
    }
    return corners;
}

}  // namespace tinwright_benchmarks
