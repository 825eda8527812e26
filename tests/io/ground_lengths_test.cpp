// What is told of lengths and areas, against GeographicLib's Geodesic and PolygonArea themselves.

#include <array>
#include <cmath>
#include <vector>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <doctest/doctest.h>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/criteria/quality.hpp"
#include "tinwright/io/geodesic_measures.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/breakline_distance.hpp"
#include "tinwright/surface/profile.hpp"
#include "tinwright/water/water.hpp"

#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

constexpr int kZone = 33;  // of longitudes 12 to 18

Point2 utm(double longitude, double latitude) {
    int zone = 0;
    bool is_north = true;
    Point2 p;
    GeographicLib::UTMUPS::Forward(latitude, longitude, zone, is_north, p.x, p.y, kZone);
    return p;
}

struct LonLat {
    double longitude = 0;
    double latitude = 0;
};

LonLat lon_lat(Point2 p) {
    LonLat place;
    GeographicLib::UTMUPS::Reverse(kZone, true, p.x, p.y, place.latitude, place.longitude);
    return place;
}

double geodesic(LonLat a, LonLat b) {
    double length = 0;
    GeographicLib::Geodesic::WGS84().Inverse(a.latitude, a.longitude, b.latitude, b.longitude, length);
    return length;
}

double geodesic(Point2 a, Point2 b) { return geodesic(lon_lat(a), lon_lat(b)); }

Point2 flat(const Point3& p) { return {p.x, p.y}; }

GroundMeasures ground_of_zone() {
    GroundMeasures ground = io::make_geodesic_measures(io::Crs::parse("EPSG:32633"));
    ground.distortion = 0.0011;
    return ground;
}

/// Between the zone's middle and its border, where the scale is 1.0004 at most.
std::vector<Point3> samples_of_zone(std::uint64_t seed, int count) {
    Random random(seed);
    std::vector<Point3> samples;
    for (int i = 0; i < count; ++i) {
        const Point2 p = utm(12 + static_cast<double>(random.integer(0, 30000)) / 10000,
                             50 + static_cast<double>(random.integer(0, 20000)) / 10000);
        samples.push_back({std::round(p.x * 1000) / 1000, std::round(p.y * 1000) / 1000,
                           static_cast<double>(random.integer(0, 1000))});
    }
    return samples;
}

}  // namespace

