#include "tinwright/water/banks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/water/water_mesh.hpp"

#include "support/bank_sets.hpp"
#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Rings = std::vector<std::vector<Key2>>;
using KeyPair = std::pair<double, double>;

KeyPair pair_of(Key2 key) { return {key.x, key.y}; }

std::size_t find_root(std::vector<std::size_t>& parents, std::size_t i) {
    while (parents[i] != i) {
        i = parents[i] = parents[parents[i]];
    }
    return i;
}

// Parts, by the edges that join things.
class Parts {
  public:
    explicit Parts(std::size_t count) : parents_(count), count_(count) {
        std::iota(parents_.begin(), parents_.end(), std::size_t{0});
    }
    // Whether they were apart.
    bool join(std::size_t a, std::size_t b) {
        a = find_root(parents_, a);
        b = find_root(parents_, b);
        parents_[std::max(a, b)] = std::min(a, b);
        count_ -= a == b ? 0 : 1;
        return a != b;
    }
    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    std::vector<std::size_t> parents_;
    std::size_t count_;
};

Key2 scaled(Key2 key, double factor) { return {key.x * factor, key.y * factor}; }

Rings scaled(Rings rings, double factor) {
    for (auto& ring : rings) {
        for (Key2& key : ring) {
            key = scaled(key, factor);
        }
    }
    return rings;
}

template <class Visit>
void for_each_side(const Rings& rings, const Visit& visit) {
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            visit(ring[i], ring[(i + 1) % ring.size()]);
        }
    }
}

// Whether a point that is on no ring has an odd number of sides to the right of it.
bool is_inside(const Rings& rings, Key2 p) {
    bool is_odd = false;
    for_each_side(rings, [&](Key2 a, Key2 b) {
        if ((a.y > p.y) != (b.y > p.y)) {
            is_odd ^= oracle::turn(a, b, p) * (b.y > a.y ? 1 : -1) > 0;
        }
    });
    return is_odd;
}

// Whether the inside of a segment is inside, and no ring meets it there.
bool runs_inside(const Rings& rings, Key2 a, Key2 b) {
    bool is_clear = true;
    for_each_side(rings, [&](Key2 c, Key2 d) {
        is_clear = is_clear && !oracle::do_cross(a, b, c, d) && !oracle::is_inside_segment(c, a, b) &&
                   !oracle::is_inside_segment(a, c, d) && !oracle::is_inside_segment(b, c, d);
    });
    return is_clear && is_inside(scaled(rings, 2), {a.x + b.x, a.y + b.y});
}

class NetworkTest {
  public:
    explicit NetworkTest(const Rings& rings) : rings_(rings), network_(make_bank_network(rings)) {}

    [[nodiscard]] const BankNetwork& network() const { return network_; }

    void check_sections() const {
        std::set<std::array<std::uint32_t, 2>> seen;
        for (std::uint32_t s = 0; s < network_.sections.size(); ++s) {
            const BankSection& section = network_.sections[s];
            CHECK(section.vertices.size() >= (section.is_straight ? 2U : 3U));
            for (const auto& v : section.vertices) {
                CHECK(seen.insert(v).second);
                const BankPlace& place = network_.places.at(v[0]).at(v[1]);
                CHECK(place.a == s);
                CHECK(place.b == s);
            }
            CHECK(section.width > 0);
            if (section.is_straight) {
                REQUIRE(section.vertices.size() == 2);
                const Key2 a = key(section.vertices[0]);
                const Key2 b = key(section.vertices[1]);
                CHECK(section.middle == Point2{(a.x + b.x) / 2, (a.y + b.y) / 2});
                CHECK(section.width == doctest::Approx(std::hypot(a.x - b.x, a.y - b.y)));
            }
        }
    }

