#include "tinwright/surface/sample_tree.hpp"

#include <optional>

#include <doctest/doctest.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/surface/nearest.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

/// All vertices, one after the other.
VertexId slow_nearest(const Tin& tin, const QueryLattice& lattice, Key2 at) {
    std::optional<VertexId> best;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const bool is_made = tin.sample[v] == Tin::kNoSample || tin.sample[v] == Tin::kCrossing ||
                             tin.sample[v] == Tin::kInserted;
        if (!is_made && (!best || compare_distances(at, lattice.scaled(tin.keys[v]), at,
                                                    lattice.scaled(tin.key(*best))) < 0)) {
            best = VertexId{v};
        }
    }
    return *best;
}

}  // namespace

TEST_SUITE("surface/sample_tree") {
    TEST_CASE(
        "the vertex found is the nearest given one, the first of several, from wherever the search starts") {
        for (const KeyFamily& family : key_families()) {
            for (int seed = 1; seed <= cases(5); ++seed) {
                CAPTURE(family.name);
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const std::vector<Key2> keys = without_repetitions(family.make(random, 200));
                if (keys.size() < 3) {
                    continue;
                }
                Tin tin = tin_of(in_curve_order(keys));
                for (std::uint32_t v = 1; v < tin.vertex_count(); ++v) {
                    tin.sample[v] = random.integer(0, 3) == 0 ? Tin::kNoSample : v;
                }
                tin.sample[0] = 0;
                const SampleTree tree(tin);
                const QueryLattice lattice(tin);
                std::optional<VertexId> near;
                for (int query = 0; query < 100; ++query) {
                    const auto a = static_cast<std::size_t>(
                        random.integer(0, static_cast<std::int64_t>(tin.vertex_count()) - 1));
                    const auto b = static_cast<std::size_t>(
                        random.integer(0, static_cast<std::int64_t>(tin.vertex_count()) - 1));
                    // Half-way between vertices, where two are equally near, or thereabouts.
                    const Key2 p = lattice.scaled(tin.keys[a]);
                    const Key2 q = lattice.scaled(tin.keys[b]);
                    const Key2 at{Lattice::nearest_integer((p.x + q.x) / 2) +
                                      static_cast<double>(random.integer(-1, 1)),
                                  Lattice::nearest_integer((p.y + q.y) / 2)};
                    const std::optional<VertexId> found = tree.nearest(at, near);
                    REQUIRE(found == slow_nearest(tin, lattice, at));
                    near = found;
                }
            }
        }
    }

    TEST_CASE("where no vertex was given all of them count") {
        Tin tin = delaunay_tin(grid_keys(3, 3));
        tin.sample.assign(9, Tin::kNoSample);
        CHECK(SampleTree(tin).nearest(QueryLattice(tin).scaled({2, 2})).has_value());
    }

    TEST_CASE("the nearest sample's elevation is read") {
        Tin tin = delaunay_tin(grid_keys(4, 4));
        for (std::size_t v = 0; v < tin.z.size(); ++v) {
            tin.z[v] = 10 * tin.keys[v].x + tin.keys[v].y;
        }
        const QueryLattice lattice(tin);
        const auto nearest = make_nearest(tin);
        const auto other = nearest->make_reader();
        const FaceId face{0};
        CHECK(other->elevation({face, lattice.at({1.2, 1.9})}) == 12);
        std::vector<VertexWeight> weights;
        other->find_weights({face, lattice.at({1.2, 1.9})}, weights);
        REQUIRE(weights.size() == 1);
        CHECK(tin.z[weights[0].vertex.value] == 12);
        CHECK(SampleTree(tin).distance(lattice.at({1, 1.5}), weights[0].vertex) == 0.5);
    }
}
