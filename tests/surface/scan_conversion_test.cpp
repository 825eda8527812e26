#include "tinwright/surface/scan_conversion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/breaklines/domain.hpp"

#include "support/cases.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using tinwright_tests::tin_of_samples;

namespace {

__extension__ using Wide = __int128;

/// A position in whole units of 10^-decimals.
struct Whole {
    std::int64_t x = 0;
    std::int64_t y = 0;
};

/// A case in whole numbers, from which samples, raster and oracle are all made.
struct WholeCase {
    int decimals = 0;
    std::vector<Whole> samples;
    std::vector<double> z;
    Whole corner;  // x_min, y_max
    Whole cell{1, 1};
    std::int64_t columns = 1;
    std::int64_t rows = 1;
};

double decimal(std::int64_t units, int decimals) {
    return static_cast<double>(units) / std::pow(10.0, decimals);
}

std::vector<Point3> samples_of(const WholeCase& whole) {
    std::vector<Point3> samples;
    for (std::size_t i = 0; i < whole.samples.size(); ++i) {
        samples.push_back({decimal(whole.samples[i].x, whole.decimals),
                           decimal(whole.samples[i].y, whole.decimals), whole.z[i]});
    }
    return samples;
}

GridGeometry grid_of(const WholeCase& whole) {
    return {decimal(whole.corner.x, whole.decimals),
            decimal(whole.corner.y, whole.decimals),
            decimal(whole.cell.x, whole.decimals),
            decimal(whole.cell.y, whole.decimals),
            whole.columns,
            whole.rows};
}

int side(Whole a, Whole b, Whole c) {
    const Wide area = static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

long double doubled(Whole a, Whole b, Whole c) {
    return static_cast<long double>(static_cast<Wide>(b.x - a.x) * (c.y - a.y) -
                                    static_cast<Wide>(b.y - a.y) * (c.x - a.x));
}

/// What a cell must hold: nothing, or an elevation; and whether it is on a border edge.
struct Expected {
    std::optional<long double> z;
    bool is_on_border = false;
};

/// All faces against one centre, in whole numbers.
class Oracle {
  public:
    Oracle(const WholeCase& whole, const Tin& tin) : whole_(whole), tin_(tin) {
        for (const std::uint32_t sample : tin.sample) {
            twice_.push_back({2 * whole.samples[sample].x, 2 * whole.samples[sample].y});
        }
    }

    [[nodiscard]] Expected at(std::int64_t column, std::int64_t row) const {
        const Whole centre{2 * whole_.corner.x + (2 * column + 1) * whole_.cell.x,
                           2 * whole_.corner.y - (2 * row + 1) * whole_.cell.y};
        Expected expected;
        for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
            if (tin_.mesh.is_terrain({f}) && look_at({f}, centre, expected)) {
                break;
            }
        }
        return expected;
    }

  private:
    /// Returns whether nothing can change any more.
    bool look_at(FaceId f, Whole centre, Expected& expected) const {
        const auto& v = tin_.mesh.face(f).vertex;
        const Whole p[] = {twice_[v[0].value], twice_[v[1].value], twice_[v[2].value]};
        if (side(p[0], p[1], centre) < 0 || side(p[1], p[2], centre) < 0 || side(p[2], p[0], centre) < 0) {
            return false;
        }
        const long double area = doubled(p[0], p[1], p[2]);
        expected.z = (doubled(centre, p[1], p[2]) / area) * tin_.z[v[0].value] +
                     (doubled(p[0], centre, p[2]) / area) * tin_.z[v[1].value] +
                     (doubled(p[0], p[1], centre) / area) * tin_.z[v[2].value];
        for (unsigned corner = 0; corner < 3; ++corner) {
            if (tin_.mesh.is_border(half_edge(f, corner)) &&
                side(p[corner], p[next_corner(corner)], centre) == 0) {
                expected.is_on_border = true;
                return true;
            }
        }
        return false;
    }

    const WholeCase& whole_;
    const Tin& tin_;
    std::vector<Whole> twice_;
};

template <class Value>
struct Raster {
    std::vector<Value> values;
    std::int64_t cells = 0;
};

constexpr double kNodata = -9999;

template <class Value>
Raster<Value> rasterise(const Tin& tin, const GridGeometry& grid, std::int64_t band_rows, int threads) {
    Raster<Value> raster;
    raster.values.assign(static_cast<std::size_t>(grid.columns * grid.rows), Value{7});
    tbb::task_arena arena(threads);
    arena.execute([&] {
        const ScanConverter converter(tin, grid, band_rows);
        for (std::int64_t band = 0; band < converter.band_count(); ++band) {
            const auto [first, end] = converter.band_rows(band);
            const auto values = std::span(raster.values)
                                    .subspan(static_cast<std::size_t>(first * grid.columns),
                                             static_cast<std::size_t>((end - first) * grid.columns));
            raster.cells += converter.fill(band, values, static_cast<Value>(kNodata));
        }
    });
    return raster;
}

double z_range(const WholeCase& whole) {
    const auto [low, high] = std::minmax_element(whole.z.begin(), whole.z.end());
    return std::max(std::abs(*low), std::abs(*high));
}

void check_against_oracle(const WholeCase& whole, const Tin& tin) {
    const GridGeometry grid = grid_of(whole);
    const Raster<double> raster = rasterise<double>(tin, grid, grid.rows, 1);
    const Oracle oracle(whole, tin);
    std::int64_t covered = 0;
    std::int64_t wrong = 0;
    for (std::int64_t row = 0; row < grid.rows; ++row) {
        for (std::int64_t column = 0; column < grid.columns; ++column) {
            const double value = raster.values[static_cast<std::size_t>(row * grid.columns + column)];
            const Expected expected = oracle.at(column, row);
            covered += expected.z ? 1 : 0;
            const bool is_right =
                expected.z ? std::abs(value - static_cast<double>(*expected.z)) <= 1e-9 * z_range(whole)
                           : value == kNodata;
            if (!is_right) {
                ++wrong;
                CAPTURE(column);
                CAPTURE(row);
                CAPTURE(value);
                CAPTURE(expected.z.has_value());
                CAPTURE(expected.is_on_border);
                CHECK(is_right);
                REQUIRE(wrong < 5);
            }
        }
    }
    // The converter counts writes, so equality also means that no cell was written twice.
    CHECK(raster.cells == covered);
}

void check_same_bytes(const Tin& tin, const GridGeometry& grid) {
    const Raster<float> reference = rasterise<float>(tin, grid, grid.rows, 1);
    for (const int threads : {1, 2, 4}) {
        for (const std::int64_t band_rows :
             {std::int64_t{1}, std::int64_t{3}, std::int64_t{7}, grid.rows + 5}) {
            const Raster<float> other = rasterise<float>(tin, grid, band_rows, threads);
            CAPTURE(threads);
            CAPTURE(band_rows);
            CHECK(other.cells == reference.cells);
            CHECK(std::memcmp(other.values.data(), reference.values.data(),
                              reference.values.size() * sizeof(float)) == 0);
        }
    }
}

std::uint64_t cases(int usual) { return static_cast<std::uint64_t>(tinwright_tests::cases(usual)); }

enum class Family { Random, Lattice, Sliver, Line };

std::int64_t pick(std::mt19937_64& random, std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(high - low + 1));
}

