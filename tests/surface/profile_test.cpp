#include "tinwright/surface/profile.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/surface/linear.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

__extension__ using Int128 = __int128;
using Kind = ProfilePoint::Kind;

Int128 doubled_area_of(Key2 a, Key2 b, Key2 c) {
    const auto whole = [](double value) { return static_cast<Int128>(static_cast<std::int64_t>(value)); };
    return whole(b.x - a.x) * whole(c.y - a.y) - whole(b.y - a.y) * whole(c.x - a.x);
}

/// By how many steps a place lies inside all edges of a face; negative: outside one of them.
double depth_in(const Tin& tin, const QueryLattice& lattice, FaceId f, Key2 at) {
    double depth = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 3; ++i) {
        const Key2 a = lattice.scaled(tin.key(tin.mesh.vertex(f, i)));
        const Key2 b = lattice.scaled(tin.key(tin.mesh.vertex(f, next_corner(i))));
        depth = std::min(depth,
                         static_cast<double>(doubled_area_of(a, b, at)) / std::hypot(b.x - a.x, b.y - a.y));
    }
    return depth;
}

double depth_in_terrain(const Tin& tin, const QueryLattice& lattice, Key2 at) {
    double depth = -std::numeric_limits<double>::infinity();
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            depth = std::max(depth, depth_in(tin, lattice, {f}, at));
        }
    }
    return depth;
}

/// How far along a b, in steps, every edge and vertex of the terrain is met, ends of the segment left out.
std::vector<double> met_by_trying(const Tin& tin, const QueryLattice& lattice, Key2 a, Key2 b) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    std::vector<double> met;
    const auto add = [&](long double part) { met.push_back(static_cast<double>(part) * length); };
    for (std::uint32_t h = 0; h < 4 * tin.mesh.slot_count(); ++h) {
        if (h % 4 == 3 || !tin.mesh.is_terrain(face_of({h}))) {
            continue;
        }
        const Key2 p = lattice.scaled(tin.key(tin.mesh.origin({h})));
        const Key2 q = lattice.scaled(tin.key(tin.mesh.destination({h})));
        const Int128 of_p = doubled_area_of(a, b, p);
        const Int128 of_q = doubled_area_of(a, b, q);
        const Int128 of_a = doubled_area_of(p, q, a);
        const Int128 of_b = doubled_area_of(p, q, b);
        if ((of_p > 0) != (of_q > 0) && of_p != 0 && of_q != 0 && (of_a > 0) != (of_b > 0) && of_a != 0 &&
            of_b != 0) {
            add(static_cast<long double>(of_a) / static_cast<long double>(of_a - of_b));
        }
        const long double part = (static_cast<long double>(p.x - a.x) * (b.x - a.x) +
                                  static_cast<long double>(p.y - a.y) * (b.y - a.y)) /
                                 (static_cast<long double>(length) * length);
        if (of_p == 0 && part > 0 && part < 1) {
            add(part);
        }
    }
    std::sort(met.begin(), met.end());
    std::vector<double> distinct;
    for (const double way : met) {
        if (distinct.empty() || way > distinct.back() + 0.01) {
            distinct.push_back(way);
        }
    }
    return distinct;
}

/// Whether rounding may make one of two.
bool is_close_call(const std::vector<double>& met, double length) {
    double last = 0;
    for (const double way : met) {
        if (way - last < 4) {
            return true;
        }
        last = way;
    }
    return length - last < 4;
}

