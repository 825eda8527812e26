#include "invented_terrain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace invented {
namespace {

constexpr Position kLakeCentre{360, 372};
constexpr Position kAreaCentre{600, 400};

std::uint64_t mix(std::uint64_t v) {
    v = (v ^ (v >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    v = (v ^ (v >> 27U)) * 0x94D049BB133111EBULL;
    return v ^ (v >> 31U);
}

double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

double ease(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * t * (t * (6 * t - 15) + 10);
}

double lattice_value(double column, double row, std::uint64_t seed) {
    const auto c = static_cast<std::uint64_t>(static_cast<std::int64_t>(column) + 4096);
    const auto r = static_cast<std::uint64_t>(static_cast<std::int64_t>(row) + 4096);
    return 2 * unit(mix(seed * 0x9E3779B97F4A7C15ULL + (c << 32U) + r)) - 1;
}

/// Smooth noise in [-1, 1] with features of size 1.
double noise(double x, double y, std::uint64_t seed) {
    const double column = std::floor(x);
    const double row = std::floor(y);
    const double s = ease(x - column);
    const double t = ease(y - row);
    const double south =
        lattice_value(column, row, seed) * (1 - s) + lattice_value(column + 1, row, seed) * s;
    const double north =
        lattice_value(column, row + 1, seed) * (1 - s) + lattice_value(column + 1, row + 1, seed) * s;
    return south * (1 - t) + north * t;
}

/// Noise with detail at every scale, features from `size` downward.
double fractal_noise(Position p, double size, int octaves, std::uint64_t seed) {
    double sum = 0;
    double amplitude = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        // A turn by the 3-4-5 angle between octaves hides the grid.
        sum += amplitude * noise(p.x / size, p.y / size, seed + static_cast<std::uint64_t>(octave));
        p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y};
        size /= 2;
        amplitude /= 2;
    }
    return sum;
}

/// Distance to the middle of the stream, with its sign: positive on the north side.
double across_stream(Position p) {
    const double rise = (stream(p.x + 1).y - stream(p.x - 1).y) / 2;
    return (p.y - stream(p.x).y) / std::sqrt(1 + rise * rise);
}

double stream_bed(double x) {
    const double above_lake = std::max(0.0, 230 - x) * 0.016;
    const double below_lake = std::max(0.0, x - 500) * 0.009;
    return kLakeLevel - 0.5 + above_lake - below_lake;
}

/// Floor, sides and gullies of the valley, and the bed cut into it.
double valley(Position p) {
    const double across = across_stream(p);
    const double away = std::abs(across);
    const double side = across > 0 ? 34 : 24;
    const double t = away / (across > 0 ? 270 : 230);
    const double rise = side * t * t / (1 + t * t);
    const double wild = ease((away - 25) / 180);
    const double wandering = p.x + 75 * noise(p.x / 240, across / 110, 12) + 0.25 * away;
    const double nearness = 1 - 3.2 * std::abs(noise(wandering / 150, across / 700, 11));
    const double gullies = -6 * wild * ease(nearness);
    const double relief = (0.6 + 4 * wild) * fractal_noise(p, 260, 4, 23);
    const double floor = stream_bed(p.x) + 1.7 + 0.012 * away;
    const double land = floor + rise + gullies * ease(away / 120) + relief * ease((away - 4) / 60);
    const double bed = stream_bed(p.x) + 1.7 * ease((away - 1.2) / (kBankDistance - 1.2));
    return away < kBankDistance ? std::min(land, bed) : land;
}

/// Distance from the centre over the distance of the outline in the same direction.
double lake_ratio(Position p) {
    const double dx = (p.x - kLakeCentre.x) / 1.75;
    const double dy = p.y - kLakeCentre.y;
    const double r = std::sqrt(dx * dx + dy * dy) + 1e-9;
    return r / (56 * (1 + 0.5 * noise(0.9 * dx / r + 5.4, 0.9 * dy / r + 5.3, 38)));
}

double survey_ratio(Position p) {
    const double dx = (p.x - kAreaCentre.x) / (kWidth / 2);
    const double dy = (p.y - kAreaCentre.y) / (kHeight / 2);
    const double r4 = dx * dx * dx * dx + dy * dy * dy * dy;
    const double r = std::sqrt(std::sqrt(r4)) + 1e-9;
    return r / (0.93 + 0.07 * noise(2.2 * dx / r + 9, 2.2 * dy / r + 9, 47));
}

/// The curve on which `ratio` is 1, found by bisection along rays from the centre.
template <class Ratio>
std::vector<Position> outline(Position centre, double reach, int vertices, Ratio ratio) {
    std::vector<Position> ring;
    for (int i = 0; i < vertices; ++i) {
        // Rays through points evenly spread on a square: no sine, no cosine.
        const double s = 8.0 * i / vertices;
        const double along = s - 2 * std::floor(s / 2) - 1;
        const auto edge = static_cast<std::size_t>(s / 2);
        const std::array<Position, 4> on_square{{{1, along}, {-along, 1}, {-1, -along}, {along, -1}}};
        double inside = 0;
        double outside = reach;
        for (int step = 0; step < 48; ++step) {
            const double middle = (inside + outside) / 2;
            const Position p{centre.x + middle * on_square[edge].x, centre.y + middle * on_square[edge].y};
            (ratio(p) < 1 ? inside : outside) = middle;
        }
        ring.push_back({centre.x + inside * on_square[edge].x, centre.y + inside * on_square[edge].y});
    }
    return ring;
}

}  // namespace

