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
    if (norm.is_euclidean()) {
        REQUIRE((report.length->changed == 0) == (terrain_of(start.mesh) == terrain_of(tin.mesh)));
        REQUIRE((report.length->changed == 0) == (report.insertions == 0));
    }
}

/// Polygons that were triangulated anew.
struct ChangedPolygons {
    std::size_t complete = 0;
    std::size_t incomplete = 0;  ///< with a side that is longer than need be
    ChangedPolygons& operator+=(ChangedPolygons other) {
        complete += other.complete;
        incomplete += other.incomplete;
        return *this;
    }
};

/// All diagonals of the region come before the shortest of its long sides.
inline void check_diagonals(const oracle::Region& region, const std::vector<oracle::Edge>& long_sides,
                            const oracle::LengthRanks& ranks) {
    std::uint32_t shortest = UINT32_MAX;
    for (const oracle::Edge& side : long_sides) {
        shortest = std::min(shortest, ranks.place(side[0], side[1]));
    }
    std::set<oracle::Edge> sides;
    for (std::size_t i = 0; i < region.ring.size(); ++i) {
        sides.insert(ascending(region.ring[i], region.ring[(i + 1) % region.ring.size()]));
    }
    for (const oracle::Triple& face : region.faces) {
        for (const oracle::Edge& edge :
             {oracle::Edge{face[0], face[1]}, {face[1], face[2]}, {face[0], face[2]}}) {
            REQUIRE((sides.contains(edge) || ranks.place(edge[0], edge[1]) < shortest));
        }
    }
}

/// Every polygon of the subdivision by the relative neighbourhood graph is optimal by itself. In the
/// Euclidean norm it was left alone if it was before; else those with long sides have diagonals shorter than
/// these.
inline ChangedPolygons check_polygons(const tinwright::Tin& start, const tinwright::Tin& tin,
                                      const tinwright::OptimizeReport& report, tinwright::Norm norm) {
    const oracle::LengthRanks ranks(norm, start.keys);
    const std::set<oracle::Edge> graph = oracle::relative_neighbors(start, ranks);
    const std::set<oracle::Edge> edges = edges_of(tin, false);
    REQUIRE(std::includes(edges.begin(), edges.end(), graph.begin(), graph.end()));
    const std::vector<oracle::Region> regions = oracle::regions_of(tin, graph);
    const std::vector<oracle::Region> regions_before =
        norm.is_euclidean() ? oracle::regions_of(start, graph) : std::vector<oracle::Region>();
    tinwright::LengthReport expected;
    ChangedPolygons changed;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        const oracle::Region& region = regions[r];
        CAPTURE(region.ring);
        REQUIRE(region.faces.size() + 2 == region.ring.size());  // simply connected
        const std::uint32_t longest = oracle::longest_edge(region, ranks);
        REQUIRE(oracle::least_longest_edge(start.keys, region.ring, ranks) == longest);
        const std::vector<oracle::Edge> long_sides = oracle::long_sides(region, start.keys, ranks);
        if (region.faces.size() > 1) {
            ++expected.polygons;
            expected.incomplete += long_sides.empty() ? 0U : 1U;
            expected.largest = std::max(expected.largest, region.ring.size());
        }
        if (regions_before.empty()) {
            continue;
        }
        REQUIRE(regions_before[r].ring == region.ring);
        const bool is_kept = regions_before[r].faces == region.faces;
        REQUIRE(is_kept == (oracle::longest_edge(regions_before[r], ranks) == longest));
        if (!is_kept) {
            ++(long_sides.empty() ? changed.complete : changed.incomplete);
            check_diagonals(region, long_sides, ranks);
        }
    }
    REQUIRE(report.length.has_value());
    CHECK(report.length->polygons == expected.polygons);
    CHECK(report.length->incomplete == expected.incomplete);
    CHECK(report.length->largest == expected.largest);
    if (norm.is_euclidean()) {
        CHECK(report.length->changed == changed.complete + changed.incomplete);
    }
    return changed;
}

}  // namespace tinwright_tests

#endif
