#include "tinwright/breaklines/domain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

std::vector<Ends> border_of(const TriangleMesh& mesh) {
    std::vector<Ends> border;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            if (mesh.is_terrain({f}) && mesh.is_border(h)) {
                border.emplace_back(mesh.origin(h).value, mesh.destination(h).value);
            }
        }
    }
    return border;
}

/// Whether the border is one closed curve that meets no vertex twice.
bool is_simple(const std::vector<Ends>& border) {
    const std::map<std::uint32_t, std::uint32_t> next(border.begin(), border.end());
    if (next.size() != border.size() || border.empty()) {
        return false;
    }
    std::size_t length = 0;
    std::uint32_t at = border.front().first;
    do {
        at = next.count(at) == 0 ? border.front().first : next.at(at);
        ++length;
    } while (at != border.front().first && length <= border.size());
    return length == border.size();
}

std::set<std::uint32_t> vertices_of(const TriangleMesh& mesh) {
    std::set<std::uint32_t> vertices;
    for (const auto& face : terrain_of(mesh)) {
        vertices.insert(face.begin(), face.end());
    }
    return vertices;
}

double length_of(const Tin& tin, const Ends& ends) {
    const Key2 a = tin.keys[ends.first];
    const Key2 b = tin.keys[ends.second];
    return std::hypot(b.x - a.x, b.y - a.y);
}

/// The border edges that could still be opened: the opposite vertex is not on the border.
template <class Visit>
void visit_openings(const Tin& tin, const Visit& visit) {
    std::set<std::uint32_t> on_border;
    for (const Ends& ends : border_of(tin.mesh)) {
        on_border.insert(ends.first);
    }
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            if (!tin.mesh.is_terrain({f}) || !tin.mesh.is_border(h)) {
                continue;
            }
            const VertexId apex = tin.mesh.origin(previous(h));
            if (on_border.count(apex.value) == 0) {
                visit(h, apex);
            }
        }
    }
}

std::vector<Key2> some_keys(Random& random, std::size_t count, double limit) {
    std::vector<Key2> keys;
    for (std::size_t i = 0; i < count; ++i) {
        keys.push_back({random.key(limit), random.key(limit)});
    }
    return keys;
}

Tin scaled(Tin tin, double factor) {
    for (Key2& key : tin.keys) {
        key = {key.x * factor, key.y * factor};
    }
    return tin;
}

}  // namespace