WholeCase make_case(Family family, std::mt19937_64& random) {
    WholeCase whole;
    whole.decimals = static_cast<int>(pick(random, 0, 3));
    const std::int64_t count = pick(random, 3, 40);
    const std::int64_t extent = family == Family::Sliver ? 100000 : pick(random, 2, 60);
    const Whole offset{pick(random, 0, 1) * 500000123, pick(random, 0, 1) * 6782553107};
    for (std::int64_t i = 0; i < count; ++i) {
        Whole at{pick(random, 0, extent), pick(random, 0, extent)};
        if (family == Family::Lattice) {
            at = {4 * (i % 6), 4 * (i / 6)};
        } else if (family == Family::Sliver) {
            at.y = at.x / 3 + pick(random, 0, 2);
        } else if (family == Family::Line) {
            at = i == 0 ? Whole{0, 20} : Whole{2 * i, 3 * i};
        }
        whole.samples.push_back({offset.x + at.x, offset.y + at.y});
        whole.z.push_back(static_cast<double>(pick(random, -1000, 1000)) / 8);
    }
    whole.columns = pick(random, 1, 40);
    whole.rows = pick(random, 1, 40);
    whole.cell = {std::max<std::int64_t>(1, (extent + pick(random, 0, extent)) / whole.columns),
                  std::max<std::int64_t>(1, (extent + pick(random, 0, extent)) / whole.rows)};
    if (family == Family::Lattice) {
        whole.cell = {pick(random, 1, 4), pick(random, 1, 4)};
    }
    whole.corner = {offset.x - pick(random, -extent / 4, extent / 4),
                    offset.y + whole.cell.y * whole.rows - pick(random, -extent / 4, extent / 4)};
    return whole;
}

