#include "tinwright/water/flat_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/water/flat_axes.hpp"
#include "tinwright/water/flat_regions.hpp"

#include "contour_terrains.hpp"
#include "support/cases.hpp"
#include "support/line_sets.hpp"
#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr double kInterval = 10;

enum class Contours { Lines, Samples };

TriangulateOptions trimmed() {
    TriangulateOptions options;
    options.domain.kind = DomainRule::Kind::Trimmed;
    return options;
}

Tin tin_of_lines(std::span<const Breakline> lines) { return triangulate({}, lines, trimmed()).tin; }

Tin tin_of_points(std::span<const Point3> points) { return triangulate(points, trimmed()).tin; }

Tin contour_tin(const ContourTerrain& terrain, Contours kind, int squares) {
    const std::vector<Breakline> lines = contours_of(terrain, kInterval, squares);
    return kind == Contours::Lines ? tin_of_lines(lines) : tin_of_points(points_of(lines));
}

std::vector<std::array<Point3, 3>> faces_of(const Tin& tin) {
    std::vector<std::array<Point3, 3>> faces;
    for (const auto& corners : terrain_of(tin.mesh)) {
        faces.push_back({tin.position({corners[0]}), tin.position({corners[1]}), tin.position({corners[2]})});
    }
    return faces;
}

std::size_t flat_count(const Tin& tin) {
    const auto faces = faces_of(tin);
    return static_cast<std::size_t>(std::count_if(faces.begin(), faces.end(), [](const auto& face) {
        return face[0].z == face[1].z && face[1].z == face[2].z;
    }));
}

/// Root mean square of the facets less the terrain, by 21 places in each facet.
double error_of(const Tin& tin, const ContourTerrain& terrain) {
    constexpr int kRows = 6;
    double squares = 0;
    double weights = 0;
    for (const auto& [p, q, r] : faces_of(tin)) {
        const double area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        for (int i = 0; i < kRows; ++i) {
            for (int j = 0; i + j < kRows; ++j) {
                const double a = (i + 1.0 / 3) / kRows;
                const double b = (j + 1.0 / 3) / kRows;
                const double c = 1 - a - b;
                const double z = terrain.z(a * p.x + b * q.x + c * r.x, a * p.y + b * q.y + c * r.y);
                const double error = a * p.z + b * q.z + c * r.z - z;
                squares += area * error * error;
                weights += area;
            }
        }
    }
    return std::sqrt(squares / weights);
}

using Place = std::tuple<double, double, double>;

Place place_of(const Tin& tin, VertexId v) {
    const Point3 p = tin.position(v);
    return {p.x, p.y, p.z};
}

std::set<std::pair<Place, Place>> constrained_edges_of(const Tin& tin) {
    std::set<std::pair<Place, Place>> edges;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (tin.mesh.is_constrained(h)) {
                edges.insert(
                    std::minmax(place_of(tin, tin.mesh.origin(h)), place_of(tin, tin.mesh.destination(h))));
            }
        }
    }
    return edges;
}

std::set<std::pair<Place, Place>> traced_edges_of(const Tin& tin) {
    std::set<std::pair<Place, Place>> edges;
    for (const LineTrace& trace : tin.traces) {
        edges.insert(std::minmax(place_of(tin, trace.a), place_of(tin, trace.b)));
    }
    return edges;
}

/// Vertices that were there before are there still, bit for bit, and no other but inserted ones.
void check_vertices(const Tin& before, const Tin& after, std::size_t inserted) {
    std::set<std::pair<Place, std::uint32_t>> kept;
    for (std::uint32_t v = 0; v < after.vertex_count(); ++v) {
        if (after.sample[v] != Tin::kInserted) {
            kept.emplace(place_of(after, {v}), after.sample[v]);
        }
    }
    std::set<std::pair<Place, std::uint32_t>> were;
    for (std::uint32_t v = 0; v < before.vertex_count(); ++v) {
        were.emplace(place_of(before, {v}), before.sample[v]);
    }
    CHECK(kept == were);
    CHECK(after.vertex_count() == before.vertex_count() + inserted);
}

