#include "support/point_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

namespace tinwright_tests {

using tinwright::Key2;
using tinwright::Point3;

std::uint64_t Random::next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

std::int64_t Random::integer(std::int64_t low, std::int64_t high) {
    const auto width = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<std::int64_t>(width == 0 ? next() : next() % width);
}

double Random::key(double limit) {
    return static_cast<double>(integer(0, static_cast<std::int64_t>(limit) - 1));
}

double Random::real() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

namespace {

using Keys = std::vector<Key2>;

template <class MakeKey>
Keys repeat(std::size_t count, const MakeKey& make_key) {
    Keys keys(count);
    std::generate(keys.begin(), keys.end(), make_key);
    return keys;
}

template <int kBits>
Keys uniform(Random& random, std::size_t count) {
    const double limit = std::ldexp(1.0, kBits);
    return repeat(count, [&] { return Key2{random.key(limit), random.key(limit)}; });
}

Keys grid(Random& random, std::size_t count) {
    const int columns = static_cast<int>(random.integer(1, 2 * static_cast<int>(std::sqrt(count)) + 1));
    Keys keys = grid_keys(columns, static_cast<int>(count) / columns + 1);
    keys.resize(std::min(keys.size(), count));
    return keys;
}

Keys sparse_grid(Random& random, std::size_t count) {
    const double columns = std::ceil(std::sqrt(2.0 * static_cast<double>(count)));
    return repeat(count, [&] { return Key2{4096 * random.key(columns), 4096 * random.key(columns)}; });
}

Keys jittered_grid(Random& random, std::size_t count) {
    Keys keys = grid(random, count);
    for (Key2& key : keys) {
        key = {1000 * key.x + random.key(3), 1000 * key.y + random.key(3)};
    }
    return keys;
}

Keys scan_rows(Random& random, std::size_t count) {
    const double row_length = std::ceil(std::sqrt(static_cast<double>(count)));
    Keys keys;
    for (double row = 0; keys.size() < count; ++row) {
        double along = random.key(100);
        for (double i = 0; i < row_length && keys.size() < count; ++i) {
            along += static_cast<double>(random.integer(30, 90));
            keys.push_back({along, 100 * row + random.key(2)});
        }
    }
    return keys;
}

/// On one straight line, or within one key of it.
template <int kOff>
Keys line(Random& random, std::size_t count) {
    const double dx = random.key(1000);
    const double dy = 1 + random.key(1000);
    return repeat(count, [&] {
        const double t = random.key(1 << 20);
        return Key2{1 + t * dx + static_cast<double>(random.integer(-kOff, kOff)),
                    1 + t * dy + static_cast<double>(random.integer(-kOff, kOff))};
    });
}

/// On a few rows and columns.
Keys crossing_rows(Random& random, std::size_t count) {
    return repeat(count, [&] {
        const double fixed = 7 * random.key(3);
        const double free = random.key(4096);
        return random.integer(0, 1) == 0 ? Key2{fixed, free} : Key2{free, fixed};
    });
}

Keys co_circular(Random& random, std::size_t count) {
    Keys keys = circle_keys(random, count);
    if (random.integer(0, 1) == 0) {
        keys.push_back({40000, 40000});
    }
    return keys;
}

Keys rings(Random& random, std::size_t count) {
    Keys keys = circle_keys(random, count / 2);
    for (Key2& key : keys) {
        key = {2 * key.x, 2 * key.y};  // around (80000, 80000)
    }
    for (const Key2 key : circle_keys(random, count - count / 2)) {
        keys.push_back({key.x + 40000, key.y + 40000});
    }
    return keys;
}

/// Rounded to the lattice: within one key of the circle.
template <int kBits>
Keys near_circle(Random& random, std::size_t count) {
    const double radius = std::ldexp(1.0, kBits);
    return repeat(count, [&] {
        const double angle = 2 * std::numbers::pi * random.real();
        return Key2{std::round(radius + 2 + radius * std::cos(angle)),
                    std::round(radius + 2 + radius * std::sin(angle))};
    });
}

Keys clusters(Random& random, std::size_t count) {
    const std::array<double, 3> centers{0x1p43, 0x1p43 + 0x1p30, 0x1p40};
    return repeat(count, [&] {
        const double size = std::ldexp(1.0, static_cast<int>(random.integer(0, 40)));
        const double x = centers[static_cast<std::size_t>(random.integer(0, 2))];
        const double y = centers[static_cast<std::size_t>(random.integer(0, 2))];
        return Key2{x + std::floor(size * (random.real() - 0.5)),
                    y + std::floor(size * (random.real() - 0.5))};
    });
}

Keys facing_lines(Random& random, std::size_t count) {
    return repeat(count, [&] {
        const double t = random.key(100000);
        return random.integer(0, 1) == 0 ? Key2{t, 0} : Key2{50000, 30 + t};
    });
}

Keys parabola(Random& random, std::size_t count) {
    return repeat(count, [&] {
        const double t = random.key(4.0 * static_cast<double>(count));
        return Key2{t, t * t};
    });
}

/// A dense square with a few far outliers: needles on the hull.
Keys outliers(Random& random, std::size_t count) {
    return repeat(count, [&] {
        return random.integer(0, 49) == 0 ? Key2{random.key(0x1p44), random.key(0x1p44)}
                                          : Key2{0x1p43 + random.key(1024), 0x1p43 + random.key(1024)};
    });
}

constexpr std::array kFamilies{
    KeyFamily{"uniform, 2^3", uniform<3>},
    KeyFamily{"uniform, 2^7", uniform<7>},
    KeyFamily{"uniform, 2^20", uniform<20>},
    KeyFamily{"uniform, 2^26", uniform<26>},
    KeyFamily{"uniform, 2^30", uniform<30>},
    KeyFamily{"uniform, 2^45", uniform<45>},
    KeyFamily{"grid", grid},
    KeyFamily{"sparse grid", sparse_grid},
    KeyFamily{"jittered grid", jittered_grid},
    KeyFamily{"scan rows", scan_rows},
    KeyFamily{"line", line<0>},
    KeyFamily{"within a key of a line", line<1>},
    KeyFamily{"crossing rows", crossing_rows},
    KeyFamily{"on a circle", co_circular},
    KeyFamily{"concentric circles", rings},
    KeyFamily{"within a key of a circle, 2^12", near_circle<12>},
    KeyFamily{"within a key of a circle, 2^28", near_circle<28>},
    KeyFamily{"within a key of a circle, 2^43", near_circle<43>},
    KeyFamily{"clusters over decades", clusters},
    KeyFamily{"facing lines", facing_lines},
    KeyFamily{"parabola", parabola},
    KeyFamily{"outliers", outliers},
};

double nearest_decimal(std::int64_t steps, int decimals) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%llde-%d", static_cast<long long>(steps), decimals);
    return std::strtod(text.data(), nullptr);
}

}  // namespace

