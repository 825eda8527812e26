#include "tinwright/geometry/lattice.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_key(double v) { return v >= 0 && v < kKeyLimit && std::floor(v) == v; }

/// Every sample has an integer key within the limit and comes back bit for bit.
void require_round_trip(const std::vector<Point3>& samples, const Lattice& lattice) {
    for (const Point3& sample : samples) {
        const Key2 key = lattice.key({sample.x, sample.y});
        REQUIRE(is_key(key.x));
        REQUIRE(is_key(key.y));
        const Point2 back = lattice.position(key);
        REQUIRE(same_bits(back.x, sample.x));
        REQUIRE(same_bits(back.y, sample.y));
    }
}

std::string refusal_of(const std::vector<Point3>& samples) {
    return message_of<InputError>([&] { find_lattice(samples); });
}

}  // namespace

TEST_SUITE("geometry/lattice") {
    TEST_CASE("decimals come back bit for bit, at small and at UTM magnitudes") {
        for (int decimals = 0; decimals <= 9; ++decimals) {
            CAPTURE(decimals);
            for (int seed = 0; seed < cases(20); ++seed) {
                CAPTURE(seed);
                Random random(static_cast<std::uint64_t>(seed));
                const double extent = 0.5 + 9000 * random.real();
                // Nine decimals of a northing are 16 digits: more than doubles tell apart from any others.
                const bool is_utm = seed % 2 == 0 && decimals < 9;
                const std::vector<Point3> samples = decimal_samples(
                    random, 500, decimals, is_utm ? 323456 : -40, is_utm ? 5123456 : -900, extent);
                const FoundLattice found = find_lattice(samples);
                REQUIRE(found.lattice.is_exact());
                REQUIRE(found.lattice.decimals() >= 0);
                REQUIRE(found.lattice.decimals() <= decimals);
                require_round_trip(samples, found.lattice);
            }
        }
    }

    TEST_CASE("the coarsest lattice is taken") {
        CHECK(find_lattice(std::vector<Point3>{{1, 2, 0}, {30, 40, 0}}).lattice.decimals() == 0);
        CHECK(find_lattice(std::vector<Point3>{{1.5, 2, 0}, {30, 40, 0}}).lattice.decimals() == 1);
        CHECK(find_lattice(std::vector<Point3>{{1.5, 2.25, 0}, {30, 40, 0}}).lattice.decimals() == 2);
        CHECK(find_lattice(std::vector<Point3>{{323456.01, 5123456.1, 0}}).lattice.decimals() == 2);
        CHECK(find_lattice(std::vector<Point3>{{0.1, 0.2, 0.123456789}}).lattice.decimals() == 1);
        CHECK(find_lattice(std::vector<Point3>{{1.5, 2.25, 0}, {30, 40, 0}}).lattice.quantum() == 0.01);
    }

    TEST_CASE("lines with more decimals than there is room for are moved to the samples' lattice") {
        const std::vector<Point3> samples = {{0, 0, 1}, {60, 60, 1}};
        const std::vector<Point3> made = {{5.0 + 0x1p-13, 7, 2}};
        const FoundLattice found = find_lattice(samples, made);
        CHECK(found.lattice.decimals() == 0);
        CHECK(found.lattice.position(found.lattice.key({made[0].x, made[0].y})) ==
              Point2{made[0].x, made[0].y});
    }

    TEST_CASE("decimal rows are collinear on the lattice, as they are not in binary") {
        for (int seed = 0; seed < cases(50); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::int64_t x = random.integer(0, 50000000);
            const std::int64_t y = random.integer(0, 500000000);
            const std::int64_t dx = random.integer(-300, 300);
            const std::int64_t dy = random.integer(-300, 300);
            std::vector<Point3> samples;
            for (std::int64_t i = 0; i < 100; ++i) {
                samples.push_back(
                    {oracle::decimal_value(x + i * dx, 2), oracle::decimal_value(y + i * dy, 2), 0});
            }
            const Lattice lattice = find_lattice(samples).lattice;
            const auto key = [&](std::size_t i) { return lattice.key({samples[i].x, samples[i].y}); };
            for (std::size_t i = 2; i < samples.size(); ++i) {
                REQUIRE(oracle::orient2d(key(0), key(1), key(i)) == 0);
            }
        }
    }

    TEST_CASE("dyadic coordinates that are no short decimals get an exact binary lattice") {
        Random random(3);
        std::vector<Point3> samples;
        for (int i = 0; i < 200; ++i) {
            samples.push_back({std::ldexp(random.key(0x1p44), -40), std::ldexp(random.key(0x1p44), -40), 0});
        }
        const FoundLattice found = find_lattice(samples);
        CHECK(found.lattice.is_exact());
        CHECK(found.lattice.decimals() == -1);
        CHECK(found.lattice.exponent() >= -40);
        CHECK(found.lattice.quantum() == std::ldexp(1.0, found.lattice.exponent()));
        require_round_trip(samples, found.lattice);
    }

    TEST_CASE("coordinates with 17 digits lie within half a quantum of a lattice that says so") {
        for (int seed = 0; seed < cases(50); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            std::vector<Point3> samples;
            for (int i = 0; i < 300; ++i) {
                samples.push_back({1000 * random.real() / 3, 1000 * random.real() / 7, 0});
            }
            const Lattice lattice = find_lattice(samples).lattice;
            REQUIRE_FALSE(lattice.is_exact());
            for (const Point3& sample : samples) {
                const Key2 key = lattice.key({sample.x, sample.y});
                REQUIRE(is_key(key.x));
                REQUIRE(is_key(key.y));
                const Point2 back = lattice.position(key);
                REQUIRE(std::abs(back.x - sample.x) <= 0.5 * lattice.quantum());
                REQUIRE(std::abs(back.y - sample.y) <= 0.5 * lattice.quantum());
                REQUIRE(lattice.key(back) == key);
            }
            // The finest that spans them: a step is less than 2^-43 of the extent.
            REQUIRE(lattice.quantum() < 334 * 0x1p-43);
        }
    }

    TEST_CASE("a translation by whole steps leaves the keys alone") {
        Random random(8);
        std::vector<Point3> samples;
        std::vector<Point3> moved;
        for (int i = 0; i < 300; ++i) {
            const std::int64_t x = random.integer(0, 1000000);
            const std::int64_t y = random.integer(0, 1000000);
            samples.push_back({oracle::decimal_value(x, 3), oracle::decimal_value(y, 3), 0});
            moved.push_back(
                {oracle::decimal_value(x - 123456789, 3), oracle::decimal_value(y + 5000000001, 3), 0});
        }
        const Lattice here = find_lattice(samples).lattice;
        const Lattice there = find_lattice(moved).lattice;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            REQUIRE(here.key({samples[i].x, samples[i].y}) == there.key({moved[i].x, moved[i].y}));
        }
    }

    TEST_CASE("the lattice does not depend on the order of the samples") {
        Random random(21);
        const std::vector<Point3> samples = scan_samples(random, 20000);
        const FoundLattice found = find_lattice(samples);
        const FoundLattice again = find_lattice(shuffled(random, samples));
        CHECK(found.lattice == again.lattice);
        CHECK(found.bounds == again.bounds);
        CHECK(found.lattice.decimals() == 2);
        CHECK(found.lattice.key({found.bounds.x_min, found.bounds.y_min}) == Key2{0, 0});
    }

    TEST_CASE("samples too large for the decimals of others make the lattice binary in any order") {
        std::vector<Point3> samples = {
            {2251799813685.5, 0, 0}, {2251799813685.123, 1, 0}, {2251799813684.25, 7, 0}};
        const Lattice lattice = find_lattice(samples).lattice;
        CHECK(lattice.decimals() == 0);
        CHECK(lattice.refinement() == 9);
        std::swap(samples[0], samples[1]);
        CHECK(find_lattice(samples).lattice == lattice);
    }

    TEST_CASE("a refined lattice keeps positions bit for bit, and is found again from points made on it") {
        for (int seed = 1; seed <= cases(50); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const int decimals = static_cast<int>(random.integer(0, 4));
            std::vector<Point3> samples = decimal_samples(random, 100, decimals, 323456, 5123456, 2000);
            const FoundLattice found = find_lattice(samples);
            const Key2 corner = found.lattice.key({found.bounds.x_max, found.bounds.y_max});
            const int bits = found.lattice.refinement_room(std::max(corner.x, corner.y));
            REQUIRE(bits > 0);
            const Lattice fine = found.lattice.refined(bits);
            const double scale = std::ldexp(1.0, bits);
            for (const Point3& p : samples) {
                const Key2 key = found.lattice.key({p.x, p.y});
                REQUIRE(fine.key({p.x, p.y}) == Key2{key.x * scale, key.y * scale});
                REQUIRE(same_bits(fine.position(fine.key({p.x, p.y})).x, p.x));
            }
            // Points made anywhere in between, as far as doubles tell them apart.
            for (int i = 0; i < 100; ++i) {
                const Point2 made =
                    fine.position({random.key(corner.x * scale), random.key(corner.y * scale)});
                samples.push_back({made.x, made.y, 0});
            }
            const Lattice again = find_lattice(samples).lattice;
            REQUIRE(again.decimals() == found.lattice.decimals());
            REQUIRE(again.quantum() == fine.quantum());
        }
    }

    TEST_CASE("a coarse lattice has room for no refinement") {
        const Lattice lattice = Lattice::decimal(0, {});
        CHECK(lattice.refinement_room(kKeyLimit / 2) == 0);
        CHECK(lattice.refinement_room(1) == kRefinementBits);
        CHECK(lattice.refined(3).refinement_room(1) == kRefinementBits - 3);
    }

    TEST_CASE("a negative zero comes back as zero") {
        const Lattice lattice = find_lattice(std::vector<Point3>{{-0.0, 1, 0}, {2, -0.0, 0}}).lattice;
        CHECK(same_bits(lattice.position(lattice.key({-0.0, 1})).x, 0.0));
        CHECK(same_bits(lattice.position(lattice.key({2, -0.0})).y, 0.0));
    }

    TEST_CASE("positions between lattice points go to the nearest") {
        const Lattice lattice = Lattice::decimal(1, {100, 200});
        CHECK(lattice.key({10.04, 20.06}) == Key2{0, 1});
        CHECK(lattice.position({5, 7}) == Point2{10.5, 20.7});
        const Lattice binary = Lattice::binary(-2, {0, 0}, true);
        CHECK(binary.key({0.3, 0.4}) == Key2{1, 2});
        CHECK(binary.position({3, 5}) == Point2{0.75, 1.25});
    }

    TEST_CASE("no sample gives the plain lattice and no bounds") {
        const FoundLattice found = find_lattice({});
        CHECK(found.lattice == Lattice{});
        CHECK(found.bounds.is_empty());
    }

    TEST_CASE("a coordinate that is not finite is refused by its sample's number") {
        for (const double bad :
             {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
              -std::numeric_limits<double>::infinity()}) {
            const std::vector<Point3> samples{{0, 0, 0}, {1, bad, 0}, {bad, 1, 0}};
            try {
                find_lattice(samples);
                FAIL("accepted");
            } catch (const InputError& error) {
                CHECK(std::string(error.what()) == "a sample's x or y is not a finite number; remove it");
                CHECK(error.samples() == std::vector<std::size_t>{1});
            }
        }
    }

    TEST_CASE("too large a dynamic range of decimals is refused with both numbers and what to do") {
        CHECK(
            refusal_of({{0.001, 0, 0}, {1e12, 0, 0}}) ==
            "the samples span 999999999999999 steps of their last decimal, 0.001, above the limit of 2^45 = "
            "35184372088832; remove outlying samples or round the coordinates");
        // The widest that fits, and one step more.
        CHECK(refusal_of({{0, 0, 0}, {35184372088831, 1, 0}}) == "");
        CHECK(refusal_of({{0, 0, 0}, {35184372088832, 1, 0}}) != "");
    }
}
