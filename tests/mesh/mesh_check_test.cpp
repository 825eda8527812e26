#include "tinwright/mesh/mesh_check.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Face = TriangleMesh::Face;

/// The report on a clean mesh of two faces after `breaking` has spoilt its records.
MeshCheckReport report_on(const std::function<void(TriangleMesh::Faces&)>& breaking) {
    const TriangleMesh clean = mesh_of(4, {0, 1, 2, 2, 1, 3});
    REQUIRE(check_mesh(clean).is_clean());
    TriangleMesh::Faces faces;
    for (std::uint32_t f = 0; f < clean.slot_count(); ++f) {
        faces.push_back(clean.face({f}));
    }
    breaking(faces);
    return check_mesh(TriangleMesh(4, faces));
}

bool names(const MeshCheckReport& report, int invariant, const std::string& text) {
    return std::any_of(report.violations.begin(), report.violations.end(),
                       [&](const MeshViolation& v) { return v.invariant == invariant && v.text == text; });
}

}  // namespace

TEST_SUITE("mesh/mesh_check") {
    TEST_CASE("M1: a twin that is no half-edge, not mutual, or of the same face is found") {
        CHECK(names(report_on([](auto& faces) { faces[0].twin[1] = {3}; }), 1,
                    "half-edge 1 of face 0: its twin 3 is no half-edge"));
        CHECK(names(report_on([](auto& faces) { faces[0].twin[1] = {4000}; }), 1,
                    "half-edge 1 of face 0: its twin 4000 is no half-edge"));
        CHECK(names(report_on([](auto& faces) { faces[0].twin[1] = half_edge({1}, 1); }), 1,
                    "half-edge 1 of face 0: the twin of its twin is another half-edge"));
        CHECK(names(report_on([](auto& faces) { faces[0].twin[1] = half_edge({0}, 1); }), 1,
                    "half-edge 1 of face 0: its twin belongs to the same face"));
    }

    TEST_CASE("M2: twins with other ends are found") {
        const MeshCheckReport report = report_on([](auto& faces) { faces[1].vertex[1] = {0}; });
        CHECK(names(report, 2, "half-edge 1 of face 0: its twin, half-edge 0 of face 1, has other ends"));
    }

    TEST_CASE("M3: repeated and unknown corners are found") {
        CHECK(names(report_on([](auto& faces) { faces[1].vertex[2] = {1}; }), 3,
                    "face 1: vertex 1 is a corner twice"));
        CHECK(names(report_on([](auto& faces) { faces[1].vertex[2] = {4}; }), 3,
                    "face 1: there is no vertex 4"));
    }

    TEST_CASE("M4: a ghost vertex at another corner is found") {
        CHECK(names(report_on([](auto& faces) { faces[1].vertex[0] = kGhostVertex; }), 4,
                    "face 1: the ghost vertex stands at corner 0"));
    }

    TEST_CASE("M5: an edge constrained on one side only is found once") {
        const MeshCheckReport report = report_on([](auto& faces) { faces[0].marks = 2; });
        CHECK(report.count == 1);
        CHECK(names(report, 5, "half-edge 1 of face 0: constrained in one of its two faces only"));
        CHECK(report_on([](auto& faces) { faces[1].marks = 1; }).count == 1);
    }

    TEST_CASE("M6: unknown marks are found") {
        const MeshCheckReport report = report_on([](auto& faces) { faces[1].marks = 16 + 8; });
        CHECK(report.count == 1);
        CHECK(names(report, 6, "face 1: unknown marks 24"));
        const MeshCheckReport scratch = report_on([](auto& faces) { faces[1].scratch = 1; });
        CHECK(scratch.count == 1);
        CHECK(names(scratch, 6, "face 1: scratch is not cleared"));
    }

    TEST_CASE("M7: two edges between the same vertices in one turn are found") {
        // Vertices 0 and 1 joined by two edges, with vertex 2 between these and vertex 3 beyond them.
        TriangleMesh::Faces faces(4, Face{});
        faces[0].vertex = {{{0}, {1}, {2}}};
        faces[1].vertex = {{{1}, {0}, {2}}};
        faces[2].vertex = {{{1}, {0}, {3}}};
        faces[3].vertex = {{{0}, {1}, {3}}};
        const auto link = [&](HalfEdgeId h, HalfEdgeId g) {
            faces[face_of(h).value].twin[corner_of(h)] = g;
            faces[face_of(g).value].twin[corner_of(g)] = h;
        };
        link(half_edge({0}, 0), half_edge({2}, 0));
        link(half_edge({1}, 0), half_edge({3}, 0));
        link(half_edge({0}, 1), half_edge({1}, 2));
        link(half_edge({0}, 2), half_edge({1}, 1));
        link(half_edge({2}, 1), half_edge({3}, 2));
        link(half_edge({2}, 2), half_edge({3}, 1));
        const MeshCheckReport report = check_mesh(TriangleMesh(4, faces));
        CHECK(report.count == 2);
        CHECK(names(report, 7, "vertex 0 has two edges to vertex 1 in one turn"));
        CHECK(names(report, 7, "vertex 1 has two edges to vertex 0 in one turn"));
    }

    TEST_CASE("M8: more turns than allowed are found, one violation a vertex") {
        const TriangleMesh mesh = mesh_of(9, {0, 1, 2, 0, 3, 4, 0, 5, 6, 7, 8, 1});
        CHECK(check_mesh(mesh).count == 2);
        CHECK(check_mesh(mesh, {.turns = 2}).count == 1);
        CHECK(check_mesh(mesh, {.turns = 3}).is_clean());
        CHECK(check_mesh(mesh, {.turns = 0}).is_clean());
    }

    TEST_CASE("all violations are counted, no more than the limit are described") {
        Random random(1);
        const TriangleMesh clean = delaunay_tin(key_families()[2].make(random, 200)).mesh;
        TriangleMesh::Faces faces;
        for (std::uint32_t f = 0; f < clean.slot_count(); ++f) {
            faces.push_back(clean.face({f}));
            faces.back().marks = 32;
        }
        const MeshCheckReport report = check_mesh(TriangleMesh(clean.vertex_count(), faces), {.limit = 5});
        CHECK(report.count == clean.slot_count());
        CHECK(report.violations.size() == 5);
    }
}