    void check_sections_are_inside() const {
        std::vector<std::array<Key2, 2>> straight;
        for (const BankSection& section : network_.sections) {
            if (section.is_straight) {
                straight.push_back({key(section.vertices[0]), key(section.vertices[1])});
                CHECK(runs_inside(rings_, straight.back()[0], straight.back()[1]));
            }
        }
        for (std::size_t i = 0; i < straight.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                CHECK_FALSE(oracle::do_cross(straight[i][0], straight[i][1], straight[j][0], straight[j][1]));
            }
        }
    }

    void check_links() const {
        std::vector<std::size_t> counts(network_.sections.size(), 0);
        for (const BankLink& link : network_.links) {
            REQUIRE(link.a < network_.sections.size());
            REQUIRE(link.b < network_.sections.size());
            CHECK(link.a != link.b);
            ++counts[link.a];
            ++counts[link.b];
            REQUIRE(link.path.size() >= 2);
            CHECK(link.path.front() == network_.sections[link.a].middle);
            CHECK(link.path.back() == network_.sections[link.b].middle);
            double length = 0;
            for (std::size_t i = 1; i < link.path.size(); ++i) {
                length +=
                    std::hypot(link.path[i].x - link.path[i - 1].x, link.path[i].y - link.path[i - 1].y);
            }
            CHECK(link.length == doctest::Approx(length));
            CHECK(link.length > 0);
        }
        std::vector<std::uint32_t> ends;
        for (std::uint32_t s = 0; s < counts.size(); ++s) {
            if (counts[s] == 1) {
                ends.push_back(s);
            }
        }
        CHECK(network_.ends == ends);
    }

    // Middles of edges and faces are lattice points six times as fine.
    void check_paths_are_inside() const {
        const Rings fine = scaled(rings_, 6);
        const auto fine_key = [](Point2 p) { return Key2{std::round(p.x * 6), std::round(p.y * 6)}; };
        for (const BankLink& link : network_.links) {
            for (std::size_t i = 1; i < link.path.size(); ++i) {
                CHECK(runs_inside(fine, fine_key(link.path[i - 1]), fine_key(link.path[i])));
            }
        }
    }

    void check_places() const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> linked = links();
        REQUIRE(network_.places.size() == rings_.size());
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            REQUIRE(network_.places[r].size() == rings_[r].size());
            for (const BankPlace& place : network_.places[r]) {
                REQUIRE(place.a < network_.sections.size());
                REQUIRE(place.b < network_.sections.size());
                if (place.a == place.b) {
                    CHECK(place.part == 0);
                } else {
                    CHECK(linked.count(std::minmax(place.a, place.b)) == 1);
                    CHECK(place.part > 0);
                    CHECK(place.part < 1);
                }
            }
        }
    }

    // Of any face the vertices stand between two sections that are linked, or at one: with levels that fall
    // along links, all of its water is between theirs.
    void check_faces_fall() const {
        const std::set<std::pair<std::uint32_t, std::uint32_t>> linked = links();
        const WaterMesh water = make_water_mesh(rings_);
        const std::vector<BankPlace> places = places_by_vertex(water);
        for (FaceId f{0}; f.value < water.mesh.slot_count(); ++f.value) {
            if (!water.mesh.is_terrain(f)) {
                continue;
            }
            std::set<std::uint32_t> sections;
            for (const VertexId v : water.mesh.face(f).vertex) {
                sections.insert(places[v.value].a);
                sections.insert(places[v.value].b);
            }
            CHECK(sections.size() <= 2);
            if (sections.size() == 2) {
                CHECK(linked.count({*sections.begin(), *sections.rbegin()}) == 1);
            }
        }
    }

    // One part; as many cycles as islands, but for those in level water: what is level counts as one place.
    void check_topology() const {
        Parts parts(network_.sections.size());
        std::size_t cycles = 0;
        for (const BankLink& link : network_.links) {
            cycles += parts.join(link.a, link.b) ? 0U : 1U;
        }
        CHECK(parts.count() == 1);
        const WaterMesh water = make_water_mesh(rings_);
        const std::vector<BankPlace> places = places_by_vertex(water);
        const auto level_of = [&](FaceId f) {
            std::set<std::uint32_t> sections;
            for (const VertexId v : water.mesh.face(f).vertex) {
                sections.insert(places[v.value].a);
                sections.insert(places[v.value].b);
            }
            return sections.size() == 1 ? std::int64_t{*sections.begin()} : std::int64_t{-1};
        };
        Parts level(water.mesh.slot_count());
        std::size_t level_cycles = 0;
        for (FaceId f{0}; f.value < water.mesh.slot_count(); ++f.value) {
            for (unsigned corner = 0; corner < 3 && water.mesh.is_terrain(f); ++corner) {
                const HalfEdgeId h = half_edge(f, corner);
                const FaceId g = face_of(water.mesh.twin(h));
                if (!water.mesh.is_constrained(h) && f < g && level_of(f) >= 0 &&
                    level_of(f) == level_of(g)) {
                    level_cycles += level.join(f.value, g.value) ? 0U : 1U;
                }
            }
        }
        CHECK(cycles + level_cycles == rings_.size() - 1);
    }

  private:
    [[nodiscard]] Key2 key(const std::array<std::uint32_t, 2>& v) const { return rings_.at(v[0]).at(v[1]); }

    [[nodiscard]] std::set<std::pair<std::uint32_t, std::uint32_t>> links() const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> linked;
        for (const BankLink& link : network_.links) {
            linked.insert(std::minmax(link.a, link.b));
        }
        return linked;
    }

    [[nodiscard]] std::vector<BankPlace> places_by_vertex(const WaterMesh& water) const {
        std::vector<BankPlace> places(water.keys.size());
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            for (std::size_t i = 0; i < rings_[r].size(); ++i) {
                places[water.rings[r][i].value] = network_.places[r][i];
            }
        }
        return places;
    }

    Rings rings_;
    BankNetwork network_;
};

