#include "support/length_tins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "tinwright/delaunay/constrained_delaunay.hpp"

#include "support/tins.hpp"
#include "support/triangulation_oracle.hpp"

namespace tinwright_tests {

using namespace tinwright;

namespace {

using Keys = std::vector<Key2>;

Tin flat_tin(const Keys& keys) { return delaunay_tin(keys); }

/// The point at an angle (radians) and distance from (centre, centre), rounded.
Key2 polar(double centre, double angle, double radius) {
    return {centre + std::round(radius * std::cos(angle)), centre + std::round(radius * std::sin(angle))};
}

/// Random places of a lattice of triangles with sides of `side` keys.
Keys equilateral_places(Random& random, std::size_t count, double side) {
    Keys keys;
    const double height = side * std::numbers::sqrt3 / 2;
    while (keys.size() < count) {
        const auto row = static_cast<double>(random.integer(0, 4));
        const auto column = static_cast<double>(random.integer(0, 5));
        keys.push_back(
            {std::round(column * side + std::fmod(row, 2.0) * side / 2), std::round(row * height)});
    }
    return keys;
}

Tin equilateral(Random& random, std::size_t count) {
    constexpr std::array kSides{2.0, 4.0, 8.0, 30.0, 1000.0, 0x1p30};
    return flat_tin(
        equilateral_places(random, count, kSides[static_cast<std::size_t>(random.integer(0, 5))]));
}

template <int kSize>
Tin small_lattice(Random& random, std::size_t count) {
    Keys keys(count);
    std::generate(keys.begin(), keys.end(), [&] { return Key2{random.key(kSize), random.key(kSize)}; });
    return flat_tin(keys);
}

/// Two arcs around one centre, a gap apart that is somewhat longer than their steps or somewhat shorter.
Tin facing_arcs(Random& random, std::size_t count) {
    const double radius = 1000 + random.key(100000);
    const double step = 1.5 * random.real() / static_cast<double>(count);
    const double gap = radius * step * (0.5 + 2 * random.real());
    Keys keys;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t place = i / 2;
        const double angle = 0.3 + step * (static_cast<double>(place) + 0.2 * random.real());
        keys.push_back(polar(200000, angle, radius + (i % 2 == 0 ? 0 : gap)));
    }
    return flat_tin(keys);
}

/// Two nearly equilateral triangles with a side in common, one apex moved towards it, some vertices around.
Tin kite(Random& random, std::size_t count) {
    const double half = 1 + random.key(random.integer(0, 1) == 0 ? 8 : 100000);
    const double height = std::round(half * std::numbers::sqrt3);
    const double middle = 20 * half + 1;
    Keys keys{{middle - half, middle},
              {middle + half, middle},
              {middle, middle + height + random.key(3) - 1},
              {middle, middle - height + random.key(4)}};
    while (keys.size() < count) {
        keys.push_back(polar(middle, 6.3 * random.real(), half * (1.7 + random.real())));
    }
    return flat_tin(keys);
}

Tin far_clusters(Random& random, std::size_t count) {
    Keys keys;
    const std::array<Key2, 3> centres{Key2{1000, 1000}, Key2{9000 + random.key(3000), 1500},
                                      Key2{4000 + random.key(3000), 8000}};
    while (keys.size() < count) {
        const Key2 centre = centres[static_cast<std::size_t>(random.integer(0, 2))];
        keys.push_back({centre.x + random.key(900), centre.y + random.key(900)});
    }
    return flat_tin(keys);
}

constexpr std::array kLengthFamilies{
    TinFamily{"equilateral lattice", equilateral},
    TinFamily{"lattice of 5", small_lattice<5>},
    TinFamily{"lattice of 6", small_lattice<6>},
    TinFamily{"facing arcs", facing_arcs},
    TinFamily{"kite", kite},
    TinFamily{"far clusters", far_clusters},
};

std::vector<FaceId> terrain_faces(const TriangleMesh& mesh) {
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (mesh.is_terrain({f})) {
            faces.push_back({f});
        }
    }
    return faces;
}

}  // namespace

std::span<const Norm> length_norms() {
    static const std::array norms{Norm(), Norm::lp(1), Norm::maximum(), Norm::lp(3), Norm::lp(5)};
    return norms;
}

std::span<const TinFamily> length_families() { return kLengthFamilies; }
std::vector<TinFamily> all_tin_families() {
    std::vector<TinFamily> families;
    for (const auto& some : {general_families(), degenerate_families(), length_families()}) {
        families.insert(families.end(), some.begin(), some.end());
    }
    return families;
}

