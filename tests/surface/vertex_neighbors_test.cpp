#include "tinwright/surface/vertex_neighbors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/predicates.hpp"

#include "support/cases.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using tinwright::find_fan;
using tinwright::HalfEdgeId;
using tinwright::Key2;
using tinwright::NeighborSearch;
using tinwright::SharpEdges;
using tinwright::Tin;
using tinwright::VertexFan;
using tinwright::VertexId;
using tinwright::VertexNeighbor;
using tinwright_tests::Random;

namespace {

template <class Visit>
void for_corners(const Tin& tin, Visit visit) {
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            visit(tinwright::half_edge({f}, i));
        }
    }
}

/// 0 to 7, by comparing rather than turning.
int octant(Key2 d) {
    if (d.y >= 0 && d.x > 0) {
        return d.y < d.x ? 0 : 1;
    }
    if (d.x <= 0 && d.y > 0) {
        return -d.x < d.y ? 2 : 3;
    }
    if (d.y <= 0 && d.x < 0) {
        return -d.y < -d.x ? 4 : 5;
    }
    return d.x < -d.y ? 6 : 7;
}

/// Whether a straight line crosses the inside of a wall; looks at every edge of the TIN.
bool is_crossed(const Tin& tin, const SharpEdges& sharp, VertexId from, VertexId to) {
    bool is_crossed = false;
    for_corners(tin, [&](HalfEdgeId h) {
        is_crossed =
            is_crossed || (is_wall(tin.mesh, sharp, h) &&
                           tinwright::do_cross(tin.key(from), tin.key(to), tin.key(tin.mesh.origin(h)),
                                               tin.key(tin.mesh.destination(h))));
    });
    return is_crossed;
}

Tin random_tin(Random& random, const tinwright_tests::TinFamily& family, int seed) {
    Tin tin = family.make(random, 50);
    if (tin.mesh.count_terrain() > 8) {
        tinwright_tests::flip_at_random(random, tin, seed % 2 == 0 ? 20 : 0);
        tinwright_tests::constrain_at_random(random, tin, seed % 3 == 0 ? 0 : 15);
        tinwright_tests::make_voids_at_random(random, tin, seed % 4 == 0 ? 4 : 0);
    }
    return tin;
}

template <class Check>
void for_random_tins(Check check) {
    for (const auto families :
         {tinwright_tests::general_families(), tinwright_tests::degenerate_families()}) {
        for (const tinwright_tests::TinFamily& family : families) {
            for (int seed = 1; seed <= tinwright_tests::cases(4); ++seed) {
                CAPTURE(family.name);
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const Tin tin = random_tin(random, family, seed);
                check(random, tin, SharpEdges(tin, {}));
            }
        }
    }
}

}  // namespace

TEST_SUITE("surface/vertex_neighbors") {
    TEST_CASE("every corner is in the fan found from it, between walls") {
        for_random_tins([](Random& /*random*/, const Tin& tin, const SharpEdges& sharp) {
            for_corners(tin, [&](HalfEdgeId corner) {
                const VertexFan fan = find_fan(tin.mesh, sharp, corner);
                bool is_found = false;
                visit_fan(tin.mesh, fan, [&](HalfEdgeId h) {
                    is_found = is_found || h == corner;
                    REQUIRE(tin.mesh.origin(h) == tin.mesh.origin(corner));
                    REQUIRE(tin.mesh.is_terrain(face_of(h)));
                    REQUIRE(is_wall(tin.mesh, sharp, h) == (!fan.is_closed && h == fan.first));
                });
                REQUIRE(is_found);
                REQUIRE(fan.is_closed != is_wall(tin.mesh, sharp, previous(fan.last)));
            });
        });
    }

    TEST_CASE("neighbours are distinct, seen, nearest first, and no more an octant than asked for") {
        for_random_tins([](Random& random, const Tin& tin, const SharpEdges& sharp) {
            NeighborSearch search(tin, sharp);
            std::vector<VertexNeighbor> neighbors;
            for_corners(tin, [&](HalfEdgeId corner) {
                const VertexFan fan = find_fan(tin.mesh, sharp, corner);
                const VertexId center = tin.mesh.origin(corner);
                const auto most = static_cast<unsigned>(random.integer(1, 3));
                search.find_octants(fan, most, neighbors);
                std::set<VertexId> distinct;
                std::array<unsigned, 8> count{};
                std::array<double, 8> last{};
                for (const VertexNeighbor& each : neighbors) {
                    distinct.insert(each.vertex);
                    REQUIRE(each.vertex != center);
                    REQUIRE(each.offset == Key2{tin.key(each.vertex).x - tin.key(center).x,
                                                tin.key(each.vertex).y - tin.key(center).y});
                    const auto of = static_cast<unsigned>(octant(each.offset));
                    REQUIRE(each.distance2 >= last[of]);
                    last[of] = each.distance2;
                    ++count[of];
                    REQUIRE(!is_crossed(tin, sharp, center, each.vertex));
                }
                REQUIRE(distinct.size() == neighbors.size());
                REQUIRE(*std::max_element(count.begin(), count.end()) <= most);
            });
        });
    }

    TEST_CASE("without walls on the way every vertex sees every other one") {
        for (int seed = 1; seed <= tinwright_tests::cases(20); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Key2> keys;  // few places, so that many lie on one line
            for (int i = 0; i < 30; ++i) {
                keys.push_back({random.key(7), random.key(7)});
            }
            const Tin tin = tinwright_tests::delaunay_tin(keys);
            const SharpEdges sharp;
            const NeighborSearch search(tin, sharp);
            for_corners(tin, [&](HalfEdgeId corner) {
                const VertexFan fan = find_fan(tin.mesh, sharp, corner);
                for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                    REQUIRE(
                        (VertexId{v} == tin.mesh.origin(corner) || !fan.is_closed || search.sees(fan, {v})));
                }
            });
        }
    }

    TEST_CASE("a vertex is not seen through a wall") {
        for_random_tins([](Random& /*random*/, const Tin& tin, const SharpEdges& sharp) {
            const NeighborSearch search(tin, sharp);
            for_corners(tin, [&](HalfEdgeId corner) {
                const VertexFan fan = find_fan(tin.mesh, sharp, corner);
                for (std::uint32_t v = 0; v < tin.vertex_count(); v += 3) {
                    if (VertexId{v} != tin.mesh.origin(corner) && search.sees(fan, {v})) {
                        REQUIRE(!is_crossed(tin, sharp, tin.mesh.origin(corner), {v}));
                    }
                }
            });
        });
    }

    TEST_CASE("a vertex of very many edges does not make its neighbours look at all of them") {
        std::vector<Key2> keys{{20000, 20000}};
        for (int i = 0; i < 2000; ++i) {  // on a parabola: the focus is a corner of many faces
            keys.push_back({10000.0 + 10 * i, 20 + std::floor((i - 1000.0) * (i - 1000.0) / 100)});
        }
        const Tin tin = tinwright_tests::delaunay_tin(keys);
        const SharpEdges sharp;
        NeighborSearch search(tin, sharp);
        std::vector<VertexNeighbor> neighbors;
        for_corners(tin, [&](HalfEdgeId corner) {
            search.find_octants(find_fan(tin.mesh, sharp, corner), 3, neighbors);
            REQUIRE(!neighbors.empty());
            REQUIRE(neighbors.size() <= 24);
        });
    }
}
