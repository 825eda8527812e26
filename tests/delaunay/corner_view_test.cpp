#include "tinwright/delaunay/corner_view.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/delaunay/proximity_graphs.hpp"

#include "support/cases.hpp"
#include "support/graph_oracle.hpp"
#include "support/point_sets.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Marks = std::vector<std::uint8_t>;

// What `from` sees all around, counter-clockwise from `first`, which it sees, on.
std::vector<std::uint32_t> seen_around(const oracle::Scene& scene, const oracle::PairTable& sight,
                                       std::uint32_t from, std::uint32_t first) {
    std::vector<std::uint32_t> seen{first};
    for (std::uint32_t v = 0; v < scene.keys.size(); ++v) {
        if (v != from && v != first && sight(from, v) == 1) {
            seen.push_back(v);
        }
    }
    const auto& keys = scene.keys;
    // No two are in one direction; what is straight behind belongs to the second half.
    const auto is_in_first_half = [&](std::uint32_t v) {
        return oracle::turn(keys[from], keys[first], keys[v]) > 0;
    };
    std::sort(seen.begin() + 1, seen.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (is_in_first_half(a) != is_in_first_half(b)) {
            return is_in_first_half(a);
        }
        const bool is_behind = oracle::turn(keys[from], keys[first], keys[a]) == 0;
        return is_behind || oracle::turn(keys[from], keys[a], keys[b]) > 0;
    });
    return seen;
}

struct Looked {
    std::vector<std::uint32_t> vertices;
    bool is_around;
};

// What the view should give: from one wall to the next, or all around.
Looked expected_view(const oracle::Scene& scene, const oracle::PairTable& sight, std::uint32_t from,
                     std::uint32_t first) {
    const auto is_wall = [&](std::uint32_t v) {
        return std::any_of(scene.walls.begin(), scene.walls.end(), [&](const oracle::Edge& wall) {
            return wall == oracle::Edge{from, v} || wall == oracle::Edge{v, from};
        });
    };
    std::vector<std::uint32_t> seen = seen_around(scene, sight, from, first);
    for (std::size_t i = 1; i < seen.size(); ++i) {
        if (is_wall(seen[i])) {
            seen.resize(i + 1);
            return {seen, false};
        }
    }
    if (is_wall(first)) {
        seen.push_back(first);
        return {seen, false};
    }
    return {seen, true};
}

// Whether the line of sight to `from` starts into the face of `at`, or along one of its two sides there.
bool arrives_in_face(const Tin& tin, const CornerView::Seen& seen, VertexId from) {
    const TriangleMesh& mesh = tin.mesh;
    const Key2 apex = tin.key(seen.vertex);
    return mesh.origin(seen.at) == seen.vertex && mesh.is_terrain(face_of(seen.at)) &&
           oracle::turn(apex, tin.key(mesh.destination(seen.at)), tin.key(from)) >= 0 &&
           oracle::turn(apex, tin.key(mesh.origin(previous(seen.at))), tin.key(from)) <= 0;
}

void check_views(const Tin& tin, const oracle::Scene& scene, const Marks& walls) {
    const oracle::PairTable sight = oracle::sights(scene);
    CornerView view(tin.mesh, tin.keys);
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            const HalfEdgeId first = half_edge({f}, i);
            const VertexId from = tin.mesh.origin(first);
            view.look(
                first, [&](HalfEdgeId h) { return walls[h.value] != 0; }, [](HalfEdgeId) { return true; });
            std::vector<std::uint32_t> seen;
            for (const CornerView::Seen& one : view.seen()) {
                seen.push_back(one.vertex.value);
                REQUIRE(arrives_in_face(tin, one, from));
            }
            CAPTURE(from.value);
            CAPTURE(describe(tin));
            const Looked expected =
                expected_view(scene, sight, from.value, tin.mesh.destination(first).value);
            REQUIRE(seen == expected.vertices);
            REQUIRE(view.is_around() == expected.is_around);
        }
    }
}

Marks constrained_edges(const TriangleMesh& mesh) {
    Marks marks(4 * mesh.slot_count());
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            marks[half_edge({f}, i).value] = mesh.is_constrained(half_edge({f}, i)) ? 1 : 0;
        }
    }
    return marks;
}

}  // namespace

TEST_SUITE("delaunay/corner_view") {
    TEST_CASE("a vertex sees through any triangulation what it sees by definition, between walls and voids") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(12); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(random.integer(4, 24))));
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                flip_at_random(random, tin, 40);
                constrain_at_random(random, tin, static_cast<int>(random.integer(0, 12)));
                make_voids_at_random(random, tin, static_cast<int>(random.integer(0, 4)));
                check_views(tin, oracle::scene_of(tin), constrained_edges(tin.mesh));
            }
        }
    }

    TEST_CASE("a corner of a polygon with cracks sees what it sees by definition") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            for (int seed = 0; seed < cases(12); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed) + 40);
                Tin tin = delaunay_tin(family.make(random, static_cast<std::size_t>(random.integer(4, 40))));
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                // The polygons between a connected plane graph and the hull.
                const Marks walls = mark_relative_neighbors(tin.mesh, tin.keys);
                oracle::Scene scene = oracle::scene_of(tin);
                for (std::uint32_t h = 0; h < walls.size(); ++h) {
                    if (walls[h] != 0) {
                        scene.walls.push_back({tin.mesh.origin({h}).value, tin.mesh.destination({h}).value});
                    }
                }
                check_views(tin, scene, walls);
            }
        }
    }

    TEST_CASE("nothing is seen through an edge that is not worth it, and the ends of the way are known") {
        Random random(8);
        const Tin tin = delaunay_tin(key_families()[2].make(random, 200));
        CornerView view(tin.mesh, tin.keys);
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            if (!tin.mesh.is_terrain({f})) {
                continue;
            }
            const HalfEdgeId first = half_edge({f}, 0);
            const auto no_wall = [](HalfEdgeId) { return false; };
            view.look(first, no_wall, [](HalfEdgeId) { return false; });
            std::size_t neighbors = 1;  // from `first` on, until there is terrain no more
            HalfEdgeId h = first;
            do {
                h = next_around(tin.mesh, h);
                ++neighbors;
            } while (h != first && tin.mesh.is_terrain(face_of(h)));
            CHECK(view.seen().size() == (h == first ? neighbors - 1 : neighbors));

            const VertexId eye = tin.mesh.origin(first);
            bool is_between = true;
            view.look(first, no_wall, [&](HalfEdgeId edge, VertexId right, VertexId left) {
                const auto side = [&](VertexId to, VertexId v) {
                    return oracle::turn(tin.key(eye), tin.key(to), tin.key(v));
                };
                // The sights between the two pass through the edge.
                is_between = is_between && side(right, left) > 0 && side(right, tin.mesh.origin(edge)) <= 0 &&
                             side(left, tin.mesh.destination(edge)) >= 0;
                return true;
            });
            CHECK(is_between);
        }
    }
}