TEST_SUITE("io/ground_lengths") {
    TEST_CASE("steps along a meridian and a parallel are geodesic distances from the line's points") {
        const Tin tin = triangulate(samples_of_zone(1, 400)).tin;
        const ProfileCutter cutter(tin);
        std::vector<Point2> meridian;
        std::vector<Point2> parallel;
        for (int i = 0; i <= 8; ++i) {
            meridian.push_back(utm(12.5, 50.2 + 0.2 * i));
            parallel.push_back(utm(12.2 + 0.3 * i, 51));
        }
        for (const std::vector<Point2>& line : {meridian, parallel}) {
            const ProfileOptions options{.step = 1234.5, .ground = ground_of_zone()};
            double start = 0;
            double most_off = 0;
            std::size_t segment = 0;
            std::size_t steps = 0;
            for (const ProfilePoint& point : cutter.cut(line, options)) {
                if (point.kind == ProfilePoint::Kind::Line && segment + 1 < line.size() &&
                    point.position == line[segment + 1]) {
                    start += geodesic(line[segment], line[segment + 1]);
                    ++segment;
                    CHECK(point.chainage == doctest::Approx(start).epsilon(1e-12));
                    continue;
                }
                const double chainage = start + geodesic(line[segment], point.position);
                most_off = std::max(most_off, std::abs(point.chainage - chainage));
                if (point.kind == ProfilePoint::Kind::Step) {
                    ++steps;
                    CHECK(std::abs(std::remainder(point.chainage, options.step)) < 1e-8);
                }
            }
            CHECK(most_off < 1e-6);
            CHECK(steps == static_cast<std::size_t>(start / options.step));
        }
        // A meridian's chainage is the meridian arc, a parallel's nearly its radius times the angle.
        const auto points = cutter.cut(meridian, {.has_cuts = false, .ground = ground_of_zone()});
        CHECK(points.back().chainage ==
              doctest::Approx(geodesic(LonLat{12.5, 50.2}, LonLat{12.5, 51.8})).epsilon(1e-9));
    }

    TEST_CASE("the area of all faces is that of the geodesic polygon around them") {
        const Tin tin = triangulate(samples_of_zone(2, 300)).tin;
        const QualityReport quality = assess_quality(tin, 5, ground_of_zone());
        GeographicLib::PolygonArea hull(GeographicLib::Geodesic::WGS84());
        double longest = 0;
        std::vector<HalfEdgeId> border;
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
                const HalfEdgeId h = half_edge({f}, i);
                longest = std::max(longest, geodesic(flat(tin.position(tin.mesh.origin(h))),
                                                     flat(tin.position(tin.mesh.destination(h)))));
                if (tin.mesh.is_border(h)) {
                    border.push_back(h);
                }
            }
        }
        VertexId at = tin.mesh.origin(border.front());
        for (std::size_t i = 0; i < border.size(); ++i) {
            const LonLat place = lon_lat(flat(tin.position(at)));
            hull.AddPoint(place.latitude, place.longitude);
            for (const HalfEdgeId h : border) {
                if (tin.mesh.origin(h) == at) {
                    at = tin.mesh.destination(h);
                    break;
                }
            }
        }
        double perimeter = 0;
        double area = 0;
        hull.Compute(false, true, perimeter, area);
        CHECK(quality.area == doctest::Approx(area).epsilon(1e-10));
        CHECK(quality.summaries[2].maximum == doctest::Approx(longest).epsilon(1e-12));
        const QualityReport planar = assess_quality(tin);
        CHECK(std::abs(planar.area / area - 1) > 1e-5);  // which the plane would not tell
    }

    TEST_CASE("voids are where edges are longer than --max-edge on the ellipsoid, in metres and in feet") {
        for (const char* name : {"EPSG:32633", "+proj=utm +zone=33 +datum=WGS84 +units=us-ft"}) {
            CAPTURE(name);
            const bool is_feet = name[0] == '+';
            const double unit = is_feet ? 1200.0 / 3937 : 1;
            GroundMeasures ground = io::make_geodesic_measures(io::Crs::parse(name));
            ground.distortion = 0.0011;
            for (std::uint64_t seed = 1; seed <= 5; ++seed) {
                CAPTURE(seed);
                std::vector<Point3> samples = samples_of_zone(seed, 500);
                for (Point3& p : samples) {
                    p = {p.x / unit, p.y / unit, p.z};
                }
                const Tin tin = triangulate(samples).tin;
                for (const double limit : {9000.0, 12000.0, 20000.0}) {
                    TriangulateOptions options;
                    options.max_edge = limit;
                    options.ground = ground;
                    const Tin with_voids = triangulate(samples, {}, options).tin;
                    std::size_t expected = 0;
                    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
                        bool is_kept = tin.mesh.is_terrain({f});
                        for (unsigned i = 0; i < 3 && is_kept; ++i) {
                            const Point3 a = tin.position(tin.mesh.vertex({f}, i));
                            const Point3 b = tin.position(tin.mesh.vertex({f}, next_corner(i)));
                            is_kept = geodesic(Point2{a.x * unit, a.y * unit},
                                               Point2{b.x * unit, b.y * unit}) <= limit;
                        }
                        expected += is_kept ? 1U : 0U;
                    }
                    CHECK(with_voids.mesh.count_terrain() == expected);
                }
            }
        }
    }

    TEST_CASE("the distance to a breakline is geodesic to its nearest point") {
        const std::vector<Point3> samples = samples_of_zone(3, 50);
        const Point2 a = utm(13, 50.5);
        const Point2 b = utm(13.4, 51.5);
        const std::vector<Breakline> lines{{{{a.x, a.y, 5}, {b.x, b.y, 9}}}};
        const Tin tin = triangulate(samples, lines).tin;
        const BreaklineDistance distance(tin, {true});
        const QueryLattice lattice(tin);
        const Point2 from = utm(12.3, 50.9);
        const double along = ((from.x - a.x) * (b.x - a.x) + (from.y - a.y) * (b.y - a.y)) /
                             ((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
        const Point2 foot{a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
        const Key2 at = lattice.at(from);
        CHECK(distance.at(at, ground_of_zone()) == doctest::Approx(geodesic(from, foot)).epsilon(1e-7));
        CHECK(distance.at(at) == doctest::Approx(std::hypot(from.x - foot.x, from.y - foot.y)).epsilon(1e-7));
        CHECK(distance.at(at, GroundMeasures{}) == distance.at(at));
    }

    TEST_CASE("rivers and shores are as long as geodesics along them") {
        std::vector<Breakline> lines(2);
        lines[0].role = LineRole::River;
        double river = 0;
        for (int i = 0; i <= 5; ++i) {
            const Point2 p = utm(12.4 + 0.1 * i, 50.5 + 0.05 * i);
            lines[0].points.push_back({p.x, p.y, 100.0 - i});
            river += i == 0 ? 0 : geodesic(flat(lines[0].points[static_cast<std::size_t>(i) - 1]), p);
        }
        lines[0].points[3].z = 120;  // a rise
        lines[1].role = LineRole::Lake;
        for (const auto& [x, y] : {std::pair{13.5, 51.0}, {13.9, 51.0}, {13.7, 51.3}, {13.5, 51.0}}) {
            const Point2 p = utm(x, y);
            lines[1].points.push_back({p.x, p.y, 50});
        }
        lines[1].polygon = 1;
        double shore = 0;
        for (std::size_t i = 1; i < lines[1].points.size(); ++i) {
            shore += geodesic(flat(lines[1].points[i - 1]), flat(lines[1].points[i]));
        }
        WaterOptions options;
        options.ground = ground_of_zone();
        const Water water = level_water({}, lines, options);
        REQUIRE(water.report.reaches.size() == 1);
        CHECK(water.report.reaches[0].length == doctest::Approx(river).epsilon(1e-8));
        REQUIRE(water.report.lakes.size() == 1);
        CHECK(water.report.lakes[0].shore_length == doctest::Approx(shore).epsilon(1e-12));
        REQUIRE(!water.report.findings.empty());
        const WaterFinding& rise = water.report.findings.front();
        CHECK(rise.kind == WaterFinding::Kind::RunsUphill);
        const double first_part = geodesic(flat(lines[0].points[0]), flat(lines[0].points[1])) +
                                  geodesic(flat(lines[0].points[1]), flat(lines[0].points[2]));
        const double rising = geodesic(flat(lines[0].points[2]), flat(lines[0].points[3]));
        CHECK(rise.chainage == doctest::Approx(first_part + rising).epsilon(1e-8));
        CHECK(rise.length == doctest::Approx(rising).epsilon(1e-8));
    }
}