void check_treatment(const Tin& before, const Tin& after, const FlatFacesReport& report) {
    CHECK(is_sound(after));
    CHECK(report.before == flat_count(before));
    CHECK(report.after == flat_count(after));
    CHECK(report.after <= report.before);
    CHECK(after.mesh.count_terrain() == before.mesh.count_terrain() + 2 * report.inserted);
    CHECK(constrained_edges_of(after) == constrained_edges_of(before));
    CHECK(traced_edges_of(after) == traced_edges_of(before));
    CHECK(std::is_sorted(after.traces.begin(), after.traces.end()));
    check_vertices(before, after, report.inserted);
    if (report.inserted == 0) {
        CHECK(report.before - report.swapped == report.after);
    }
}

/// The vertices joined to each by edges of terrain.
std::vector<std::set<std::uint32_t>> neighbors_of(const Tin& tin) {
    std::vector<std::set<std::uint32_t>> neighbors(tin.vertex_count());
    for (const auto& face : terrain_of(tin.mesh)) {
        for (const std::uint32_t a : face) {
            for (const std::uint32_t b : face) {
                if (a != b) {
                    neighbors[a].insert(b);
                }
            }
        }
    }
    return neighbors;
}

/// Those that hang together with a way out.
std::vector<internal::AxisNode> open_nodes_of(const Tin& tin) {
    const std::vector<bool> no_water;
    const internal::FlatAxes axes = internal::find_flat_axes(tin, internal::FlatRegions(tin, no_water));
    std::vector<bool> is_open(axes.nodes.size());
    for (std::size_t n = 0; n < is_open.size(); ++n) {
        is_open[n] = axes.nodes[n].outlet != kGhostVertex;
    }
    for (bool is_changing = true; is_changing;) {
        is_changing = false;
        for (const internal::AxisLink& link : axes.links) {
            is_changing = is_changing || (is_open[link.from] && !is_open[link.to]);
            is_open[link.to] = is_open[link.to] || is_open[link.from];
        }
    }
    std::vector<internal::AxisNode> nodes;
    for (std::size_t n = 0; n < is_open.size(); ++n) {
        if (is_open[n]) {
            nodes.push_back(axes.nodes[n]);
        }
    }
    return nodes;
}

Tin lattice_tin(int size, double (*z)(int x, int y)) {
    std::vector<Point3> samples;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            samples.push_back({x * 1.0, y * 1.0, z(x, y)});
        }
    }
    return triangulate(samples).tin;
}

}  // namespace