TEST_SUITE("breaklines/domain") {
    TEST_CASE("the convex domain drops nothing") {
        Random random(1);
        Tin tin = delaunay_tin(some_keys(random, 50, 1000));
        const auto before = terrain_of(tin.mesh);
        CHECK(apply_domain(tin, {}) == 0);
        CHECK(terrain_of(tin.mesh) == before);
    }

    TEST_CASE("trimming keeps every sample, one simple border, and no needle that could go") {
        for (const KeyFamily& family : key_families()) {
            for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(5)); ++seed) {
                CAPTURE(family.name);
                CAPTURE(seed);
                Random random(seed);
                Tin tin = delaunay_tin(family.make(random, 200));
                if (tin.mesh.count_terrain() == 0) {
                    continue;
                }
                const std::size_t faces = tin.mesh.count_terrain();
                const auto vertices = vertices_of(tin.mesh);
                const std::size_t dropped = apply_domain(tin, {DomainRule::Kind::Trimmed, 0});
                CHECK(tin.mesh.count_terrain() + dropped == faces);
                CHECK(vertices_of(tin.mesh) == vertices);
                CHECK(is_simple(border_of(tin.mesh)));
                visit_openings(tin, [&](HalfEdgeId h, VertexId apex) {
                    const Key2 a = tin.key(tin.mesh.origin(h));
                    const Key2 b = tin.key(tin.mesh.destination(h));
                    const Key2 c = tin.key(apex);
                    const long double area = static_cast<long double>(b.x - a.x) * (c.y - a.y) -
                                             static_cast<long double>(b.y - a.y) * (c.x - a.x);
                    const long double dx = b.x - a.x;
                    const long double dy = b.y - a.y;
                    CHECK(area / (dx * dx + dy * dy) >= 0.1L - 1e-15L);
                });
                CHECK(apply_domain(tin, {DomainRule::Kind::Trimmed, 0}) == 0);
            }
        }
    }

    TEST_CASE("trimming does not depend on the unit") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(20)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            Tin tin = delaunay_tin(some_keys(random, 300, 1 << 20));
            Tin wide = scaled(tin, 1 << 12);
            CHECK(apply_domain(tin, {DomainRule::Kind::Trimmed, 0}) ==
                  apply_domain(wide, {DomainRule::Kind::Trimmed, 0}));
            CHECK(terrain_of(tin.mesh) == terrain_of(wide.mesh));
        }
    }

    TEST_CASE("trimming follows a gently bent row of samples all the way") {
        // A row sagging towards the rest by far less than its length: Delaunay fills the sag with needles.
        std::vector<Key2> keys;
        for (int i = 0; i <= 40; ++i) {
            const int sag = 400 - (i - 20) * (i - 20);
            keys.push_back({1000.0 * i, static_cast<double>(sag)});
            keys.push_back({1000.0 * i, 40000.0});
        }
        Tin tin = delaunay_tin(keys);
        CHECK(apply_domain(tin, {DomainRule::Kind::Trimmed, 0}) > 0);
        const std::vector<Ends> border = border_of(tin.mesh);
        const double longest =
            length_of(tin, *std::max_element(border.begin(), border.end(), [&](const Ends& a, const Ends& b) {
                          return length_of(tin, a) < length_of(tin, b);
                      }));
        CHECK(longest < 41000);  // the two straight sides
        CHECK(std::count_if(border.begin(), border.end(),
                            [&](const Ends& ends) { return length_of(tin, ends) > 1100; }) == 2);
    }

    TEST_CASE("a concave domain has no border edge longer than asked that could be opened") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(20)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            Tin tin = delaunay_tin(some_keys(random, 400, 1000));
            const auto vertices = vertices_of(tin.mesh);
            const double length = static_cast<double>(random.integer(20, 200));
            const DomainRule rule{DomainRule::Kind::Concave, length};
            apply_domain(tin, rule);
            CHECK(vertices_of(tin.mesh) == vertices);
            CHECK(is_simple(border_of(tin.mesh)));
            visit_openings(tin, [&](HalfEdgeId h, VertexId) {
                CHECK(length_of(tin, {tin.mesh.origin(h).value, tin.mesh.destination(h).value}) <= length);
            });
            CHECK(apply_domain(tin, rule) == 0);
        }
    }

    TEST_CASE("lengths are decimal numbers in CRS units: an edge exactly as long stays") {
        Tin tin = delaunay_tin({{0, 0}, {57, 0}, {0, 57}, {57, 57}, {28, 20}});
        tin.lattice = Lattice::decimal(2, {0, 0});
        Tin other = tin;
        CHECK(apply_domain(tin, {DomainRule::Kind::Concave, 0.57}) == 0);  // 0.57 * 100 is below 57
        CHECK(apply_domain(other, {DomainRule::Kind::Concave, 0.56}) == 1);
    }

    TEST_CASE("faces with a long edge become voids, inside too") {
        std::vector<Key2> keys;
        for (const Key2& key : grid_keys(20, 20)) {
            const bool is_hole = key.x > 6 && key.x < 13 && key.y > 6 && key.y < 13;
            if (!is_hole) {
                keys.push_back(key);
            }
        }
        Tin tin = delaunay_tin(keys);
        const std::size_t dropped = drop_long_faces(tin, 1.5);
        CHECK(dropped > 0);
        // What is left are the 19 * 19 squares but the 7 * 7 of the hole, two faces each, and half a square
        // in each of the hole's corners.
        CHECK(tin.mesh.count_terrain() == 2 * (19 * 19 - 7 * 7) + 4);
        CHECK(drop_long_faces(tin, 1.5) == 0);
        CHECK(border_of(tin.mesh).size() == 4 * 19 + 4 * 6);
    }

    TEST_CASE("every border edge gets constrained, and no other") {
        Random random(4);
        Tin tin = delaunay_tin(some_keys(random, 200, 1000));
        drop_long_faces(tin, 100);
        constrain_border(tin);
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            for (unsigned corner = 0; corner < 3; ++corner) {
                const HalfEdgeId h = half_edge({f}, corner);
                if (tin.mesh.is_terrain({f})) {
                    CHECK(tin.mesh.is_constrained(h) == tin.mesh.is_border(h));
                }
            }
        }
    }
}
