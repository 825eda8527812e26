#include "tinwright/mesh/triangle_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

std::size_t count_ghosts(const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        count += mesh.is_ghost({f}) ? 1 : 0;
    }
    return count;
}

bool is_clean(const TriangleMesh& mesh, std::size_t turns) {
    const MeshCheckReport report = check_mesh(mesh, {.turns = turns});
    if (!report.is_clean()) {
        MESSAGE(report.violations[0].text);
    }
    return report.is_clean();
}

/// Number of closed loops that the ghosts form.
std::size_t count_ghost_loops(const TriangleMesh& mesh) {
    std::vector<bool> is_seen(mesh.slot_count(), false);
    std::size_t loops = 0;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (!mesh.is_ghost({f}) || is_seen[f]) {
            continue;
        }
        ++loops;
        for (FaceId g{f}; !is_seen[g.value]; g = face_of(mesh.twin(half_edge(g, 1)))) {
            is_seen[g.value] = true;
        }
    }
    return loops;
}

std::string refusal_of(std::size_t vertex_count, const std::vector<std::uint32_t>& corners) {
    return message_of<InputError>([&] { mesh_of(vertex_count, corners); });
}

}  // namespace

TEST_SUITE("mesh/triangle_mesh") {
    TEST_CASE("half-edge arithmetic goes round a face") {
        const HalfEdgeId h = half_edge({5}, 2);
        CHECK(h.value == 22);
        CHECK(face_of(h) == FaceId{5});
        CHECK(corner_of(h) == 2);
        CHECK(next(h) == half_edge({5}, 0));
        CHECK(previous(h) == half_edge({5}, 1));
        for (unsigned corner = 0; corner < 3; ++corner) {
            CHECK(next_corner(corner) == (corner + 1) % 3);
            CHECK(previous_corner(corner) == (corner + 2) % 3);
        }
    }

    TEST_CASE("one face is closed by three ghosts") {
        const TriangleMesh mesh = mesh_of(3, {0, 1, 2});
        CHECK(mesh.slot_count() == 4);
        CHECK(mesh.count_terrain() == 1);
        CHECK(count_ghosts(mesh) == 3);
        CHECK(is_clean(mesh, 1));
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({0}, i);
            CHECK(mesh.is_border(h));
            CHECK_FALSE(mesh.is_border(mesh.twin(h)));
            CHECK(mesh.origin(mesh.twin(h)) == mesh.destination(h));
            CHECK(mesh.vertex(face_of(mesh.twin(h)), 2) == kGhostVertex);
        }
    }

    TEST_CASE("faces that share an edge are twins along it") {
        const TriangleMesh mesh = mesh_of(4, {0, 1, 2, 2, 1, 3});
        CHECK(mesh.count_terrain() == 2);
        CHECK(count_ghosts(mesh) == 4);
        CHECK(mesh.twin(half_edge({0}, 1)) == half_edge({1}, 0));
        CHECK(is_clean(mesh, 1));
        CHECK(count_ghost_loops(mesh) == 1);
    }

    TEST_CASE("no face makes an empty mesh") {
        const TriangleMesh mesh = mesh_of(7, {});
        CHECK(mesh.slot_count() == 0);
        CHECK(mesh.vertex_count() == 7);
        CHECK(is_clean(mesh, 1));
    }

    TEST_CASE("faces that touch at a vertex give it a turn each") {
        const TriangleMesh mesh = mesh_of(5, {0, 1, 2, 0, 3, 4});
        CHECK(is_clean(mesh, 2));
        CHECK(is_clean(mesh, 0));
        CHECK(count_ghost_loops(mesh) == 2);
        const MeshCheckReport report = check_mesh(mesh);
        CHECK(report.count == 1);
        CHECK(report.violations[0].invariant == 8);
        CHECK(report.violations[0].text == "vertex 0 has more than 1 turn(s) of faces around it");
    }

    TEST_CASE("a ring of faces has two border loops") {
        // A square ring: outer corners 0 to 3, inner corners 4 to 7.
        std::vector<std::uint32_t> corners;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t j = (i + 1) % 4;
            for (const std::uint32_t v : {i, j, 4 + i, j, 4 + j, 4 + i}) {
                corners.push_back(v);
            }
        }
        const TriangleMesh mesh = mesh_of(8, corners);
        CHECK(mesh.count_terrain() == 8);
        CHECK(count_ghosts(mesh) == 8);
        CHECK(count_ghost_loops(mesh) == 2);
        CHECK(is_clean(mesh, 1));
        // Outer corner 0 and inner corner 4 made one, without the faces next to either: the ring ends there.
        for (std::uint32_t& v : corners) {
            v = v == 4 ? 0 : v;
        }
        corners.erase(corners.begin() + 18, corners.end());
        corners.erase(corners.begin(), corners.begin() + 3);
        const TriangleMesh pinched = mesh_of(8, corners);
        CHECK(is_clean(pinched, 0));
    }

    TEST_CASE("any subset of a triangulation's faces makes a clean mesh") {
        for (int seed = 0; seed < cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = delaunay_tin(key_families()[2].make(random, 80));
            std::vector<std::uint32_t> corners;
            std::vector<std::size_t> border_degree(tin.vertex_count(), 0);
            for (const std::array<std::uint32_t, 3>& face : terrain_of(tin.mesh)) {
                if (random.integer(0, 2) != 0) {
                    corners.insert(corners.end(), face.begin(), face.end());
                }
            }
            const TriangleMesh mesh = mesh_of(tin.vertex_count(), shuffled_faces(random, corners));
            REQUIRE(mesh.count_terrain() == corners.size() / 3);
            REQUIRE(is_clean(mesh, 0));
            // A vertex with k border edges leaving it turns k times, or once when it has none.
            for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
                if (mesh.is_ghost({f})) {
                    ++border_degree[mesh.vertex({f}, 0).value];
                }
            }
            const std::size_t most = *std::max_element(border_degree.begin(), border_degree.end());
            REQUIRE(is_clean(mesh, std::max<std::size_t>(1, most)));
            REQUIRE((most < 2 || !check_mesh(mesh, {.turns = most - 1}).is_clean()));
        }
    }

    TEST_CASE("a Delaunay mesh's faces make the same mesh again") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(1);
            Tin tin = delaunay_tin(family.make(random, 300));
            const std::vector<std::array<std::uint32_t, 3>> faces = terrain_of(tin.mesh);
            if (faces.empty()) {
                continue;
            }
            std::vector<std::uint32_t> corners;
            for (const auto& face : faces) {
                corners.insert(corners.end(), face.begin(), face.end());
            }
            tin.mesh = mesh_of(tin.vertex_count(), shuffled_faces(random, corners));
            REQUIRE(tin.mesh.slot_count() == 2 * tin.vertex_count() - 2);
            REQUIRE(is_clean(tin.mesh, 1));
            REQUIRE(check_delaunay(tin).is_clean());
            REQUIRE(terrain_of(tin.mesh) == faces);
        }
    }

    TEST_CASE("unusable faces are refused by number") {
        CHECK(refusal_of(3, {0, 1}) == "the number of corners, 2, is not a multiple of three");
        CHECK(refusal_of(3, {0, 1, 3}) == "face 0: corner 3 is not one of the 3 vertices");
        CHECK(refusal_of(4, {0, 1, 2, 3, 1, 3}) == "face 1: two corners are the same vertex");
        CHECK(refusal_of(4, {0, 1, 2, 0, 1, 3}) ==
              "face 1: the edge between vertices 0 and 1 is used in the same direction, also by face 0");
        CHECK(refusal_of(5, {0, 1, 2, 1, 0, 3, 0, 1, 4}) ==
              "face 2: the edge between vertices 0 and 1 is used by more than two faces, also by face 1");
    }

    TEST_CASE("an edge is constrained on both its sides") {
        TriangleMesh mesh = mesh_of(4, {0, 1, 2, 2, 1, 3});
        const HalfEdgeId h = half_edge({0}, 1);
        mesh.set_constrained(h, true);
        CHECK(mesh.is_constrained(h));
        CHECK(mesh.is_constrained(mesh.twin(h)));
        CHECK_FALSE(mesh.is_constrained(next(h)));
        CHECK(is_clean(mesh, 1));
        mesh.set_constrained(mesh.twin(h), false);
        CHECK_FALSE(mesh.is_constrained(h));
        CHECK_FALSE(mesh.is_constrained(mesh.twin(h)));
    }

    TEST_CASE("a face marked outside is no terrain, and a ghost never is") {
        TriangleMesh mesh = mesh_of(4, {0, 1, 2, 2, 1, 3});
        mesh.set_constrained(half_edge({0}, 1), true);
        mesh.set_terrain({1}, false);
        CHECK_FALSE(mesh.is_terrain({1}));
        CHECK(mesh.count_terrain() == 1);
        CHECK(mesh.is_border(half_edge({0}, 1)));
        CHECK(mesh.is_constrained(half_edge({0}, 1)));
        mesh.set_terrain({1}, true);
        CHECK(mesh.count_terrain() == 2);
        const FaceId ghost = face_of(mesh.twin(half_edge({0}, 0)));
        mesh.set_terrain(ghost, true);
        CHECK_FALSE(mesh.is_terrain(ghost));
        CHECK(is_clean(mesh, 1));
    }
}
