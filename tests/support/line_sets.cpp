#include "support/line_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tinwright_tests {

using tinwright::Breakline;
using tinwright::LineRole;
using tinwright::Point3;

double plane_z(double x, double y) { return 200 + (x - 500000) / 8 - (y - 4000000) / 32; }

Point3 survey_point(std::int64_t x, std::int64_t y) {
    // One division of whole numbers gives the double nearest to the decimal, of the plane too.
    const double east = static_cast<double>(50000000 + x) / 100;
    const double north = static_cast<double>(400000000 + y) / 100;
    return {east, north, static_cast<double>(640000 + 4 * x - y) / 3200};
}

std::vector<Breakline> shuffled_and_reversed(Random& random, std::vector<Breakline> lines) {
    lines = shuffled(random, std::move(lines));
    for (Breakline& line : lines) {
        if (random.integer(0, 1) == 0) {
            std::reverse(line.points.begin(), line.points.end());
        }
    }
    return lines;
}

namespace {

constexpr std::int64_t kWide = 100000;  // a kilometre in centimetres

struct Step {
    std::int64_t x;
    std::int64_t y;
};

Breakline line_through(const std::vector<Step>& steps) {
    Breakline line;
    for (const Step step : steps) {
        line.points.push_back(survey_point(step.x, step.y));
    }
    return line;
}

Breakline ring_through(std::vector<Step> steps, LineRole role = LineRole::Breakline,
                       std::uint32_t polygon = 0) {
    steps.push_back(steps.front());
    Breakline line = line_through(steps);
    line.role = role;
    line.polygon = polygon;
    return line;
}

Breakline box_ring(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height,
                   LineRole role = LineRole::Breakline, std::uint32_t polygon = 0) {
    return ring_through({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, role, polygon);
}

std::int64_t whole(double value) { return std::llround(value); }

Step anywhere(Random& random, std::int64_t wide = kWide) {
    return {random.integer(0, wide), random.integer(0, wide)};
}

Step near(Random& random, Step step, std::int64_t reach) {
    return {step.x + random.integer(-reach, reach), step.y + random.integer(-reach, reach)};
}

/// Lines of about `length` segments each, every step within `reach` of the one before.
std::vector<Breakline> wander(Random& random, std::size_t size, std::size_t length, std::int64_t wide,
                              std::int64_t reach) {
    std::vector<Breakline> lines;
    for (std::size_t made = 0; made < size; made += length) {
        std::vector<Step> steps{anywhere(random, wide)};
        while (steps.size() <= length) {
            steps.push_back(near(random, steps.back(), reach));
        }
        lines.push_back(line_through(steps));
    }
    return lines;
}

LineSet long_segments(Random& random, std::size_t size) {
    return {wander(random, size, 1, kWide, kWide), {}};
}

LineSet short_segments(Random& random, std::size_t size) {
    const double reach = 2.0 * static_cast<double>(kWide) / std::sqrt(static_cast<double>(size));
    return {wander(random, size, 1, kWide, whole(reach)), {}};
}

LineSet long_among_short(Random& random, std::size_t size) {
    LineSet set = short_segments(random, size);
    for (const Breakline& line : wander(random, size / 10 + 1, 1, kWide, kWide)) {
        set.lines.push_back(line);
    }
    return set;
}

/// Few lattice points for many segments: every degeneracy there is.
LineSet tiny_lattice(Random& random, std::size_t size) {
    const std::int64_t wide = random.integer(2, 12);
    return {wander(random, size, static_cast<std::size_t>(random.integer(1, 5)), wide, wide), {}};
}

LineSet walks(Random& random, std::size_t size) {
    return {wander(random, size, std::min<std::size_t>(size, 20), kWide, kWide / 10), {}};
}

/// One unit apart; every fourth turned about, every eighth crossing the rest at a small angle.
LineSet parallel_lines(Random& random, std::size_t size) {
    LineSet set;
    const std::int64_t dx = random.integer(1, 40) * 1000;
    const std::int64_t dy = random.integer(0, 40) * 1000;
    for (std::size_t i = 0; i < size; ++i) {
        const auto off = static_cast<std::int64_t>(i);
        std::vector<Step> steps{{0, off}, {dx, dy + off}};
        if (i % 8 == 7) {
            steps[1].y -= random.integer(1, 9);
        }
        if (i % 4 == 3) {
            std::swap(steps[0], steps[1]);
        }
        set.lines.push_back(line_through(steps));
    }
    return set;
}

LineSet star(Random& random, std::size_t size) {
    LineSet set;
    for (std::size_t i = 0; i < size; ++i) {
        const Step tip = near(random, {0, 0}, kWide);
        set.lines.push_back(i % 3 == 0   ? line_through({{0, 0}, tip})
                            : i % 3 == 1 ? line_through({tip, {0, 0}})
                                         : line_through({{-tip.x, -tip.y}, {0, 0}, tip}));
    }
    return set;
}

/// Through one point that is no line's point, or within a unit of it.
LineSet hub(Random& random, std::size_t size) {
    LineSet set;
    for (std::size_t i = 0; i < size; ++i) {
        const Step tip = near(random, {0, 0}, kWide);
        const Step off = near(random, {0, 0}, i % 4 == 0 ? 1 : 0);
        set.lines.push_back(line_through({{off.x - tip.x, off.y - tip.y}, {off.x + tip.x, off.y + tip.y}}));
    }
    return set;
}

LineSet even_fan(Random& random, std::size_t size) {
    constexpr std::array kAngles{0.01, 0.2, 1.0, 5.0};
    return {fan(size, kAngles[static_cast<std::size_t>(random.integer(0, 3))], 1000), {}};
}

/// To and fro at less than a degree.
LineSet sharp_angles(Random& random, std::size_t size) {
    std::vector<Step> steps{{0, 0}};
    for (std::size_t i = 0; i < size; ++i) {
        const std::int64_t reach = random.integer(kWide / 2, kWide);
        steps.push_back({i % 2 == 0 ? reach : -reach, steps.back().y + random.integer(1, 1 + reach / 200)});
    }
    return {{line_through(steps)}, {}};
}

LineSet figure_6_1(Random& /*random*/, std::size_t size) { return close_parallel_edges(size, size / 2 + 1); }

LineSet spirals(Random& /*random*/, std::size_t size) {
    LineSet set;
    for (const double turn : {0.0, std::numbers::pi}) {
        std::vector<Step> steps;
        for (std::size_t i = 0; i <= size / 2; ++i) {
            const double angle = 0.3 * static_cast<double>(i);
            steps.push_back(
                {whole(40 * angle * std::cos(angle + turn)), whole(40 * angle * std::sin(angle + turn))});
        }
        set.lines.push_back(line_through(steps));
    }
    return set;
}

/// Wobbly rings inside each other, so close that rounding makes some of them touch.
LineSet contour_bundle(Random& random, std::size_t size) {
    constexpr std::size_t kCorners = 40;
    LineSet set;
    std::array<double, kCorners> wobble{};
    for (double& part : wobble) {
        part = 1 + 0.2 * random.real();
    }
    for (std::size_t ring = 0; ring < size / kCorners + 1; ++ring) {
        std::vector<Step> steps;
        const double radius = 3000 + static_cast<double>(ring);
        for (std::size_t i = 0; i < kCorners; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kCorners;
            steps.push_back(
                {whole(radius * wobble[i] * std::cos(angle)), whole(radius * wobble[i] * std::sin(angle))});
        }
        set.lines.push_back(ring_through(steps));
    }
    return set;
}

LineSet every_line_twice(Random& random, std::size_t size) {
    LineSet set = walks(random, size / 2 + 1);
    for (std::size_t i = set.lines.size(); i-- > 0;) {
        Breakline again = set.lines[i];
        if (random.integer(0, 1) == 0) {
            std::reverse(again.points.begin(), again.points.end());
        }
        set.lines.push_back(std::move(again));
    }
    return set;
}

LineSet shifted_by_a_unit(Random& random, std::size_t size) {
    LineSet set;
    for (std::size_t made = 0; made < size; made += 20) {
        std::vector<Step> steps{anywhere(random)};
        while (steps.size() <= 10) {
            steps.push_back(near(random, steps.back(), kWide / 10));
        }
        set.lines.push_back(line_through(steps));
        const Step by = near(random, {0, 0}, 1);
        for (Step& step : steps) {
            step = {step.x + by.x, step.y + by.y};
        }
        set.lines.push_back(line_through(steps));
    }
    return set;
}

/// Stretches of a few straight lines.
LineSet collinear_overlaps(Random& random, std::size_t size) {
    LineSet set;
    for (std::size_t i = 0; i < size; ++i) {
        constexpr std::array<Step, 5> kWays{{{1, 0}, {0, 1}, {3, 1}, {1, 1}, {-7, 3}}};
        const Step way = kWays[static_cast<std::size_t>(random.integer(0, 4))];
        const std::int64_t from = random.integer(0, 200);
        const std::int64_t to = from + random.integer(-60, 60);
        set.lines.push_back(
            line_through({{100 * from * way.x, 100 * from * way.y}, {100 * to * way.x, 100 * to * way.y}}));
    }
    return set;
}

/// Squares and diamonds that touch with corners on corners and corners on sides.
LineSet touching_rings(Random& random, std::size_t size) {
    LineSet set;
    for (std::size_t i = 0; i < size / 4 + 1; ++i) {
        const Step at{1000 * random.integer(0, 9), 1000 * random.integer(0, 9)};
        const std::int64_t reach = 500 * random.integer(1, 2);
        if (random.integer(0, 1) == 0) {
            set.lines.push_back(box_ring(at.x - reach, at.y - reach, 2 * reach, 2 * reach));
        } else {
            set.lines.push_back(ring_through(
                {{at.x - reach, at.y}, {at.x, at.y - reach}, {at.x + reach, at.y}, {at.x, at.y + reach}}));
        }
    }
    return set;
}

LineSet through_grid_points(Random& random, std::size_t size) {
    LineSet set;
    for (std::int64_t row = 0; row <= 20; ++row) {
        for (std::int64_t column = 0; column <= 20; ++column) {
            set.samples.push_back(survey_point(100 * column, 100 * row));
        }
    }
    for (std::size_t i = 0; i < size; ++i) {
        const Step from = anywhere(random, 20);
        const Step to = anywhere(random, 20);
        set.lines.push_back(line_through({{100 * from.x, 100 * from.y}, {100 * to.x, 100 * to.y}}));
    }
    return set;
}

/// A coverage of parcels: neighbours share their sides.
LineSet parcels(Random& /*random*/, std::size_t size) {
    LineSet set;
    const auto side = static_cast<std::int64_t>(std::ceil(std::sqrt(static_cast<double>(size) / 4)));
    std::uint32_t polygon = 0;
    for (std::int64_t row = 0; row < side; ++row) {
        for (std::int64_t column = 0; column < side; ++column) {
            set.lines.push_back(
                box_ring(2000 * column, 1500 * row, 2000, 1500, LineRole::Boundary, polygon++));
        }
    }
    return set;
}

/// A boundary with an island in a hole, a hole that touches the boundary, breaklines across both.
LineSet boundary_and_holes(Random& random, std::size_t size) {
    LineSet set;
    set.lines = {box_ring(0, 0, 40000, 30000, LineRole::Boundary, 0),
                 box_ring(5000, 5000, 9000, 9000, LineRole::Hole, 1),
                 box_ring(7000, 7000, 3000, 3000, LineRole::Hole, 1),
                 ring_through({{40000, 10000}, {35000, 15000}, {30000, 10000}}, LineRole::Hole, 2),
                 box_ring(20000, 0, 3000, 4000, LineRole::Hole, 3)};
    for (const Breakline& line : wander(random, size, 5, 45000, 9000)) {
        set.lines.push_back(line);
    }
    return set;
}

LineSet identical_vertices(Random& random, std::size_t size) {
    LineSet set;
    std::array<Step, 5> places{};
    std::generate(places.begin(), places.end(), [&] { return anywhere(random, 2000); });
    std::vector<Step> steps;
    for (std::size_t i = 0; i <= size; ++i) {
        const Step next = places.at(static_cast<std::size_t>(random.integer(0, 4)));
        steps.insert(steps.end(), static_cast<std::size_t>(random.integer(1, 3)), next);
        if (random.integer(0, 3) == 0) {
            set.lines.push_back(line_through(steps));
            steps.clear();
        }
    }
    steps.insert(steps.end(), 2, places[0]);
    set.lines.push_back(line_through(steps));
    return set;
}

/// Kilometres by the thousand with centimetres, all lines within a few units of one.
LineSet hair_crossings(Random& random, std::size_t size) {
    LineSet set;
    const std::int64_t reach = std::int64_t{1} << static_cast<unsigned>(random.integer(20, 38));
    const std::int64_t rise = random.integer(0, reach);
    const std::int64_t off = random.integer(1, 20);
    for (std::size_t i = 0; i < size; ++i) {
        set.lines.push_back(line_through({{random.integer(0, 30), random.integer(0, off)},
                                          {reach + random.integer(0, 30), rise + random.integer(0, off)}}));
    }
    return set;
}

constexpr std::array kFamilies{LineFamily{"long segments", long_segments},
                               LineFamily{"short segments", short_segments},
                               LineFamily{"long among short", long_among_short},
                               LineFamily{"tiny lattice", tiny_lattice},
                               LineFamily{"walks", walks},
                               LineFamily{"parallel lines", parallel_lines},
                               LineFamily{"star", star},
                               LineFamily{"hub", hub},
                               LineFamily{"even fan", even_fan},
                               LineFamily{"sharp angles", sharp_angles},
                               LineFamily{"figure 6.1", figure_6_1},
                               LineFamily{"spirals", spirals},
                               LineFamily{"contour bundle", contour_bundle},
                               LineFamily{"every line twice", every_line_twice},
                               LineFamily{"shifted by a unit", shifted_by_a_unit},
                               LineFamily{"collinear overlaps", collinear_overlaps},
                               LineFamily{"touching rings", touching_rings},
                               LineFamily{"through grid points", through_grid_points},
                               LineFamily{"parcels", parcels},
                               LineFamily{"boundary and holes", boundary_and_holes},
                               LineFamily{"identical vertices", identical_vertices},
                               LineFamily{"hair crossings", hair_crossings}};

}  // namespace

std::span<const LineFamily> line_families() { return kFamilies; }

LineSet close_parallel_edges(std::size_t edges, std::size_t pairs) {
    LineSet set;
    const auto top = static_cast<std::int64_t>(edges);
    const auto wide = static_cast<std::int64_t>(100 * (pairs + 1));
    for (std::int64_t y = 0; y < top; ++y) {
        set.lines.push_back(line_through({{0, y}, {wide, y}}));
    }
    for (std::int64_t x = 100; x < wide; x += 100) {
        set.samples.push_back(survey_point(x, -1));
        set.samples.push_back(survey_point(x, top));
    }
    return set;
}

std::vector<Breakline> fan(std::size_t count, double angle_deg, double length) {
    std::vector<Breakline> lines;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = angle_deg * static_cast<double>(i) * std::numbers::pi / 180;
        lines.push_back(line_through(
            {{0, 0}, {whole(100 * length * std::cos(angle)), whole(100 * length * std::sin(angle))}}));
    }
    return lines;
}

}  // namespace tinwright_tests
