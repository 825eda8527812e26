#include "tinwright/mesh/mesh_edit.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using FaceList = std::vector<std::array<std::uint32_t, 3>>;
using EdgeSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;

/// The half-edge from one vertex to another, in a face that is not a ghost.
std::optional<HalfEdgeId> find_half_edge(const TriangleMesh& mesh, std::uint32_t from, std::uint32_t to) {
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (!mesh.is_ghost({f}) && mesh.origin(h).value == from && mesh.destination(h).value == to) {
                return h;
            }
        }
    }
    return std::nullopt;
}

EdgeSet constrained_edges(const TriangleMesh& mesh) {
    EdgeSet edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (mesh.is_constrained(h)) {
                edges.insert(std::minmax(mesh.origin(h).value, mesh.destination(h).value));
            }
        }
    }
    return edges;
}

/// What lies across each edge of faces that are to take the place of those in `slots`: the rim where the edge
/// was an edge of the cavity to the outside or is constrained (a crack), else another new face.
std::vector<CavityFace> make_cavity(const TriangleMesh& mesh, const std::vector<FaceId>& slots,
                                    const FaceList& faces) {
    const auto is_inside = [&](FaceId f) { return std::find(slots.begin(), slots.end(), f) != slots.end(); };
    const auto rim_at = [&](std::uint32_t from, std::uint32_t to) -> std::optional<HalfEdgeId> {
        const auto h = find_half_edge(mesh, from, to);
        const bool is_rim =
            h && is_inside(face_of(*h)) && (!is_inside(face_of(mesh.twin(*h))) || mesh.is_constrained(*h));
        return is_rim ? h : std::nullopt;
    };
    std::vector<CavityFace> cavity;
    for (const auto& face : faces) {
        CavityFace& record = cavity.emplace_back();
        for (unsigned i = 0; i < 3; ++i) {
            record.vertex[i] = {face[i]};
            const std::uint32_t from = face[i];
            const std::uint32_t to = face[(i + 1) % 3];
            if (const auto old = rim_at(from, to)) {
                record.across[i] = CavityFace::Across::rim(*old);
                continue;
            }
            for (std::uint32_t other = 0; other < faces.size(); ++other) {
                for (unsigned j = 0; j < 3; ++j) {
                    if (faces[other][j] == to && faces[other][(j + 1) % 3] == from) {
                        record.across[i] = CavityFace::Across::inner(other, j);
                    }
                }
            }
        }
    }
    return cavity;
}

/// A square whose corners are 0 to 3, counter-clockwise, cut from 0 to 2, with a fifth vertex east of it.
///
///   3---2
///   | / | \ 4
///   0---1 /
Tin square_and_tip() {
    const std::vector<oracle::Site> sites{
        {{0, 0}, 0}, {{10, 0}, 0}, {{10, 10}, 0}, {{0, 10}, 0}, {{15, 5}, 0}};
    Tin tin;
    for (const oracle::Site& site : sites) {
        tin.keys.push_back(site.key);
    }
    tin.z.assign(5, 0.0);
    tin.sample.assign(5, Tin::kNoSample);
    tin.mesh = mesh_of(5, {0, 1, 2, 0, 2, 3, 1, 4, 2});
    return tin;
}

}  // namespace