/// A long edge, and centres as near to it as whole numbers can be: the doubled area they make with it is 1.
WholeCase make_near_miss(std::mt19937_64& random) {
    WholeCase whole;
    Whole far{pick(random, 1, std::int64_t{1} << 38), pick(random, 1, std::int64_t{1} << 38)};
    const std::int64_t divisor = std::gcd(far.x, far.y);
    far = {far.x / divisor, far.y / divisor};
    // Convergents of far.x / far.y; the last before the ratio itself is the near miss.
    Whole near{1, 0};
    Whole before{0, 1};
    for (std::int64_t a = far.x, b = far.y; b != 0;) {
        const std::int64_t quotient = a / b;
        const Whole convergent{quotient * near.x + before.x, quotient * near.y + before.y};
        if (convergent.x == far.x) {
            break;
        }
        before = near;
        near = convergent;
        const std::int64_t rest = a - quotient * b;
        a = b;
        b = rest;
    }
    whole.samples = {{0, 0}, far};
    // Both sides of the edge, or one, so that it is inside the terrain or its border.
    whole.samples.push_back({far.x, 0});
    if (random() % 2 == 0) {
        whole.samples.push_back({0, far.y});
    }
    if (random() % 2 == 0) {
        whole.samples[2] = {0, far.y};
    }
    for (std::size_t i = 0; i < whole.samples.size(); ++i) {
        whole.z.push_back(static_cast<double>(pick(random, -1000, 1000)) / 8);
    }
    whole.columns = pick(random, 1, 20);
    whole.rows = pick(random, 1, 20);
    const std::int64_t widest = random() % 2 == 0 ? 4 : std::max(far.x, far.y) / 8 + 4;
    whole.cell = {2 * pick(random, 1, widest), 2 * pick(random, 1, widest)};
    whole.corner = {near.x - whole.cell.x / 2 - whole.cell.x * pick(random, 0, whole.columns - 1),
                    near.y + whole.cell.y / 2 + whole.cell.y * pick(random, 0, whole.rows - 1)};
    return whole;
}

bool has_faces(const Tin& tin) { return tin.mesh.count_terrain() > 0; }

}  // namespace