std::span<const KeyFamily> key_families() { return kFamilies; }

std::vector<Key2> without_repetitions(std::vector<Key2> keys) {
    std::sort(keys.begin(), keys.end(),
              [](Key2 a, Key2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

std::vector<Key2> grid_keys(int columns, int rows) {
    Keys keys;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            keys.push_back({static_cast<double>(column), static_cast<double>(row)});
        }
    }
    return keys;
}

std::vector<Key2> circle_keys(Random& random, std::size_t count) {
    // 32045 = 5 * 13 * 17 * 29, primes that are sums of two squares.
    constexpr std::int64_t kRadius = 32045;
    static const Keys all = [] {
        Keys keys;
        for (std::int64_t x = -kRadius; x <= kRadius; ++x) {
            const std::int64_t square = kRadius * kRadius - x * x;
            const auto y = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(square))));
            if (y * y == square) {
                keys.push_back({40000.0 + static_cast<double>(x), 40000.0 + static_cast<double>(y)});
                if (y != 0) {
                    keys.push_back({40000.0 + static_cast<double>(x), 40000.0 - static_cast<double>(y)});
                }
            }
        }
        return keys;
    }();
    Keys keys = shuffled(random, all);
    keys.resize(std::min(keys.size(), count));
    return keys;
}

std::vector<Point3> decimal_samples(Random& random, std::size_t count, int decimals, double x, double y,
                                    double extent) {
    const double power = std::pow(10.0, decimals);
    const auto low = [&](double v) { return static_cast<std::int64_t>(std::llround(v * power)); };
    std::vector<Point3> samples(count);
    for (Point3& sample : samples) {
        const auto steps = low(extent);
        sample = {nearest_decimal(low(x) + random.integer(0, steps), decimals),
                  nearest_decimal(low(y) + random.integer(0, steps), decimals),
                  nearest_decimal(random.integer(0, 100000), 2)};
    }
    return samples;
}

std::vector<Point3> scan_samples(Random& random, std::size_t count) {
    std::vector<Point3> samples;
    for (const Key2 key : scan_rows(random, count)) {
        samples.push_back({nearest_decimal(32345678 + static_cast<std::int64_t>(key.x), 2),
                           nearest_decimal(512345678 + static_cast<std::int64_t>(key.y), 2),
                           nearest_decimal(random.integer(10000, 20000), 2)});
    }
    return samples;
}

}  // namespace tinwright_tests