TEST_SUITE("mesh/mesh_edit") {
    TEST_CASE("a flip puts the other diagonal where the edge was") {
        Tin tin = square_and_tip();
        TriangleMesh& mesh = tin.mesh;
        const HalfEdgeId h = *find_half_edge(mesh, 2, 0);
        const FaceId near = face_of(h);
        const FaceId far = face_of(mesh.twin(h));
        flip_edge(mesh, h);
        CHECK(check_mesh(mesh).is_clean());
        CHECK(terrain_of(mesh) == FaceList{{0, 1, 3}, {1, 2, 3}, {1, 4, 2}});
        CHECK(mesh.origin(h).value + mesh.destination(h).value == 4);  // 1 and 3
        CHECK(face_of(h) == near);
        CHECK(face_of(mesh.twin(h)) == far);
    }

    TEST_CASE("a flip keeps the marks of the four edges around it, and makes an edge without a mark") {
        for (unsigned marks = 0; marks < 16; ++marks) {
            CAPTURE(marks);
            TriangleMesh mesh = square_and_tip().mesh;
            for (std::uint32_t side = 0; side < 4; ++side) {
                mesh.set_constrained(*find_half_edge(mesh, side, (side + 1) % 4), (marks >> side & 1U) != 0);
            }
            const EdgeSet before = constrained_edges(mesh);
            const HalfEdgeId h = *find_half_edge(mesh, 0, 2);
            flip_edge(mesh, h);
            CHECK(check_mesh(mesh).is_clean());
            CHECK(constrained_edges(mesh) == before);
            CHECK_FALSE(mesh.is_constrained(h));
        }
    }

    TEST_CASE("flipping an edge twice gives the same faces again, four times the same records") {
        TriangleMesh mesh = square_and_tip().mesh;
        const TriangleMesh start = mesh;
        const HalfEdgeId h = *find_half_edge(mesh, 0, 2);
        flip_edge(mesh, h);
        flip_edge(mesh, h);
        CHECK(terrain_of(mesh) == terrain_of(start));
        CHECK(mesh.origin(h) == start.destination(h));
        flip_edge(mesh, h);
        flip_edge(mesh, h);
        for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
            CHECK(mesh.face({f}).vertex == start.face({f}).vertex);
            CHECK(mesh.face({f}).twin == start.face({f}).twin);
            CHECK(mesh.face({f}).marks == start.face({f}).marks);
        }
    }

    TEST_CASE("after any sequence of flips mesh and TIN pass their audits, and constrained edges are there") {
        for (int seed = 0; seed < cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = general_families()[static_cast<std::size_t>(seed) % 4].make(random, 30);
            constrain_at_random(random, tin, static_cast<int>(random.integer(0, 10)));
            const EdgeSet constrained = constrained_edges(tin.mesh);
            const auto start = terrain_of(tin.mesh);
            for (int round = 0; round < 10; ++round) {
                flip_at_random(random, tin, 20);
                REQUIRE(is_sound(tin));
                REQUIRE(constrained_edges(tin.mesh) == constrained);
            }
            REQUIRE(terrain_of(tin.mesh) != start);
        }
    }

    TEST_CASE("refilling the cavity of two faces is a flip") {
        TriangleMesh flipped = square_and_tip().mesh;
        TriangleMesh refilled = flipped;
        const HalfEdgeId h = *find_half_edge(flipped, 0, 2);
        const std::vector<FaceId> slots{face_of(h), face_of(flipped.twin(h))};
        flip_edge(flipped, h);
        const FaceList faces{{1, 2, 3}, {0, 1, 3}};
        refill_cavity(refilled, slots, make_cavity(refilled, slots, faces));
        CHECK(check_mesh(refilled).is_clean());
        CHECK(terrain_of(refilled) == terrain_of(flipped));
        CHECK(refilled.vertex(slots[0], 2) == VertexId{3});  // slots[i] takes faces[i]
        CHECK(refilled.vertex(slots[1], 0) == VertexId{0});
    }

    TEST_CASE("a cavity around a crack: an edge within it that stays, on both sides [tan1993, Fig. 3.1]") {
        // From q to s below the vertex c, which hangs on b: the faces on both sides of b c are crossed.
        enum : std::uint32_t { q, s, b, c, x, y };
        Tin tin;
        for (const Key2 key : {Key2{0, 2}, Key2{10, 2}, Key2{5, 12}, Key2{5, 3}, Key2{3, 0}, Key2{7, 0}}) {
            tin.keys.push_back(key);
        }
        tin.z.assign(6, 0.0);
        tin.sample.assign(6, Tin::kNoSample);
        const FaceList after{{q, s, c}, {q, c, b}, {c, s, b}, {q, x, s}, {x, y, s}};
        for (const bool is_constrained : {false, true}) {
            CAPTURE(is_constrained);
            tin.mesh = mesh_of(6, {q, x, b, x, c, b, x, y, c, c, y, b, y, s, b});
            tin.mesh.set_constrained(*find_half_edge(tin.mesh, q, x), true);
            const HalfEdgeId crack = *find_half_edge(tin.mesh, c, b);
            tin.mesh.set_constrained(crack, true);  // so that `make_cavity` takes it for a crack
            const HalfEdgeId other_side = tin.mesh.twin(crack);
            const std::vector<FaceId> slots{{3}, {0}, {4}, {1}, {2}};
            std::vector<CavityFace> faces = make_cavity(tin.mesh, slots, after);
            REQUIRE(faces[1].across[1].is_rim());
            REQUIRE(faces[1].across[1].old() == crack);
            REQUIRE(faces[2].across[2].old() == other_side);
            tin.mesh.set_constrained(crack, is_constrained);
            refill_cavity(tin.mesh, slots, faces);
            CHECK(check_mesh(tin.mesh).is_clean());
            FaceList expected = after;
            for (auto& face : expected) {
                std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
            }
            std::sort(expected.begin(), expected.end());
            CHECK(terrain_of(tin.mesh) == expected);
            CHECK(constrained_edges(tin.mesh) ==
                  (is_constrained ? EdgeSet{{q, x}, {b, c}} : EdgeSet{{q, x}}));
        }
    }

    TEST_CASE("any cavity can be refilled by any other triangulation of it, in any order") {
        for (int seed = 0; seed < cases(1000); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = general_families()[static_cast<std::size_t>(seed) % 4].make(random, 25);
            constrain_at_random(random, tin, static_cast<int>(random.integer(0, 10)));
            // A patch of faces, each next to one before.
            std::vector<FaceId> slots;
            for (std::uint32_t f = 0; f < tin.mesh.slot_count() && slots.empty(); ++f) {
                if (tin.mesh.is_terrain({f})) {
                    slots.push_back({f});
                }
            }
            for (int i = 0; i < 20; ++i) {
                const auto from = slots[static_cast<std::size_t>(
                    random.integer(0, static_cast<std::int64_t>(slots.size()) - 1))];
                const FaceId to =
                    face_of(tin.mesh.twin(half_edge(from, static_cast<unsigned>(random.integer(0, 2)))));
                if (tin.mesh.is_terrain(to) && std::find(slots.begin(), slots.end(), to) == slots.end()) {
                    slots.push_back(to);
                }
            }
            // Flips within the patch: what is outside is not terrain meanwhile.
            Tin flipped = tin;
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                if (!tin.mesh.is_ghost({f}) &&
                    std::find(slots.begin(), slots.end(), FaceId{f}) == slots.end()) {
                    flipped.mesh.set_terrain({f}, false);
                }
            }
            flip_at_random(random, flipped, 100);
            FaceList faces;
            for (auto face : terrain_of(flipped.mesh)) {
                std::rotate(face.begin(), face.begin() + random.integer(0, 2), face.end());
                faces.push_back(face);
            }
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                flipped.mesh.set_terrain({f}, !tin.mesh.is_ghost({f}));
            }
            faces = shuffled(random, faces);
            slots = shuffled(random, slots);
            const EdgeSet constrained = constrained_edges(tin.mesh);
            refill_cavity(tin.mesh, slots, make_cavity(tin.mesh, slots, faces));
            REQUIRE(is_sound(tin));
            REQUIRE(terrain_of(tin.mesh) == terrain_of(flipped.mesh));
            REQUIRE(constrained_edges(tin.mesh) == constrained);
        }
    }

    TEST_CASE("splitting edges and faces keeps the mesh sound and both parts as they were marked") {
        for (int seed = 1; seed <= cases(50); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = delaunay_tin(key_families()[0].make(random, 30));
            constrain_at_random(random, tin, 15);
            TriangleMesh& mesh = tin.mesh;
            for (int i = 0; i < 40; ++i) {
                const FaceId f{static_cast<std::uint32_t>(
                    random.integer(0, static_cast<std::int64_t>(mesh.slot_count()) - 1))};
                const std::size_t vertices = mesh.vertex_count();
                const std::size_t slots = mesh.slot_count();
                const std::size_t edges = constrained_edges(mesh).size();
                if (random.integer(0, 1) == 0 && !mesh.is_ghost(f)) {
                    REQUIRE(split_face(mesh, f).value == vertices);
                    REQUIRE(constrained_edges(mesh).size() == edges);
                } else {
                    const HalfEdgeId h = half_edge(f, 0);  // of a ghost face the one on the hull
                    const VertexId a = mesh.origin(h);
                    const VertexId b = mesh.destination(h);
                    const bool was_constrained = mesh.is_constrained(h);
                    const VertexId m = split_edge(mesh, h);
                    REQUIRE(m.value == vertices);
                    REQUIRE(mesh.origin(h) == a);
                    REQUIRE(mesh.destination(h) == m);
                    REQUIRE_FALSE(find_half_edge(mesh, a.value, b.value).has_value());
                    REQUIRE(mesh.is_constrained(h) == was_constrained);
                    REQUIRE(constrained_edges(mesh).size() == edges + (was_constrained ? 1U : 0U));
                }
                REQUIRE(mesh.slot_count() == slots + 2);
                REQUIRE(check_mesh(mesh).is_clean());
            }
        }
    }

    TEST_CASE("renumbering changes corners and nothing else") {
        TriangleMesh mesh = mesh_of(4, {0, 1, 2, 0, 2, 3});
        const std::vector<VertexId> new_ids = {{2}, {0}, {3}, {1}};
        renumber_vertices(mesh, new_ids);
        CHECK(terrain_of(mesh) == terrain_of(mesh_of(4, {2, 0, 3, 2, 3, 1})));
        CHECK(check_mesh(mesh).is_clean());
    }
}