TEST_SUITE("surface/scan_conversion") {
    TEST_CASE("every centre in the closed terrain has its value once, and no other has any") {
        for (const Family family : {Family::Random, Family::Lattice, Family::Sliver, Family::Line}) {
            for (std::uint64_t seed = 1; seed <= cases(150); ++seed) {
                CAPTURE(seed);
                CAPTURE(static_cast<int>(family));
                std::mt19937_64 random(seed);
                const WholeCase whole = make_case(family, random);
                std::vector<Point3> samples = samples_of(whole);
                if (samples.size() < 3) {
                    continue;
                }
                Tin tin = tin_of_samples(samples, DuplicatePolicy::First);
                if (!has_faces(tin)) {
                    continue;
                }
                check_against_oracle(whole, tin);
                for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                    if (random() % 4 == 0) {
                        tin.mesh.set_terrain({f}, false);
                    }
                }
                check_against_oracle(whole, tin);
            }
        }
    }

    TEST_CASE("a centre as near to an edge as can be is on its right side") {
        for (std::uint64_t seed = 1; seed <= cases(2000); ++seed) {
            CAPTURE(seed);
            std::mt19937_64 random(seed);
            const WholeCase whole = make_near_miss(random);
            const Tin tin = tin_of_samples(samples_of(whole), DuplicatePolicy::First);
            if (has_faces(tin)) {
                check_against_oracle(whole, tin);
            }
        }
    }

    TEST_CASE("threads and bands do not change a byte") {
        for (std::uint64_t seed = 1; seed <= cases(20); ++seed) {
            CAPTURE(seed);
            std::mt19937_64 random(seed);
            const WholeCase whole = make_case(seed % 2 == 0 ? Family::Lattice : Family::Random, random);
            Tin tin = tin_of_samples(samples_of(whole), DuplicatePolicy::First);
            for (std::uint32_t f = 0; f < tin.mesh.slot_count(); f += 5) {
                tin.mesh.set_terrain({f}, false);
            }
            check_same_bytes(tin, grid_of(whole));
        }
    }

    TEST_CASE("centres on decimal samples get the samples' elevations, hull included") {
        // Cell centres at 1000.2, 1000.4, ...: sums that no double holds.
        std::vector<Point3> samples;
        for (int i = 0; i < 25; ++i) {
            for (int j = 0; j < 20; ++j) {
                samples.push_back({decimal(10002 + 2 * i, 1), decimal(50002 + 2 * j, 1), i * 3.25 - j * j});
            }
        }
        const Tin tin = tin_of_samples(samples, DuplicatePolicy::First);
        const GridGeometry grid{1000.1, 5004.1, 0.2, 0.2, 25, 20};
        const Raster<double> raster = rasterise<double>(tin, grid, 4, 2);
        CHECK(raster.cells == 500);
        for (int i = 0; i < 25; ++i) {
            for (int j = 0; j < 20; ++j) {
                const double value = raster.values[static_cast<std::size_t>((19 - j) * 25 + i)];
                const bool is_on_hull = i == 0 || j == 0 || i == 24 || j == 19;
                if (is_on_hull) {
                    CHECK(value == i * 3.25 - j * j);
                } else {
                    CHECK(value == doctest::Approx(i * 3.25 - j * j).epsilon(1e-13));
                }
            }
        }
    }

    TEST_CASE("a plane is reproduced, also where centres are not decimal numbers") {
        for (std::uint64_t seed = 1; seed <= cases(10); ++seed) {
            CAPTURE(seed);
            std::mt19937_64 random(seed);
            std::uniform_real_distribution<double> uniform(0, 10);
            std::vector<Point3> samples{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}};
            while (samples.size() < 200) {
                samples.push_back({uniform(random), uniform(random), 0});
            }
            const double scale = seed % 2 == 0 ? 1 : 1.0 / 3;
            for (Point3& sample : samples) {
                sample.x = 300000 + sample.x * scale;
                sample.y = 5000000 + sample.y * scale;
                sample.z = 3 + 0.5 * (sample.x - 300000) - 0.25 * (sample.y - 5000000);
            }
            const Tin tin = tin_of_samples(samples, DuplicatePolicy::First);
            const GridGeometry grid{300000, 5000000 + 10 * scale, 10 * scale / 77, 10 * scale / 91, 77, 91};
            const Raster<double> raster = rasterise<double>(tin, grid, 10, 2);
            CHECK(raster.cells == 77 * 91);
            for (std::int64_t row = 0; row < 91; ++row) {
                for (std::int64_t column = 0; column < 77; ++column) {
                    const Point2 at = grid.centre(column, row);
                    const double value = raster.values[static_cast<std::size_t>(row * 77 + column)];
                    const double plane = 3 + 0.5 * (at.x - 300000) - 0.25 * (at.y - 5000000);
                    CHECK(std::abs(value - plane) < 1e-8);
                }
            }
        }
    }

    TEST_CASE("a raster far from the surface holds no value, and one finer than the lattice is filled") {
        const Tin tin = tin_of_samples({{0, 0, 1}, {4, 0, 2}, {0, 4, 3}, {4, 4, 4}}, DuplicatePolicy::First);
        CHECK(rasterise<float>(tin, {1e9, 1e9, 0.1, 0.1, 50, 50}, 8, 2).cells == 0);
        CHECK(rasterise<float>(tin, {-1e18, 3, 1, 1, 50, 50}, 8, 2).cells == 0);
        CHECK(rasterise<float>(tin, {1, 1 + 50e-14, 1e-14, 1e-14, 50, 50}, 8, 2).cells == 2500);
        CHECK(rasterise<float>(tin, {-1e17, 1e17, 2e17, 2e17, 1, 1}, 8, 2).cells == 1);
    }

    TEST_CASE("elevations near the end of the range stay within their face's") {
        const Tin tin =
            tin_of_samples({{0, 0, 1e308}, {4, 0, -1e308}, {0, 4, 1e308}}, DuplicatePolicy::First);
        const Raster<double> raster = rasterise<double>(tin, {0, 4, 0.5, 0.5, 8, 8}, 8, 1);
        CHECK(raster.cells == 36);
        for (const double value : raster.values) {
            CHECK((value == kNodata || std::abs(value) <= 1e308));
        }
    }
}
