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

/// The faces of a mesh by the part of edge-sharing faces that they are in, and its outer border edges.
struct Parts {
    std::vector<std::size_t> part_of;  // by slot; ghosts have none
    std::set<Ends> outer;
};

/// `full`: a triangulation of a convex area, of which `tin` has some of the faces, their corners the same.
/// What is outside of a part is what can be reached from outside the hull through faces that the part has
/// not.
Parts find_parts(const Tin& tin, const Tin& full) {
    Parts parts;
    parts.part_of.assign(tin.mesh.slot_count(), 0);
    std::size_t count = 0;
    const auto flood = [](const TriangleMesh& mesh, std::uint32_t start, const auto& enter) {
        std::vector<std::uint32_t> todo = {start};
        while (!todo.empty()) {
            const std::uint32_t f = todo.back();
            todo.pop_back();
            for (unsigned corner = 0; corner < 3; ++corner) {
                const std::uint32_t across = face_of(mesh.twin(half_edge({f}, corner))).value;
                if (enter(across, half_edge({f}, corner))) {
                    todo.push_back(across);
                }
            }
        }
    };
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_ghost({f}) || parts.part_of[f] != 0) {
            continue;
        }
        const std::size_t part = ++count;
        parts.part_of[f] = part;
        std::set<Ends> edges;
        flood(tin.mesh, f, [&](std::uint32_t across, HalfEdgeId h) {
            edges.emplace(tin.mesh.origin(h).value, tin.mesh.destination(h).value);
            const bool is_new = !tin.mesh.is_ghost({across}) && parts.part_of[across] == 0;
            parts.part_of[across] = is_new ? part : parts.part_of[across];
            return is_new;
        });
        std::uint32_t ghost = 0;
        while (!full.mesh.is_ghost({ghost})) {
            ++ghost;
        }
        std::vector<bool> is_outside(full.mesh.slot_count());
        is_outside[ghost] = true;
        flood(full.mesh, ghost, [&](std::uint32_t across, HalfEdgeId h) {
            const Ends inward{full.mesh.destination(h).value, full.mesh.origin(h).value};
            if (edges.count(inward) != 0) {
                parts.outer.insert(inward);
                return false;
            }
            const bool is_new = !is_outside[across];
            is_outside[across] = true;
            return is_new;
        });
    }
    return parts;
}

/// A mesh of some of the faces of `full`, its terrain.
Tin some_faces(Random& random, const Tin& full, std::int64_t percent) {
    std::vector<std::uint32_t> corners;
    for (const auto& face : terrain_of(full.mesh)) {
        if (corners.empty() || random.integer(0, 99) < percent) {
            corners.insert(corners.end(), face.begin(), face.end());
        }
    }
    Tin tin = tin_of(full.keys);
    tin.mesh = mesh_of(full.keys.size(), corners);
    return tin;
}

