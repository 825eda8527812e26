#include "tinwright/delaunay/chord_ends.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

// Two vertices, and edges that pass between them through the disk of which they are a diameter; the ends of
// the edges are in rows far away.
struct Example {
    Tin tin;
    BlockingDisks disks;
    std::vector<LineInDisks> edges;
};

Example make_example(Random& random, int count) {
    constexpr double kScale = 1048576;
    std::vector<Key2> keys{{0, 9900 * kScale}, {0, 10100 * kScale}};
    for (Key2& key : keys) {
        key.x = 10000 * kScale + std::floor(random.key(kScale));
    }
    std::vector<std::pair<Key2, Key2>> ends;
    for (int i = 0; i < count; ++i) {
        const double y = 9903 + 194.0 / count * i;
        const auto end = [&](double x) {
            return Key2{(x + random.key(500)) * kScale,
                        std::round((y + 100.0 / count * random.real()) * kScale)};
        };
        ends.emplace_back(end(9000), end(10500));
        keys.insert(keys.end(), {ends.back().first, ends.back().second});
    }
    Tin tin = delaunay_tin(keys);
    BlockingDisks disks(tin.keys, make_minimum_spanning_tree(tin.mesh, tin.keys));
    std::vector<LineInDisks> edges;
    const auto vertex = [&](Key2 key) {
        std::uint32_t v = 0;
        while (!(tin.keys[v] == key)) {
            ++v;
        }
        return VertexId{v};
    };
    for (const auto& [a, b] : ends) {
        LineInDisks edge;
        edge.p = vertex(a);
        edge.q = vertex(b);
        edge.length = std::hypot(b.x - a.x, b.y - a.y);
        edge.chords = disks.find_chords(tin.keys, edge.p, edge.q);
        edges.push_back(std::move(edge));
    }
    return {std::move(tin), std::move(disks), std::move(edges)};
}

// How many chords in the widest disk are no Delaunay edges of all ends in it once they are rounded.
std::size_t count_open(const Example& example) {
    std::uint32_t widest = 0;
    const std::vector<BlockingDisk>& disks = example.disks.disks();
    for (std::uint32_t i = 1; i < disks.size(); ++i) {
        widest = disks[i].radius > disks[widest].radius ? i : widest;
    }
    std::vector<std::pair<Key2, Key2>> chords;
    for (const LineInDisks& edge : example.edges) {
        const Key2 p = example.tin.key(edge.p);
        const Key2 q = example.tin.key(edge.q);
        const auto at = [&](double t) {
            return Key2{std::round(p.x + t * (q.x - p.x)), std::round(p.y + t * (q.y - p.y))};
        };
        for (const Chord& chord : edge.chords) {
            if (chord.disk == widest) {
                chords.emplace_back(at(chord.from), at(chord.to));
            }
        }
    }
    REQUIRE(chords.size() >= 10);
    std::vector<Key2> ends;
    for (const auto& [a, b] : chords) {
        ends.insert(ends.end(), {a, b});
    }
    std::size_t open = 0;
    for (const auto& [a, b] : chords) {
        bool is_open = false;
        for (const Key2 c : ends) {
            for (const Key2 d : ends) {
                is_open = is_open || (oracle::orient2d(a, b, c) > 0 && oracle::orient2d(a, b, d) < 0 &&
                                      oracle::incircle(a, b, c, d) > 0);
            }
        }
        open += is_open ? 1U : 0U;
    }
    return open;
}

}  // namespace

TEST_SUITE("delaunay/chord_ends") {
    TEST_CASE("chords in one disk are Delaunay after rounding once their ends are moved") {
        std::size_t open_before = 0;
        for (int seed = 1; seed <= cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Example example = make_example(random, 20);
            open_before += count_open(example);
            move_chord_ends(example.disks, example.tin.keys, example.edges);
            CHECK(count_open(example) == 0);
        }
        CHECK(open_before > 0);  // what all this is for
    }

    TEST_CASE("ends move by little, and not at all at vertices") {
        for (int seed = 1; seed <= cases(10); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Example example = make_example(random, 20);
            const std::vector<LineInDisks> before = example.edges;
            move_chord_ends(example.disks, example.tin.keys, example.edges);
            for (std::size_t k = 0; k < before.size(); ++k) {
                REQUIRE(example.edges[k].chords.size() == before[k].chords.size());
                for (std::size_t i = 0; i < before[k].chords.size(); ++i) {
                    const Chord& old = before[k].chords[i];
                    const Chord& moved = example.edges[k].chords[i];
                    CHECK(moved.disk == old.disk);
                    CHECK((old.from > 0 || moved.from == 0));
                    CHECK((old.to < 1 || moved.to == 1));
                    CHECK(std::abs(moved.from - old.from) <= 0.0501 * (old.to - old.from));
                    CHECK(std::abs(moved.to - old.to) <= 0.0501 * (old.to - old.from));
                }
            }
        }
    }
}
