#include "tinwright/delaunay/blocking_disks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

// A place given as an offset from a key; differences of keys are exact, and 64 bits of mantissa enough to
// tell what doubles have rounded.
struct Place {
    Key2 key;
    Offset offset;
};

Place center_of(const Tin& tin, const BlockingDisk& disk) { return {tin.key(disk.vertex), disk.center}; }

long double distance(const Place& a, const Place& b) {
    const long double x = static_cast<long double>(b.key.x - a.key.x) + b.offset.x - a.offset.x;
    const long double y = static_cast<long double>(b.key.y - a.key.y) + b.offset.y - a.offset.y;
    return std::hypot(x, y);
}

// By how much lengths of this size may be wrong.
long double slack(long double length) { return 1e-11L * length; }

BlockingDisks disks_of(const Tin& tin) { return {tin.keys, make_minimum_spanning_tree(tin.mesh, tin.keys)}; }

template <class Check>
void for_each_family(int seeds, std::size_t count, const Check& check) {
    for (const KeyFamily& family : key_families()) {
        CAPTURE(std::string(family.name));
        for (int seed = 1; seed <= cases(seeds); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = delaunay_tin(family.make(random, count));
            check(random, tin, disks_of(tin));
        }
    }
}

}  // namespace

TEST_SUITE("delaunay/blocking_disks") {
    TEST_CASE("no disk holds a vertex, and no two disks meet") {
        for_each_family(3, 120, [](Random& /*random*/, const Tin& tin, const BlockingDisks& disks) {
            std::size_t with_vertex = 0;
            std::size_t meeting = 0;
            CHECK(disks.disks().size() + 1 == tin.vertex_count());
            for (std::size_t i = 0; i < disks.disks().size(); ++i) {
                const BlockingDisk& a = disks.disks()[i];
                for (const Key2 key : tin.keys) {
                    const long double away = distance(center_of(tin, a), {key, {}});
                    with_vertex += away < a.radius - slack(a.radius + away) ? 1U : 0U;
                }
                for (std::size_t j = 0; j < i; ++j) {
                    const BlockingDisk& b = disks.disks()[j];
                    const long double away = distance(center_of(tin, a), center_of(tin, b));
                    const long double sum = static_cast<long double>(a.radius) + b.radius;
                    meeting += away < sum - slack(sum) ? 1U : 0U;
                }
            }
            CHECK(with_vertex == 0);
            CHECK(meeting == 0);
        });
    }

    TEST_CASE("the closed disks are connected and have all vertices") {
        for_each_family(3, 120, [](Random& /*random*/, const Tin& tin, const BlockingDisks& disks) {
            std::size_t defects = 0;
            const auto look_at = [&](std::uint32_t index, const Place& place) {
                const BlockingDisk& disk = disks.disks()[index];
                const long double off = distance(center_of(tin, disk), place) - disk.radius;
                const long double size = disk.radius + std::hypot(place.offset.x, place.offset.y);
                defects += std::abs(off) <= slack(size) ? 0U : 1U;
            };
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                look_at(disks.disk_at({v}), {tin.keys[v], {}});
            }
            // Each disk touches an earlier one: at its vertex i_j, or where it says.
            for (std::uint32_t i = 1; i < disks.disks().size(); ++i) {
                const BlockingDisk& disk = disks.disks()[i];
                REQUIRE(disk.touched < i);
                const Place place = disk.is_full
                                        ? Place{tin.key(disk.towards), {}}
                                        : Place{tin.key(disk.vertex), disks.touching_point(tin.keys, i)};
                look_at(i, place);
                look_at(disk.touched, place);
            }
            CHECK(defects == 0);
        });
    }

    TEST_CASE("each disk has its circle through its vertex and its centre on the edge to an earlier vertex") {
        for_each_family(2, 60, [](Random& /*random*/, const Tin& tin, const BlockingDisks& disks) {
            std::vector<bool> is_labelled(tin.vertex_count());
            is_labelled[0] = true;
            for (const BlockingDisk& disk : disks.disks()) {
                REQUIRE(is_labelled[disk.towards.value]);
                REQUIRE(!is_labelled[disk.vertex.value]);
                is_labelled[disk.vertex.value] = true;
                const Key2 j = tin.key(disk.vertex);
                const Key2 i = tin.key(disk.towards);
                const double length = std::hypot(i.x - j.x, i.y - j.y);
                const double radius = std::hypot(disk.center.x, disk.center.y);
                CHECK(std::abs(radius - disk.radius) <= 1e-12 * radius);
                CHECK(disk.center.x * length == doctest::Approx((i.x - j.x) * radius).epsilon(1e-9));
                CHECK(disk.center.y * length == doctest::Approx((i.y - j.y) * radius).epsilon(1e-9));
                CHECK(disk.radius > 0);
                CHECK(disk.radius <= 0.5 * length * (1 + 1e-12));
                CHECK((!disk.is_full || disk.radius >= 0.5 * length * (1 - 1e-12)));
            }
        });
    }

    TEST_CASE("chords are where a segment is inside a disk, gaps where it is in none") {
        for_each_family(4, 100, [](Random& random, const Tin& tin, const BlockingDisks& disks) {
            const auto last = static_cast<std::int64_t>(tin.vertex_count()) - 1;
            const VertexId p{static_cast<std::uint32_t>(random.integer(0, last))};
            const VertexId q{static_cast<std::uint32_t>(random.integer(0, last))};
            if (p == q) {
                return;
            }
            const Key2 a = tin.key(p);
            const Key2 b = tin.key(q);
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const auto depth = [&](const BlockingDisk& disk, double share) {
                const Place place{a, {share * (b.x - a.x), share * (b.y - a.y)}};
                return disk.radius - distance(center_of(tin, disk), place);
            };
            const auto is_in_none = [&](double from, double to) {
                const double share = 0.5 * (from + to);
                return std::all_of(disks.disks().begin(), disks.disks().end(), [&](const BlockingDisk& disk) {
                    // Chords shorter than a step are no chords; they are no deeper than that.
                    return depth(disk, share) < 1;
                });
            };
            double before = 0;
            for (const Chord& chord : disks.find_chords(tin.keys, p, q)) {
                CHECK(chord.from >= before);
                CHECK(chord.to > chord.from);
                CHECK(chord.to <= 1);
                const BlockingDisk& disk = disks.disks()[chord.disk];
                CHECK(depth(disk, 0.5 * (chord.from + chord.to)) > 0);
                CHECK(std::abs(depth(disk, chord.from)) < 1e-9L * length + 1e-3L);
                CHECK(std::abs(depth(disk, chord.to)) < 1e-9L * length + 1e-3L);
                CHECK(is_in_none(before, chord.from));
                before = chord.to;
            }
            CHECK(is_in_none(before, 1));
        });
    }

    TEST_CASE("two vertices have the disk between them") {
        const Tin tin = delaunay_tin({{0, 0}, {6, 8}});
        const BlockingDisks disks = disks_of(tin);
        REQUIRE(disks.disks().size() == 1);
        CHECK(disks.disks()[0].radius == 5);
        CHECK(disks.disks()[0].touched == BlockingDisk::kNone);
        const std::vector<Chord> chords = disks.find_chords(tin.keys, {0}, {1});
        REQUIRE(chords.size() == 1);
        CHECK(chords[0].from == 0);
        CHECK(chords[0].to == 1);
    }

    TEST_CASE("a bend keeps the later disk away from the earlier one's circle") {
        // D_1 has the diameter from (0, 0) to (10, 0); the circle through (10, 12) that touches it from above
        // has its centre at (10, 12 - r) with (17 - 5 - r)^2 + 5^2 = (5 + r)^2, so r = 144 / 34.
        const Tin tin = delaunay_tin({{0, 0}, {10, 0}, {10, 12}});
        const BlockingDisks disks = disks_of(tin);
        REQUIRE(disks.disks().size() == 2);
        CHECK(disks.disks()[1].radius == doctest::Approx(144.0 / 34));
        CHECK(!disks.disks()[1].is_full);
        CHECK(disks.disks()[1].touched == 0);
    }
}
