#include "benchmarks/terrain_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <utility>

#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

using tinwright::Point3;
using tinwright_tests::Random;

namespace {

constexpr double kSpacing = 4;
constexpr double kLongest = 2048;  // wavelength, metres
constexpr double kHighest = 250;   // amplitude at that wavelength, metres
constexpr double kRoughness = 0.8;

double to_centimetres(double value) { return std::round(value * 100) / 100; }

/// -1 to 1, one number a corner of the noise's grid.
double noise_at(std::int64_t i, std::int64_t j, std::uint64_t octave) {
    const auto mixed = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U +
                       static_cast<std::uint64_t>(j) * 0xC2B2AE3D27D4EB4FU + octave * 0x165667B19E3779F9U;
    return 2 * Random(mixed).real() - 1;
}

/// Smooth between the corners, which have the distance 1.
double noise(double x, double y, std::uint64_t octave) {
    const double column = std::floor(x);
    const double row = std::floor(y);
    const auto ease = [](double t) { return t * t * (3 - 2 * t); };
    const double u = ease(x - column);
    const double v = ease(y - row);
    const auto i = static_cast<std::int64_t>(column);
    const auto j = static_cast<std::int64_t>(row);
    const double low = std::lerp(noise_at(i, j, octave), noise_at(i + 1, j, octave), u);
    const double high = std::lerp(noise_at(i, j + 1, octave), noise_at(i + 1, j + 1, octave), u);
    return std::lerp(low, high, v);
}

double fractal_elevation(double x, double y) {
    double z = 0;
    double amplitude = kHighest;
    std::uint64_t octave = 1;
    for (double wavelength = kLongest; wavelength >= kSpacing; wavelength /= 2) {
        z += amplitude * noise(x / wavelength, y / wavelength, octave++);
        amplitude *= std::pow(0.5, kRoughness);
    }
    return z;
}

/// Random places, `kSpacing` apart on average, to the centimetre.
Points random_places(std::uint64_t seed, std::size_t count) {
    Random random(seed);
    const double steps = std::round(100 * kSpacing * std::sqrt(static_cast<double>(count)));
    Points points(count);
    for (Point3& p : points) {
        p.x = random.key(steps) / 100;
        p.y = random.key(steps) / 100;
    }
    return points;
}

/// The same place may be drawn twice: then the terrain is the same as well.
template <class Elevation>
Points on_terrain(Points points, Elevation elevation) {
    for (Point3& p : points) {
        p.z = to_centimetres(elevation(p.x, p.y));
    }
    return points;
}

/// Whole positions (x, y) of `place(i)`, z random; places that fall on one are told apart by their z, so
/// repetitions are dropped.
template <class Place>
Points on_curve(std::uint64_t seed, std::size_t count, Place place) {
    Random random(seed);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        const tinwright::Point2 at = place(i);
        points.push_back({std::round(at.x), std::round(at.y), to_centimetres(100 * random.real())});
    }
    std::sort(points.begin(), points.end(),
              [](const Point3& a, const Point3& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end(),
                             [](const Point3& a, const Point3& b) { return a.x == b.x && a.y == b.y; }),
                 points.end());
    return points;
}

}  // namespace

Points noisy_points(std::size_t count) {
    Random random(11);
    Points points = uniform_points(count);
    for (Point3& p : points) {
        p.z = to_centimetres(p.z + 0.12 * random.real() - 0.06);
    }
    return points;
}

Points fractal_points(std::size_t count) { return on_terrain(random_places(12, count), fractal_elevation); }

Points circle_points(std::size_t count) {
    return on_curve(13, count, [count](std::size_t i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        constexpr double kRadius = 1e9;
        return tinwright::Point2{kRadius * (1 + std::cos(angle)), kRadius * (1 + std::sin(angle))};
    });
}

Points convex_points(std::size_t count) {
    return on_curve(14, count, [count](std::size_t i) {
        const double part = static_cast<double>(i) / static_cast<double>(count);
        const double angle = 2 * std::numbers::pi * part;
        const double radius = 1e9 * std::exp(0.5 * part);
        return tinwright::Point2{2e9 + radius * std::cos(angle), 2e9 + radius * std::sin(angle)};
    });
}

Points cliff_points(std::size_t count) {
    const double middle = kSpacing * std::sqrt(static_cast<double>(count)) / 2;
    return on_terrain(random_places(15, count), [middle](double x, double y) {
        return x > middle + 40 * std::sin(y / 100) ? 50.0 : 0.0;
    });
}

Points sea_points(std::size_t count) {
    Points points = on_terrain(random_places(16, count), fractal_elevation);
    std::vector<double> levels;
    levels.reserve(points.size());
    std::transform(points.begin(), points.end(), std::back_inserter(levels),
                   [](const Point3& p) { return p.z; });
    const auto at = levels.begin() + static_cast<std::ptrdiff_t>(2 * levels.size() / 3);
    std::nth_element(levels.begin(), at, levels.end());
    const double sea = *at;
    for (Point3& p : points) {
        p.z = std::max(0.0, to_centimetres(p.z - sea));
    }
    return points;
}

Points facing_points(std::size_t count) {
    constexpr double kLength = 1e7;
    constexpr double kDistance = 1e6;
    Random random(18);
    const double spacing = 2 * kLength / static_cast<double>(count);
    Points points = on_curve(17, count, [&random, spacing](std::size_t i) {
        // Spacings that vary, or everything ties.
        const double along = static_cast<double>(i / 2) + 0.3 * random.real();
        return tinwright::Point2{spacing * along, i % 2 == 0 ? 0 : kDistance};
    });
    for (Point3& p : points) {
        p.z += kDistance * std::sin(2 * std::numbers::pi * p.x / kLength + (p.y == 0 ? 0 : 2));
    }
    return points;
}

Points arc_points(std::size_t count) {
    Random random(19);
    const double step = 2 * std::numbers::pi / static_cast<double>(count / 2);
    return on_curve(19, count, [&random, step](std::size_t i) {
        const double angle = step * (static_cast<double>(i / 2) + 0.3 * random.real());
        const double radius = i % 2 == 0 ? 1e9 : 0.75e9 - 0.04e9 * angle;
        return tinwright::Point2{1e9 + radius * std::cos(angle), 1e9 + radius * std::sin(angle)};
    });
}

Points cluster_points(std::size_t count) {
    constexpr std::size_t kSize = 1000;
    Random random(20);
    const double side = 100 * std::sqrt(static_cast<double>(count));
    Points points;
    points.reserve(count);
    tinwright::Point2 centre{};
    for (std::size_t i = 0; i < count; ++i) {
        if (i % kSize == 0) {
            centre = {side * random.real(), side * random.real()};
        }
        const double angle = 2 * std::numbers::pi * random.real();
        const double reach = 400 * std::pow(random.real(), 2);
        points.push_back({to_centimetres(side + centre.x + reach * std::cos(angle)),
                          to_centimetres(side + centre.y + reach * std::sin(angle)), 0});
    }
    return on_terrain(std::move(points), fractal_elevation);
}

Points square_points(std::size_t count) {
    return grid_points(static_cast<int>(std::lround(std::sqrt(static_cast<double>(count)))), false);
}

}  // namespace tinwright_benchmarks
