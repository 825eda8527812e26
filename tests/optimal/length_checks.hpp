#ifndef TINWRIGHT_TESTS_OPTIMAL_LENGTH_CHECKS_HPP
#define TINWRIGHT_TESTS_OPTIMAL_LENGTH_CHECKS_HPP

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/optimal/optimize.hpp"

#include "support/length_oracle.hpp"
#include "support/length_tins.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

/// What has to hold of every TIN whose longest edge was made short.
namespace tinwright_tests {

inline tinwright::OptimizeReport optimize_length(tinwright::Tin& tin, tinwright::Norm norm = {}) {
    tinwright::OptimizeOptions options;
    options.criterion = tinwright::Criterion::Length;
    options.norm = norm;
    return tinwright::optimize(tin, options);
}

/// The length of the longest edge of the terrain, CRS units.
inline double longest_of(const tinwright::Tin& tin, tinwright::Norm norm) {
    constexpr auto kLength = tinwright::Criterion::Length;
    return report_of(tin, kLength, badnesses_of(tin, kLength, Faces::Terrain, norm).front());
}

inline oracle::Edge ascending(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

inline std::set<oracle::Edge> edges_of(const tinwright::Tin& tin, bool only_constrained) {
    std::set<oracle::Edge> edges;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; !tin.mesh.is_ghost({f}) && i < 3; ++i) {
            const tinwright::HalfEdgeId h = tinwright::half_edge({f}, i);
            if (!only_constrained || tin.mesh.is_constrained(h)) {
                edges.insert(ascending(tin.mesh.origin(h).value, tin.mesh.destination(h).value));
            }
        }
    }
    return edges;
}

/// Vertices, constrained edges, domain and number of faces are those of the start, and the TIN is sound.
inline void check_kept(const tinwright::Tin& start, const tinwright::Tin& tin) {
    REQUIRE(is_sound(tin));
    REQUIRE(std::equal(start.keys.begin(), start.keys.end(), tin.keys.begin(), tin.keys.end()));
    REQUIRE(std::equal(start.z.begin(), start.z.end(), tin.z.begin(), tin.z.end()));
    REQUIRE(std::equal(start.sample.begin(), start.sample.end(), tin.sample.begin(), tin.sample.end()));
    REQUIRE(start.traces == tin.traces);
    REQUIRE(start.mesh.slot_count() == tin.mesh.slot_count());
    REQUIRE(start.mesh.count_terrain() == tin.mesh.count_terrain());
    REQUIRE(edges_of(start, true) == edges_of(tin, true));
    const oracle::Terrain before = oracle::terrain_sites(start);
    const oracle::Terrain after = oracle::terrain_sites(tin);
    REQUIRE(before.voids == after.voids);
    REQUIRE(before.hidden == after.hidden);
    REQUIRE(before.sites.constraints == after.sites.constraints);
}

/// The report of a run that was not stopped.
inline void check_length_report(const tinwright::Tin& start, const tinwright::Tin& tin,
                                const tinwright::OptimizeReport& report, tinwright::Norm norm) {
    REQUIRE(are_close(report.before.all, longest_of(start, norm)));
    REQUIRE(are_close(report.after.all, longest_of(tin, norm)));
    REQUIRE(report.after.interior.value_or(0) <= report.after.all);
    REQUIRE(report.proof == tinwright::Proof::Theorem);
    REQUIRE(report.stopped_by == tinwright::StoppedBy::Finished);
    REQUIRE(report.seconds >= 0);
    REQUIRE(report.length.has_value());
    REQUIRE(report.length->changed <= report.length->polygons);
    REQUIRE(report.length->incomplete <= report.length->polygons);
    REQUIRE((report.length->polygons == 0 || report.length->largest >= 4));
    REQUIRE((report.length->changed == 0) == (report.insertions == 0));
    if (norm.is_euclidean()) {
        REQUIRE((report.length->changed == 0) == (terrain_of(start.mesh) == terrain_of(tin.mesh)));
    }
    if (report.before.all == report.after.all) {
        REQUIRE(terrain_of(start.mesh) == terrain_of(tin.mesh));
    }
}

/// No edge between terrain faces that is free to be flipped could be flipped to a Delaunay edge no longer
/// than the TIN's longest.
inline void check_flipped_back(const tinwright::Tin& tin, const oracle::LengthRanks& ranks) {
    const std::uint32_t longest = oracle::longest_edge(tin, ranks);
    const tinwright::TriangleMesh& mesh = tin.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const tinwright::HalfEdgeId h = tinwright::half_edge({f}, i);
            if (mesh.is_constrained(h) || !mesh.is_terrain(tinwright::face_of(mesh.twin(h)))) {
                continue;
            }
            const tinwright::VertexId a = mesh.origin(h);
            const tinwright::VertexId b = mesh.destination(h);
            const tinwright::VertexId c = mesh.origin(tinwright::previous(h));
            const tinwright::VertexId d = mesh.origin(tinwright::previous(mesh.twin(h)));
            if (oracle::incircle(tin.key(a), tin.key(b), tin.key(c), tin.key(d)) > 0) {
                REQUIRE(ranks.rank(c.value, d.value) > longest);
            }
        }
    }
}

/// In the Euclidean norm, whose graph is in the TIN: the longest edge is a wall or what a polygon needs,
/// polygons without a longer edge keep their faces, the others do not.
inline void check_polygons(const tinwright::Tin& start, const tinwright::Tin& tin,
                           const tinwright::OptimizeReport& report) {
    const oracle::LengthRanks ranks({}, start.keys);
    const std::uint32_t longest = oracle::longest_edge(tin, ranks);
    const std::set<oracle::Edge> graph = oracle::relative_neighbors(start, ranks);
    const std::vector<oracle::Region> before = oracle::regions_of(start, graph);
    const std::vector<oracle::Region> regions = oracle::regions_of(tin, graph);
    REQUIRE(before.size() == regions.size());
    if (oracle::terrain_sites(start)
            .voids.empty()) {  // the graph of the oracle looks across voids of three sides
        const std::set<oracle::Edge> constrained = edges_of(start, true);
        const auto count = std::count_if(graph.begin(), graph.end(),
                                         [&](const auto& edge) { return !constrained.contains(edge); });
        CHECK(report.length->graph_edges == static_cast<std::size_t>(count));
    }
    std::uint32_t needed = 0;
    std::size_t changed = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        CAPTURE(regions[r].ring);
        REQUIRE(before[r].ring == regions[r].ring);
        const auto least = oracle::least_longest_edge(start.keys, regions[r].ring, ranks);
        REQUIRE(least.has_value());
        needed = std::max(needed, *least);
        const bool is_kept = before[r].faces == regions[r].faces;
        REQUIRE(is_kept == (oracle::longest_edge(before[r], ranks) <= longest));
        changed += is_kept ? 0U : 1U;
    }
    REQUIRE(needed == longest);
    CHECK(report.length->changed == changed);
}

}  // namespace tinwright_tests

#endif