template <class Check>
void on_families(int usual, std::size_t most, const Check& check) {
    for (const BankFamily& family : bank_families()) {
        CAPTURE(family.name);
        for (int seed = 0; seed < cases(usual); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const auto size = static_cast<std::size_t>(random.integer(12, static_cast<std::int64_t>(most)));
            check(family.make(random, size), random);
        }
    }
}

// A network by the keys of its vertices.
struct KeyedNetwork {
    std::vector<std::vector<KeyPair>> sections;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> links;
    std::vector<std::vector<std::pair<double, double>>> paths;
    std::map<KeyPair, std::array<double, 3>> places;
    std::vector<std::uint32_t> ends;
    friend bool operator==(const KeyedNetwork&, const KeyedNetwork&) = default;
};

KeyedNetwork keyed(const Rings& rings) {
    const BankNetwork network = make_bank_network(rings);
    KeyedNetwork result;
    for (const BankSection& section : network.sections) {
        auto& keys = result.sections.emplace_back();
        for (const auto& v : section.vertices) {
            keys.push_back(pair_of(rings.at(v[0]).at(v[1])));
        }
    }
    for (const BankLink& link : network.links) {
        result.links.emplace_back(link.a, link.b);
        auto& path = result.paths.emplace_back();
        for (const Point2& p : link.path) {
            path.emplace_back(p.x, p.y);
        }
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
        for (std::size_t i = 0; i < rings[r].size(); ++i) {
            const BankPlace& place = network.places[r][i];
            result.places[pair_of(rings[r][i])] = {static_cast<double>(place.a), static_cast<double>(place.b),
                                                   place.part};
        }
    }
    result.ends = network.ends;
    return result;
}

}  // namespace

TEST_SUITE("water/banks") {
    TEST_CASE("sections share no vertex, and have their own places") {
        on_families(40, 300, [](const BankSet& set, Random&) { NetworkTest(set.rings).check_sections(); });
    }

    TEST_CASE("straight sections are inside and do not cross") {
        on_families(8, 120,
                    [](const BankSet& set, Random&) { NetworkTest(set.rings).check_sections_are_inside(); });
    }

    TEST_CASE("links run from middle to middle; ends have one") {
        on_families(40, 300, [](const BankSet& set, Random&) { NetworkTest(set.rings).check_links(); });
    }

    TEST_CASE("paths of links stay inside") {
        on_families(4, 100,
                    [](const BankSet& set, Random&) { NetworkTest(set.rings).check_paths_are_inside(); });
    }

    TEST_CASE("every vertex is between sections that are linked") {
        on_families(40, 300, [](const BankSet& set, Random&) { NetworkTest(set.rings).check_places(); });
    }

    TEST_CASE("no face reaches beyond two linked sections") {
        on_families(40, 300, [](const BankSet& set, Random&) { NetworkTest(set.rings).check_faces_fall(); });
    }

    TEST_CASE("sections hang together, with a cycle for each island that is not in level water") {
        on_families(40, 300, [](const BankSet& set, Random&) { NetworkTest(set.rings).check_topology(); });
    }

    TEST_CASE("where rings begin, which way they go and their order do not matter") {
        on_families(20, 200, [](const BankSet& set, Random& random) {
            Rings rings = set.rings;
            for (auto& ring : rings) {
                const auto shift = random.integer(0, static_cast<std::int64_t>(ring.size()) - 1);
                std::rotate(ring.begin(), ring.begin() + shift, ring.end());
                if (random.integer(0, 1) == 0) {
                    std::reverse(ring.begin(), ring.end());
                }
            }
            CHECK(keyed(shuffled(random, rings)) == keyed(set.rings));
        });
    }

    TEST_CASE("a straight channel has a section at every station, square to it") {
        for (const double width : {3.0, 10.0, 20.0, 47.0}) {
            CAPTURE(width);
            const BankSet set = straight_banks(50, 10, width);
            const BankNetwork network = make_bank_network(set.rings);
            std::size_t square = 0;
            for (const BankSection& section : network.sections) {
                REQUIRE(section.is_straight);
                square += section.width == width ? 1U : 0U;
            }
            CHECK(square == network.sections.size());
            CHECK(static_cast<double>(square) >= 48 - width / 10);
            CHECK(network.links.size() == square - 1);
            CHECK(network.ends.size() == 2);
        }
    }

    TEST_CASE("islands make as many cycles") {
        for (std::size_t count = 0; count <= 6; ++count) {
            CAPTURE(count);
            std::vector<std::size_t> islands(count);
            std::iota(islands.begin(), islands.end(), std::size_t{1});
            const BankSet set = meander_banks(8, 1.2, 400, 10000, islands);
            REQUIRE(set.islands() == count);
            const BankNetwork network = make_bank_network(set.rings);
            CHECK(network.links.size() + 1 == network.sections.size() + count);
            CHECK(network.ends.size() == 2);
            CHECK(std::count_if(network.sections.begin(), network.sections.end(), [](const BankSection& s) {
                      return !s.is_straight;
                  }) == static_cast<std::ptrdiff_t>(2 * count));
        }
    }
}
