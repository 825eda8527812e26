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

bool is_on(Key2 p, Key2 a, Key2 b) { return p == a || p == b || oracle::is_inside_segment(p, a, b); }

bool do_touch(Key2 a, Key2 b, Key2 c, Key2 d) {
    return oracle::do_cross(a, b, c, d) || is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) ||
           is_on(d, a, b);
}

/// Whether a ring is counter-clockwise and does not touch itself.
bool is_simple(const Keys& ring) {
    const std::size_t n = ring.size();
    const auto at = [&](std::size_t i) { return ring[i % n]; };
    double area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (is_on(at(i), at(i + 1), at(i + 2)) || is_on(at(i + 2), at(i), at(i + 1))) {
            return false;
        }
        for (std::size_t j = i + 2; j < std::min(n, n + i - 1); ++j) {
            if (do_touch(at(i), at(i + 1), at(j), at(j + 1))) {
                return false;
            }
        }
        area += (at(i).x - at(0).x) * (at(i + 1).y - at(0).y) - (at(i).y - at(0).y) * (at(i + 1).x - at(0).x);
    }
    return n > 2 && area > 0;
}

/// Repeats `make` until it gives a simple polygon, turning clockwise ones round.
template <class Make>
Keys simple_ring(const Make& make) {
    while (true) {
        Keys ring = make();
        if (is_simple(ring)) {
            return ring;
        }
        std::reverse(ring.begin(), ring.end());
        if (is_simple(ring)) {
            return ring;
        }
    }
}

Keys near_circle(Random& random, std::size_t sides) {
    const double rough = random.integer(0, 1) == 0 ? 0 : 0.02;
    return simple_ring([&] {
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double turn = (static_cast<double>(i) + 0.4 * random.real()) / static_cast<double>(sides);
            ring.push_back(polar(20000, 2 * std::numbers::pi * turn, 10000 * (1 - rough * random.real())));
        }
        return ring;
    });
}

/// What is left when a third of a circle, more or less, is cut off: of two points on it that are farther
/// apart than the cut is long, Delaunay joins some.
Keys cut_circle(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double cut = 1.8 + 1.4 * random.real();
        const double rough = 0.1 * random.real() * random.real();
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double way = (static_cast<double>(i) + 0.5 * random.real()) / static_cast<double>(sides);
            const double angle = cut + (2 * std::numbers::pi - cut) * way;
            ring.push_back(polar(20000, angle, 10000 * (1 - rough * random.real())));
        }
        return ring;
    });
}

/// All sides of a regular polygon; lengths tie as far as keys allow.
Keys regular(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double radius = random.integer(0, 1) == 0 ? 1e6 : 3.0 * static_cast<double>(sides);
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double turn = static_cast<double>(i) / static_cast<double>(sides);
            ring.push_back(polar(2e6, 2 * std::numbers::pi * turn, radius));
        }
        return ring;
    });
}

Keys star(Random& random, std::size_t sides) {
    return simple_ring([&] {
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double turn = (static_cast<double>(i) + 0.9 * random.real()) / static_cast<double>(sides);
            ring.push_back(polar(20000, 2 * std::numbers::pi * turn, 2000 + random.key(8000)));
        }
        return ring;
    });
}

/// Between two arcs around one centre.
Keys bow(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double width = 0.3 + 4 * random.real();
        const double inner = 1 - 0.5 * random.real() * random.real();
        Keys ring;
        const std::size_t half = sides / 2;
        for (std::size_t i = 0; i < sides; ++i) {
            const bool is_outer = i < half;
            const double at = static_cast<double>(is_outer ? i : sides - 1 - i) + 0.5 * random.real();
            const double angle = width * at / static_cast<double>(half);
            ring.push_back(polar(200000, angle, is_outer ? 100000 : inner * 100000));
        }
        return ring;
    });
}

/// Teeth that stand close to each other.
Keys comb(Random& random, std::size_t sides) {
    return simple_ring([&] {
        Keys ring{{0, 0}, {100.0 * static_cast<double>(sides), 0}};
        for (std::size_t i = sides - 2; i > 0; --i) {
            const double x = 100.0 * static_cast<double>(i) + random.key(90);
            ring.push_back({x, i % 2 == 0 ? 100 + random.key(200) : 900 + random.key(1500)});
        }
        return ring;
    });
}

/// Turns parts of a closed way through `keys` round until it does not cross itself.
void uncross(Keys& keys) {
    const std::size_t n = keys.size();
    for (std::size_t round = 0; round < 100 * n; ++round) {
        bool is_clean = true;
        for (std::size_t i = 0; i + 2 < n; ++i) {
            for (std::size_t j = i + 2; j < n; ++j) {
                if (oracle::do_cross(keys[i], keys[i + 1], keys[j], keys[(j + 1) % n])) {
                    std::reverse(keys.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 keys.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                    is_clean = false;
                }
            }
        }
        if (is_clean) {
            return;
        }
    }
}

template <int kSize>
Keys tangle(Random& random, std::size_t sides) {
    return simple_ring([&] {
        std::vector<Key2> keys(kSize < 100 ? std::min(sides, std::size_t{2} * kSize) : sides);
        std::generate(keys.begin(), keys.end(), [&] { return Key2{random.key(kSize), random.key(kSize)}; });
        keys = shuffled(random, without_repetitions(keys));
        uncross(keys);
        return keys;
    });
}

/// A polygon with few corners whose sides are divided, so that they are all of about one length.
Keys dense(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const Keys corners =
            random.integer(0, 1) == 0 ? star(random, 3 + sides / 12) : tangle<20000>(random, 4 + sides / 12);
        double way = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Key2 to = corners[(i + 1) % corners.size()];
            way += std::hypot(to.x - corners[i].x, to.y - corners[i].y);
        }
        Keys ring;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Key2 from = corners[i];
            const Key2 to = corners[(i + 1) % corners.size()];
            const double length = std::hypot(to.x - from.x, to.y - from.y);
            const double parts = std::max(1.0, std::round(static_cast<double>(sides) * length / way));
            for (double t = 0; t < parts; ++t) {
                ring.push_back({std::round(from.x + (to.x - from.x) * t / parts),
                                std::round(from.y + (to.y - from.y) * t / parts)});
            }
        }
        return ring;
    });
}

constexpr std::array kRingFamilies{
    RingFamily{"near a circle", near_circle},
    RingFamily{"regular", regular},
    RingFamily{"cut circle", cut_circle},
    RingFamily{"star", star},
    RingFamily{"bow", bow},
    RingFamily{"comb", comb},
    RingFamily{"tangle", tangle<20000>},
    RingFamily{"tangle of 8", tangle<8>},
    RingFamily{"dense", dense},
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

std::span<const RingFamily> ring_families() { return kRingFamilies; }

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