Tin any_small_tin(std::uint64_t seed, std::size_t most) {
    static const std::vector<TinFamily> families = all_tin_families();
    Random random(seed);
    Tin tin = families[seed % families.size()].make(
        random, static_cast<std::size_t>(random.integer(4, static_cast<std::int64_t>(most))));
    if (tin.mesh.count_terrain() == 0) {
        return tin;
    }
    const std::uint64_t kind = seed / families.size() % 6;
    if (kind > 2) {
        add_segments_at_random(random, tin, static_cast<int>(random.integer(1, 4)));
    }
    if (kind == 4) {
        make_voids_at_random(random, tin, static_cast<int>(random.integer(1, 3)));
    } else if (kind == 5) {
        keep_tree_of_faces(random, tin, static_cast<std::size_t>(random.integer(3, 12)));
    }
    return tin;
}

Tin tin_of_ring(const std::vector<Key2>& ring, const std::vector<Key2>& outside) {
    std::vector<Key2> keys = ring;
    keys.insert(keys.end(), outside.begin(), outside.end());
    Tin tin = delaunay_tin(keys);
    std::vector<VertexId> ids;
    for (const Key2 key : ring) {
        const auto place = std::find(tin.keys.begin(), tin.keys.end(), key);
        ids.push_back({static_cast<std::uint32_t>(place - tin.keys.begin())});
    }
    std::vector<Segment> segments;
    std::set<std::array<VertexId, 2>> sides;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        segments.push_back({ids[i], ids[(i + 1) % ids.size()]});
        sides.insert({segments.back().a, segments.back().b});
    }
    insert_segments(tin.mesh, tin.keys, segments);
    TriangleMesh& mesh = tin.mesh;
    std::set<FaceId> inside;
    std::vector<FaceId> waiting;
    for (const FaceId f : terrain_faces(mesh)) {
        for (unsigned i = 0; i < 3; ++i) {
            if (sides.contains({mesh.vertex(f, i), mesh.vertex(f, next_corner(i))}) &&
                inside.insert(f).second) {
                waiting.push_back(f);
            }
        }
    }
    while (!waiting.empty()) {
        const FaceId f = waiting.back();
        waiting.pop_back();
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge(f, i);
            if (!mesh.is_constrained(h) && inside.insert(face_of(mesh.twin(h))).second) {
                waiting.push_back(face_of(mesh.twin(h)));
            }
        }
    }
    for (const FaceId f : terrain_faces(mesh)) {
        mesh.set_terrain(f, inside.contains(f));
    }
    return tin;
}

void add_segments_at_random(Random& random, Tin& tin, int count) {
    const auto last = static_cast<std::int64_t>(tin.vertex_count()) - 1;
    for (int i = 0; i < count; ++i) {
        const VertexId a{static_cast<std::uint32_t>(random.integer(0, last))};
        const VertexId b{static_cast<std::uint32_t>(random.integer(0, last))};
        bool is_free = a != b;
        for (const oracle::Edge& edge : sites_of(tin).constraints) {
            is_free =
                is_free && !oracle::do_cross(tin.key(a), tin.key(b), tin.keys[edge[0]], tin.keys[edge[1]]);
        }
        if (is_free) {
            const Segment segment{a, b};
            insert_segments(tin.mesh, tin.keys, {&segment, 1});
        }
    }
}

void keep_tree_of_faces(Random& random, Tin& tin, std::size_t count) {
    TriangleMesh& mesh = tin.mesh;
    const std::vector<FaceId> all = terrain_faces(mesh);
    const auto pick = [&random](std::size_t size) {
        return static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(size) - 1));
    };
    std::vector<FaceId> kept{all[pick(all.size())]};
    std::set<FaceId> is_kept(kept.begin(), kept.end());
    std::set<HalfEdgeId> tree;
    for (std::size_t tries = 0; kept.size() < count && tries < 20 * count; ++tries) {
        const HalfEdgeId h = half_edge(kept[pick(kept.size())], static_cast<unsigned>(random.integer(0, 2)));
        const FaceId beyond = face_of(mesh.twin(h));
        if (!mesh.is_constrained(h) && mesh.is_terrain(beyond) && is_kept.insert(beyond).second) {
            kept.push_back(beyond);
            tree.insert(h);
            tree.insert(mesh.twin(h));
        }
    }
    for (const FaceId f : all) {
        mesh.set_terrain(f, is_kept.contains(f));
    }
    for (const FaceId f : kept) {
        for (unsigned i = 0; i < 3; ++i) {
            if (!tree.contains(half_edge(f, i))) {
                mesh.set_constrained(half_edge(f, i), true);
            }
        }
    }
}

}  // namespace tinwright_tests