/// Makes the border of a set of faces the rings of a polygon: the edges shared out between its lines. What an
/// edge at a void says is chance.
void trace_border(Random& random, Tin& tin, const Parts& parts, const std::vector<bool>& is_inside,
                  std::uint32_t first_line, std::int64_t line_count) {
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            const std::uint32_t across = face_of(tin.mesh.twin(h)).value;
            const bool is_at_ghost = tin.mesh.is_ghost({across});
            if (tin.mesh.is_ghost({f}) || (!is_at_ghost && across < f)) {
                continue;
            }
            const Ends ends{tin.mesh.origin(h).value, tin.mesh.destination(h).value};
            const bool is_void = is_at_ghost && parts.outer.count(ends) == 0;
            const bool is_ring =
                is_void ? random.integer(0, 1) == 0 : is_inside[f] != (!is_at_ghost && is_inside[across]);
            const auto runs =
                static_cast<std::uint32_t>(random.integer(0, 9) == 0 ? 2 : 0) + (is_ring ? 1U : 0U);
            if (runs != 0) {
                const auto [a, b] = std::minmax(ends.first, ends.second);
                const auto line = first_line + static_cast<std::uint32_t>(random.integer(0, line_count - 1));
                tin.traces.push_back({{a}, {b}, line, runs});
                tin.mesh.set_constrained(h, true);
            }
        }
    }
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

    TEST_CASE("where lengths differ on the ground, every edge counts by what the ground says") {
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(40)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            Tin tin = delaunay_tin(some_keys(random, 300, 1000));
            const double distortion = 0.001 * static_cast<double>(random.integer(0, 30));
            std::size_t measured = 0;
            GroundMeasures ground;
            ground.unit = "metre";
            ground.plane_unit = random.integer(0, 1) == 0 ? 1 : 0.3048;
            ground.distortion = distortion;
            const auto length = [&](Point2 a, Point2 b) {  // scale changes from south to north
                const double scale = 1 + distortion * std::sin((a.y + b.y) / 300);
                return ground.plane_unit * std::hypot(b.x - a.x, b.y - a.y) / scale;
            };
            ground.length_function = [&](Point2 a, Point2 b) {
                ++measured;
                return length(a, b);
            };
            const double limit = static_cast<double>(random.integer(10, 100));
            std::vector<bool> expected(tin.mesh.slot_count());
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                expected[f] = tin.mesh.is_terrain({f});
                for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
                    const Point3 a = tin.position(tin.mesh.vertex({f}, i));
                    const Point3 b = tin.position(tin.mesh.vertex({f}, next_corner(i)));
                    expected[f] = expected[f] && length({a.x, a.y}, {b.x, b.y}) <= limit;
                }
            }
            const std::size_t faces = tin.mesh.count_terrain();
            drop_long_faces(tin, limit, {}, ground);
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                CHECK(tin.mesh.is_terrain({f}) == expected[f]);
            }
            CHECK(measured < faces / 2);  // of three edges a face; none of most
        }
    }

    TEST_CASE("where nothing is known of how lengths differ, all edges are measured") {
        Random random(5);
        Tin tin = delaunay_tin(some_keys(random, 100, 1000));
        GroundMeasures ground;
        ground.distortion = 7;
        ground.length_function = [](Point2, Point2) { return 3.0; };
        CHECK(drop_long_faces(tin, 3, {}, ground) == 0);
        CHECK(drop_long_faces(tin, 2.5, {}, ground) > 0);
        CHECK(tin.mesh.count_terrain() == 0);
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

    TEST_CASE("water faces are those inside lakes and banks, in meshes of many parts with voids too") {
        const std::vector<LineRole> roles = {LineRole::Lake, LineRole::Bank, LineRole::Hole};
        for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(cases(300)); ++seed) {
            CAPTURE(seed);
            Random random(seed);
            const Tin full =
                delaunay_tin(some_keys(random, static_cast<std::size_t>(random.integer(4, 60)), 40));
            if (full.mesh.count_terrain() == 0) {
                continue;
            }
            Tin tin = some_faces(random, full, random.integer(0, 2) == 0 ? 100 : random.integer(30, 95));
            const Parts parts = find_parts(tin, full);
            std::vector<bool> expected(tin.mesh.slot_count());
            std::vector<Breakline> lines;
            bool has_water = false;
            for (std::int64_t polygon = random.integer(0, 4); polygon > 0; --polygon) {
                const LineRole role = roles[static_cast<std::size_t>(random.integer(0, 2))];
                has_water = has_water || role != LineRole::Hole;
                std::vector<bool> is_inside(tin.mesh.slot_count());
                const std::int64_t percent = random.integer(5, 95);
                for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                    is_inside[f] = !tin.mesh.is_ghost({f}) && random.integer(0, 99) < percent;
                    expected[f] = expected[f] || (is_inside[f] && role != LineRole::Hole);
                }
                const std::int64_t line_count = random.integer(1, 3);
                trace_border(random, tin, parts, is_inside, static_cast<std::uint32_t>(lines.size()),
                             line_count);
                lines.resize(lines.size() + static_cast<std::size_t>(line_count),
                             {{}, role, true, static_cast<std::uint32_t>(polygon)});
            }
            std::sort(tin.traces.begin(), tin.traces.end());
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                if (!tin.mesh.is_ghost({f}) && random.integer(0, 9) == 0) {
                    tin.mesh.set_terrain({f}, false);
                    expected[f] = false;
                }
            }
            CHECK(find_water_faces(tin, lines) == (has_water ? expected : std::vector<bool>{}));
        }
    }

    TEST_CASE("a void that touches the first vertex of the border is no way in") {
        Tin tin = tin_of(std::vector<Key2>{{0, 0}, {2, -3}, {2, -1}, {2, 1}, {2, 3}, {4, 0}});
        tin.mesh = mesh_of(6, {0, 3, 4, 0, 1, 2, 1, 5, 2, 2, 5, 3, 3, 5, 4});
        for (const Ends& ends : {Ends{0, 1}, Ends{0, 4}, Ends{1, 5}, Ends{4, 5}}) {
            tin.traces.push_back({{ends.first}, {ends.second}, 0, 1});
        }
        constrain_border(tin);
        const std::vector<bool> is_water =
            find_water_faces(tin, std::vector<Breakline>{{{}, LineRole::Lake}});
        CHECK(std::count(is_water.begin(), is_water.end(), true) == 5);
    }

    TEST_CASE("faces that are kept may have edges as long as they like") {
        Random random(7);
        Tin tin = delaunay_tin(some_keys(random, 100, 1000));
        std::vector<bool> is_kept(tin.mesh.slot_count());
        std::size_t kept = 0;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); f += 3) {
            is_kept[f] = tin.mesh.is_terrain({f});
            kept += is_kept[f] ? 1U : 0U;
        }
        const std::size_t faces = tin.mesh.count_terrain();
        CHECK(drop_long_faces(tin, 0.5, is_kept) == faces - kept);
        CHECK(tin.mesh.count_terrain() == kept);
    }
}