Point2 random_end(Random& random, const Tin& tin, const QueryLattice& lattice) {
    const auto vertex = [&] {
        const std::int64_t last = static_cast<std::int64_t>(tin.vertex_count()) - 1;
        return tin.keys[static_cast<std::size_t>(random.integer(0, last))];
    };
    const Key2 a = vertex();
    const Key2 b = vertex();
    const double part = static_cast<double>(random.integer(-2, 6)) / 4;
    const Key2 between{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
    return lattice.position(lattice.scaled(random.integer(0, 2) == 0 ? a : between));
}

void check_profile(const Tin& tin, const QueryLattice& lattice, const std::vector<Point2>& line,
                   const std::vector<ProfilePoint>& points) {
    double last = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ProfilePoint& point = points[i];
        CHECK(point.chainage >= last);
        last = point.chainage;
        CHECK(point.place.has_value() == (point.part != ProfilePoint::kOutside));
        const Key2 at = lattice.at(point.position);
        if (point.place) {
            CHECK(depth_in(tin, lattice, point.place->face, point.place->at) >= -1);
        } else {
            CHECK(depth_in_terrain(tin, lattice, at) <= 1);
        }
        if (i + 1 == points.size()) {
            continue;
        }
        const Key2 next = lattice.at(points[i + 1].position);
        const Key2 middle{std::floor((at.x + next.x) / 2), std::floor((at.y + next.y) / 2)};
        if (point.place && point.part == points[i + 1].part) {
            CHECK(depth_in(tin, lattice, point.place->face, middle) >= -3);
        } else {
            CHECK(depth_in_terrain(tin, lattice, middle) <= 3);
        }
    }
    // Point by point of the line: what lies between is what the segment meets.
    auto found = points.begin();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Key2 a = lattice.at(line[i]);
        const Key2 b = lattice.at(line[i + 1]);
        if (a == b) {
            continue;
        }
        CHECK(found->kind == Kind::Line);
        CHECK(found->position == line[i]);
        const auto end = std::find_if(found + 1, points.end(),
                                      [](const ProfilePoint& point) { return point.kind == Kind::Line; });
        REQUIRE(end != points.end());
        const std::vector<double> met = met_by_trying(tin, lattice, a, b);
        if (!is_close_call(met, std::hypot(b.x - a.x, b.y - a.y))) {
            REQUIRE(static_cast<std::size_t>(end - found) == met.size() + 1);
            for (std::size_t k = 0; k < met.size(); ++k) {
                const Key2 at = lattice.at((found + 1 + static_cast<std::ptrdiff_t>(k))->position);
                CHECK(std::abs(std::hypot(at.x - a.x, at.y - a.y) - met[k]) <= 2);
            }
        }
        found = end;
    }
    CHECK(found + 1 == points.end());
}

/// Two squares with a gap from x = 10 to 12, the second with a void from 14 to 16; z = x.
Tin squares_with_gaps() {
    std::vector<Point3> samples;
    for (int x = 0; x <= 20; x += 2) {
        for (const double y : {0.0, 10.0}) {
            samples.push_back({static_cast<double>(x), y, static_cast<double>(x)});
        }
    }
    Tin tin = tin_of_samples(samples);
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            double x = 0;
            for (unsigned i = 0; i < 3; ++i) {
                x += tin.position(tin.mesh.vertex({f}, i)).x / 3;
            }
            tin.mesh.set_terrain({f}, (x < 10 || x > 12) && (x < 14 || x > 16));
        }
    }
    return tin;
}

std::vector<double> chainages(const std::vector<ProfilePoint>& points) {
    std::vector<double> values;
    for (const ProfilePoint& point : points) {
        values.push_back(point.chainage);
    }
    return values;
}

std::vector<int> parts(const std::vector<ProfilePoint>& points) {
    std::vector<int> values;
    for (const ProfilePoint& point : points) {
        values.push_back(point.part == ProfilePoint::kOutside ? -1 : static_cast<int>(point.part));
    }
    return values;
}

}  // namespace