TEST_SUITE("water/flat_faces") {
    TEST_CASE("swaps bring the surface nearer to the terrain, inserted points nearer still") {
        for (const ContourTerrain& terrain : contour_terrains()) {
            for (const Contours kind : {Contours::Lines, Contours::Samples}) {
                for (const int squares : {40, 90}) {
                    const std::string name = terrain.name;
                    CAPTURE(name);
                    CAPTURE(kind);
                    CAPTURE(squares);
                    const Tin tin = contour_tin(terrain, kind, squares);
                    Tin swapped = tin;
                    Tin inserted = tin;
                    check_treatment(tin, swapped, remove_flat_faces(swapped, FlatFaces::Swap));
                    check_treatment(tin, inserted, remove_flat_faces(inserted, FlatFaces::Insert));
                    // Closed tops and bottoms have no edge to swap but in bends.
                    const double kept_error = error_of(tin, terrain);
                    const double swapped_error = error_of(swapped, terrain);
                    CHECK(swapped_error < 1.001 * kept_error);
                    CHECK(error_of(inserted, terrain) < 0.9 * swapped_error);
                    CHECK(flat_count(swapped) < flat_count(tin));
                    CHECK(100 * flat_count(inserted) <= flat_count(tin));
                }
            }
        }
        const ContourTerrain& ridge = contour_terrains()[2];
        Tin tin = contour_tin(ridge, Contours::Lines, 90);
        const double before = error_of(tin, ridge);
        remove_flat_faces(tin, FlatFaces::Swap);
        CHECK(error_of(tin, ridge) < before / 2);
    }

    TEST_CASE("inserted elevations stay between contours, and half an interval beyond the last") {
        for (const ContourTerrain& terrain : contour_terrains()) {
            for (const Contours kind : {Contours::Lines, Contours::Samples}) {
                const std::string name = terrain.name;
                CAPTURE(name);
                CAPTURE(kind);
                Tin tin = contour_tin(terrain, kind, 60);
                const auto [lowest, highest] = std::minmax_element(tin.z.begin(), tin.z.end());
                const double bottom = *lowest - kInterval / 2;
                const double top = *highest + kInterval / 2;
                remove_flat_faces(tin, FlatFaces::Insert);
                const auto neighbors = neighbors_of(tin);
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    if (tin.sample[v] != Tin::kInserted) {
                        continue;
                    }
                    const double z = tin.z[v];
                    CHECK(std::remainder(z, kInterval) != 0);
                    CHECK(z > bottom);
                    CHECK(z < top);
                    // No line ends at the border of the map: there faces reach farther.
                    const Point3 p = tin.position({v});
                    const bool is_amid = std::max(std::abs(p.x - 500), std::abs(p.y - 500)) < 350;
                    for (const std::uint32_t n : neighbors[v]) {
                        if (is_amid && kind == Contours::Lines) {
                            CHECK(std::abs(tin.z[n] - z) < kInterval);
                        }
                    }
                }
            }
        }
    }

    TEST_CASE("a valley has no pit and a ridge no knob along its axis") {
        for (const std::size_t which : {2U, 3U}) {
            const ContourTerrain& terrain = contour_terrains()[which];
            const bool is_valley = which == 3;
            for (const Contours kind : {Contours::Lines, Contours::Samples}) {
                const std::string name = terrain.name;
                CAPTURE(name);
                CAPTURE(kind);
                Tin tin = contour_tin(terrain, kind, 80);
                // Where the map's detail pinches a contour off there are closed regions, which may have both.
                const auto rounded = [](Point2 p) {
                    return std::pair(std::llround(10 * p.x), std::llround(10 * p.y));
                };
                std::set<std::pair<long long, long long>> open;
                for (const internal::AxisNode& node : open_nodes_of(tin)) {
                    open.insert(rounded(tin.lattice.position({node.x, node.y})));
                }
                remove_flat_faces(tin, FlatFaces::Insert);
                const auto neighbors = neighbors_of(tin);
                std::size_t seen = 0;
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    const Point3 p = tin.position({v});
                    if (tin.sample[v] == Tin::kInserted && open.contains(rounded({p.x, p.y}))) {
                        ++seen;
                        CHECK(std::any_of(neighbors[v].begin(), neighbors[v].end(), [&](std::uint32_t n) {
                            return is_valley ? tin.z[n] < p.z : tin.z[n] > p.z;
                        }));
                    }
                }
                CHECK(seen > 50);
            }
        }
    }

    TEST_CASE("a closed top becomes a dome and a closed bottom a basin") {
        for (const double sign : {1.0, -1.0}) {
            std::vector<Point3> samples;
            for (const auto& [radius, z] : {std::pair{10.0, 20.0}, {20.0, 10.0}, {30.0, 0.0}}) {
                for (int i = 0; i < 48; ++i) {
                    const double angle = 2 * 3.14159265358979 * i / 48;
                    samples.push_back({std::round(1000 * radius * std::cos(angle)) / 1000,
                                       std::round(1000 * radius * std::sin(angle)) / 1000, sign * z});
                }
            }
            Tin tin = triangulate(samples).tin;
            const FlatFacesReport report = remove_flat_faces(tin, FlatFaces::Insert);
            CHECK(report.before == 46);
            CHECK(report.after == 0);
            CHECK(report.swapped == 0);
            double summit = 0;
            for (const double z : tin.z) {
                summit = std::max(summit, sign * z);
            }
            CHECK(summit > 23);  // slope 1 for 10 metres, bent down to less than half an interval
            CHECK(summit < 25);
        }
    }

    TEST_CASE("swapping twice does nothing more") {
        for (const ContourTerrain& terrain : contour_terrains()) {
            for (const Contours kind : {Contours::Lines, Contours::Samples}) {
                const std::string name = terrain.name;
                CAPTURE(name);
                Tin tin = contour_tin(terrain, kind, 50);
                remove_flat_faces(tin, FlatFaces::Swap);
                const auto words = words_of(tin);
                const FlatFacesReport again = remove_flat_faces(tin, FlatFaces::Swap);
                CHECK(again.swapped == 0);
                CHECK(again.before == again.after);
                CHECK(words_of(tin) == words);
            }
        }
    }

    TEST_CASE("the order of the input does not matter") {
        for (int seed = 0; seed < cases(3); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const ContourTerrain& terrain : contour_terrains()) {
                const std::vector<Breakline> lines = contours_of(terrain, kInterval, 30);
                for (const FlatFaces how : {FlatFaces::Swap, FlatFaces::Insert}) {
                    Tin of_lines = tin_of_lines(lines);
                    Tin of_shuffled_lines = tin_of_lines(shuffled_and_reversed(random, lines));
                    Tin of_points = tin_of_points(points_of(lines));
                    Tin of_shuffled_points = tin_of_points(shuffled(random, points_of(lines)));
                    for (Tin* const tin : {&of_lines, &of_shuffled_lines, &of_points, &of_shuffled_points}) {
                        remove_flat_faces(*tin, how);
                    }
                    CHECK(words_of(of_lines) == words_of(of_shuffled_lines));
                    CHECK(words_of(of_points) == words_of(of_shuffled_points));
                }
            }
        }
    }

    TEST_CASE("water is left alone") {
        Tin tin = contour_tin(contour_terrains()[1], Contours::Lines, 40);
        const auto words = words_of(tin);
        const std::vector<bool> all(tin.mesh.slot_count(), true);
        for (const FlatFaces how : {FlatFaces::Keep, FlatFaces::Swap, FlatFaces::Insert}) {
            const FlatFacesReport report = remove_flat_faces(tin, how, all);
            CHECK(report.before == 0);
            CHECK(report.after == 0);
            CHECK(words_of(tin) == words);
        }
        CHECK(count_flat_faces(tin) == flat_count(tin));
        CHECK(count_flat_faces(tin, all) == 0);

        const std::vector<Breakline> lake = {
            {.points = {{4, 4, 2}, {8, 4, 2}, {8, 8, 2}, {4, 8, 2}, {4, 4, 2}}, .role = LineRole::Lake}};
        std::vector<Point3> samples;
        for (int i = 0; i < 144; ++i) {
            samples.push_back({i % 12 + 0.5, std::floor(i / 12.0) + 0.5, 3.0 + i % 12});
        }
        TriangulateOptions options;
        FlatFacesReport report;
        std::size_t water_faces = 0;
        options.before_optimum = [&](Tin& made, const std::vector<bool>& is_water) {
            water_faces = static_cast<std::size_t>(std::count(is_water.begin(), is_water.end(), true));
            report = remove_flat_faces(made, FlatFaces::Insert, is_water);
        };
        const Triangulated made = triangulate(samples, lake, options);
        CHECK(water_faces == 2);
        CHECK(report.inserted == 0);
        CHECK(flat_count(made.tin) == 2 + report.after);
    }

    TEST_CASE("what is inserted before an optimum leaves a Delaunay TIN, and the optimum keeps it") {
        for (const ContourTerrain& terrain : contour_terrains()) {
            const std::string name = terrain.name;
            CAPTURE(name);
            const std::vector<Point3> points = points_of(contours_of(terrain, kInterval, 30));
            Tin tin = triangulate(points).tin;
            const Tin before = tin;
            const FlatFacesReport report = remove_flat_faces(tin, FlatFaces::Insert, {}, true);
            CHECK(report.swapped == 0);
            CHECK(report.inserted > 0);
            CHECK(is_sound(tin));
            CHECK(check_delaunay(tin).is_clean());
            check_vertices(before, tin, report.inserted);
            TriangulateOptions options;
            options.optimize.emplace().criterion = Criterion::Angle;
            options.before_optimum = [](Tin& made, const std::vector<bool>& is_water) {
                remove_flat_faces(made, FlatFaces::Insert, is_water, true);
            };
            const Triangulated optimal = triangulate(points, options);
            CHECK(is_sound(optimal.tin));
            CHECK(optimal.tin.vertex_count() == tin.vertex_count());
            CHECK(optimal.report.faces == optimal.tin.mesh.count_terrain());
        }
    }

    TEST_CASE("a plateau that samples fill is kept, its rim and steps are not") {
        Tin tin = lattice_tin(20, [](int x, int y) {
            return x >= 5 && x <= 14 && y >= 5 && y <= 14 ? 8.0 : x * 0.25 + y * 0.125;
        });
        const auto has_plateau = [&] {
            std::size_t level = 0;
            for (const auto& face : faces_of(tin)) {
                level += std::all_of(face.begin(), face.end(),
                                     [](const Point3& p) {
                                         return p.z == 8 && p.x >= 6 && p.x <= 13 && p.y >= 6 && p.y <= 13;
                                     })
                             ? 1U
                             : 0U;
            }
            return level == 98;  // of seven by seven squares
        };
        CHECK(has_plateau());
        remove_flat_faces(tin, FlatFaces::Insert);
        CHECK(has_plateau());
        CHECK(is_sound(tin));

        // Level everywhere: nothing tells which way to go.
        Tin level = lattice_tin(9, [](int, int) { return 4.0; });
        const auto words = words_of(level);
        const FlatFacesReport report = remove_flat_faces(level, FlatFaces::Insert);
        CHECK(report.before == 128);
        CHECK(report.after == 128);
        CHECK(words_of(level) == words);
    }

    TEST_CASE("regions that touch at a vertex only are treated apart") {
        // Two triangles of one contour, tip to tip.
        const std::vector<Point3> samples = {{0, 0, 5},   {-4, 2, 5}, {-4, -2, 5}, {4, 2, 5},  {4, -2, 5},
                                             {-9, 0, 10}, {9, 0, 10}, {0, 3, 0},   {0, -3, 0}, {-9, 7, 1},
                                             {-9, -7, 2}, {9, 7, 3},  {9, -7, 4}};
        for (const FlatFaces how : {FlatFaces::Swap, FlatFaces::Insert}) {
            const Tin before = triangulate(samples).tin;
            Tin tin = before;
            const FlatFacesReport report = remove_flat_faces(tin, how);
            check_treatment(before, tin, report);
            CHECK(report.before == 2);
            CHECK(report.after == 0);
        }
    }

    TEST_CASE("TINs of any kind stay sound") {
        for (int seed = 0; seed < cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            for (const std::span<const TinFamily> families : {general_families(), degenerate_families()}) {
                for (const TinFamily& family : families) {
                    CAPTURE(family.name);
                    Tin tin = family.make(random, 40);
                    if (tin.mesh.count_terrain() == 0) {
                        continue;
                    }
                    for (double& z : tin.z) {
                        z = static_cast<double>(random.integer(0, 2));
                    }
                    flip_at_random(random, tin, static_cast<int>(random.integer(0, 10)));
                    constrain_at_random(random, tin, static_cast<int>(random.integer(0, 20)));
                    make_voids_at_random(random, tin, static_cast<int>(random.integer(0, 5)));
                    for (const FlatFaces how : {FlatFaces::Keep, FlatFaces::Swap, FlatFaces::Insert}) {
                        CAPTURE(how);
                        Tin treated = tin;
                        const FlatFacesReport report = remove_flat_faces(treated, how);
                        CHECK(is_sound(treated));
                        CHECK(report.before == flat_count(tin));
                        CHECK(report.after == flat_count(treated));
                        CHECK(constrained_edges_of(treated) == constrained_edges_of(tin));
                        check_vertices(tin, treated, report.inserted);
                    }
                }
            }
        }
    }
}