double Random::uniform(double low, double high) {
    state_ += 0x9E3779B97F4A7C15ULL;
    return low + (high - low) * unit(mix(state_));
}

Position stream(double x) {
    // The bends die down in the lake and under the road.
    const double bends = 62 * noise(x / 150, 0.5, 3) + 17 * noise(x / 62, 0.5, 4);
    const double calm_at_lake = ease(std::abs(x - kLakeCentre.x) / 150);
    const double calm_at_road = 0.3 + 0.7 * ease(std::abs(x - 760) / 90);
    return {x, 372 + bends * calm_at_lake * calm_at_road};
}

Position road(double y) {
    const double t = (y - 380) / 400;
    return {760 + 95 * t - 70 * t * t * t, y};
}

double road_elevation(double y) {
    const double t = (y - 350) / 400;
    return 432.6 + 15 * t * t / (1 + 0.35 * t * t);
}

Position road_right(double y) {
    const double dx = (road(y + 0.5).x - road(y - 0.5).x);
    const double length = std::sqrt(1 + dx * dx);
    return {1 / length, -dx / length};
}

double distance_to_road(Position p) {
    const Position right = road_right(p.y);
    return std::abs((p.x - road(p.y).x) * right.x);
}

double natural_elevation(Position p) {
    const double ratio = lake_ratio(p);
    const double land = valley(p);
    if (ratio >= 2.2) {
        return land;
    }
    if (ratio <= 1) {
        return kLakeLevel;
    }
    // The shore rises from the water and meets the valley; below the outlet the bed may lie deeper.
    const double beach = kLakeLevel + 0.15 * ease((ratio - 1) / 0.2);
    const double share = ease((ratio - 1) / 1.2);
    return beach + (land - beach) * share;
}

double elevation(Position p) {
    const double ground = natural_elevation(p);
    const double away = distance_to_road(p);
    if (away > 80) {
        return ground;
    }
    const double crown = road_elevation(p.y) - 0.025 * std::min(away, kRoadHalfWidth);
    const double slope = std::max(0.0, away - kRoadHalfWidth) / 1.6;
    return std::min(std::max(ground, crown - slope), crown + slope);
}

bool is_in_lake(Position p) { return lake_ratio(p) < 1; }

std::vector<Position> lake_shore(int vertices) { return outline(kLakeCentre, 400, vertices, lake_ratio); }

bool is_in_survey_area(Position p) { return survey_ratio(p) < 1; }

std::vector<Position> survey_outline(int vertices) {
    return outline(kAreaCentre, 900, vertices, survey_ratio);
}

}  // namespace invented