TEST_SUITE("surface/profile") {
    TEST_CASE("a profile has a point wherever its line meets an edge or vertex, and nowhere else") {
        for (const auto families : {general_families(), degenerate_families()}) {
            for (const TinFamily& family : families) {
                CAPTURE(family.name);
                for (int seed = 0; seed < cases(12); ++seed) {
                    CAPTURE(seed);
                    Random random(static_cast<std::uint64_t>(seed));
                    Tin tin = family.make(random, 40);
                    if (tin.mesh.count_terrain() == 0) {
                        continue;
                    }
                    make_voids_at_random(random, tin, seed % 2 == 0 ? 0 : 20);
                    const QueryLattice lattice(tin);
                    const ProfileCutter cutter(tin);
                    std::vector<Point2> line;
                    for (int i = 0; i < 5; ++i) {
                        line.push_back(random_end(random, tin, lattice));
                    }
                    check_profile(tin, lattice, line, cutter.cut(line));
                }
            }
        }
    }

    TEST_CASE("gaps part the profile, and touching the terrain is being on it") {
        const Tin tin = squares_with_gaps();
        const ProfileCutter cutter(tin);
        // Along y = 10, which edges of the border lie on.
        const std::vector<Point2> along{{-1, 10}, {21, 10}};
        const std::vector<ProfilePoint> points = cutter.cut(along);
        CHECK(chainages(points) == std::vector<double>{0, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 22});
        CHECK(parts(points) == std::vector<int>{-1, 0, 0, 0, 0, 0, 0, 1, 1, 2, 2, 2, -1});
        CHECK(points[1].kind == Kind::Vertex);
        // Only the corner of the first square.
        const std::vector<ProfilePoint> corner = cutter.cut(std::vector<Point2>{{9, 11}, {11, 9}});
        CHECK(parts(corner) == std::vector<int>{-1, 0, -1});
        CHECK(corner[1].position == Point2{10, 10});
        // Without cuts the borders remain.
        const std::vector<ProfilePoint> bare = cutter.cut(along, {.has_cuts = false});
        CHECK(chainages(bare) == std::vector<double>{0, 1, 11, 13, 15, 17, 21, 22});
        CHECK(parts(bare) == std::vector<int>{-1, 0, 0, 1, 1, 2, 2, -1});
    }

    TEST_CASE("steps count from the line's start, over corners and gaps") {
        const Tin tin = squares_with_gaps();
        const ProfileCutter cutter(tin);
        const std::vector<Point2> line{{1, 1}, {1, 5}, {13, 5}};
        const std::vector<ProfilePoint> points = cutter.cut(line, {.has_cuts = false, .step = 3});
        CHECK(chainages(points) == std::vector<double>{0, 3, 4, 6, 9, 12, 13, 15, 16});
        CHECK(parts(points) == std::vector<int>{0, 0, 0, 0, 0, 0, 0, 1, 1});
        CHECK(points[1].kind == Kind::Step);
        CHECK(points[1].position == Point2{1, 4});
        CHECK(points[2].kind == Kind::Line);
        CHECK(points[4].position == Point2{6, 5});
        // A step that comes where a point is adds none.
        CHECK(chainages(cutter.cut(line, {.has_cuts = false, .step = 4})) ==
              std::vector<double>{0, 4, 8, 12, 13, 15, 16});
        // Outside, too, there are steps.
        CHECK(parts(cutter.cut(std::vector<Point2>{{30, 5}, {36, 5}}, {.step = 2})) ==
              std::vector<int>{-1, -1, -1, -1});
        const std::string refusal =
            message_of<InputError>([&] { static_cast<void>(cutter.cut(line, {.step = 1e-9})); });
        CHECK(refusal ==
              "a step of 1e-09 makes more than 100 million points of a line 4 long: choose a longer --step");
    }

    TEST_CASE("chainages and steps are those of the ground where that is given") {
        const Tin tin = squares_with_gaps();
        const ProfileCutter cutter(tin);
        ProfileOptions options{.step = 0.7};
        options.ground.length_function = [](Point2 a, Point2 b) {  // by the integral of a scale over x
            const double mean = 1 + 0.02 * (a.x + b.x) / 2;
            return 3 * mean * std::hypot(b.x - a.x, b.y - a.y);
        };
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            CAPTURE(seed);
            Random random(seed);
            std::vector<Point2> line;
            for (int i = 0; i < 4; ++i) {
                line.push_back({static_cast<double>(random.integer(-3000, 20000)) / 1000,
                                static_cast<double>(random.integer(-3000, 13000)) / 1000});
            }
            double start = 0;
            double last = 0;
            std::size_t steps = 0;
            std::size_t segment = 0;
            for (const ProfilePoint& point : cutter.cut(line, options)) {
                const double on_the_way = start + options.ground.length(line[segment], point.position);
                CHECK(std::abs(point.chainage - on_the_way) < 1e-6);
                CHECK(point.chainage >= last);
                last = point.chainage;
                if (point.position == line[segment + 1]) {
                    start = on_the_way;
                    segment = std::min(segment + 1, line.size() - 2);
                }
                const double steps_behind = point.chainage / options.step;
                steps += std::abs(steps_behind - std::round(steps_behind)) < 1e-12 * steps_behind ? 1U : 0U;
            }
            CHECK(steps == static_cast<std::size_t>(last / options.step));
            CHECK(last == doctest::Approx(options.ground.length(line)));
        }
    }

    TEST_CASE("the elevations of a profile are those of the planes it crosses") {
        const Tin tin = squares_with_gaps();
        const auto surface = make_linear(tin);
        const auto reader = surface->make_reader();
        const ProfileCutter cutter(tin);
        for (const ProfilePoint& point :
             cutter.cut(std::vector<Point2>{{0.3, 9}, {9.7, 0.1}}, {.step = 0.7})) {
            REQUIRE(point.place.has_value());
            CHECK(reader->elevation(*point.place) == doctest::Approx(point.position.x).epsilon(1e-12));
        }
    }

    TEST_CASE("lines that come from far away and go far away are cut where they are near") {
        const Tin tin = squares_with_gaps();
        const ProfileCutter cutter(tin);
        for (const double far : {1e4, 1e9, 1e18, 1e200}) {
            CAPTURE(far);
            const std::vector<ProfilePoint> points =
                cutter.cut(std::vector<Point2>{{-far, 10}, {far, 10}, {far, far}}, {.has_cuts = false});
            CHECK(parts(points) == std::vector<int>{-1, 0, 0, 1, 1, 2, 2, -1, -1});
            CHECK(points[1].position.x == doctest::Approx(0).epsilon(1e-9));
            CHECK(points[1].chainage == doctest::Approx(far));
            CHECK(points[1].position.y == 10);
        }
        CHECK(parts(cutter.cut(std::vector<Point2>{{1e200, 1}, {1e200, 1e100}})) == std::vector<int>{-1, -1});
    }

    TEST_CASE("a line of one place has one point, and repeated points count once") {
        const Tin tin = squares_with_gaps();
        const ProfileCutter cutter(tin);
        CHECK(parts(cutter.cut(std::vector<Point2>{{3, 3}})) == std::vector<int>{0});
        CHECK(parts(cutter.cut(std::vector<Point2>{{10, 10}, {10, 10}})) == std::vector<int>{0});
        CHECK(parts(cutter.cut(std::vector<Point2>{{11, 10}})) == std::vector<int>{-1});
        CHECK(cutter.cut(std::vector<Point2>{}).empty());
        CHECK(chainages(cutter.cut(std::vector<Point2>{{1, 0}, {1, 0}, {2, 0}, {2, 0}})) ==
              std::vector<double>{0, 1});
    }

    TEST_CASE("a position that is not finite is refused") {
        const Tin tin = squares_with_gaps();
        const ProfileCutter cutter(tin);
        const std::vector<Point2> line{{1, 1}, {std::nan(""), 2}};
        CHECK(message_of<InputError>([&] { static_cast<void>(cutter.cut(line)); }) ==
              "a line has a position that is not finite: (nan, 2); take it out");
    }
}
