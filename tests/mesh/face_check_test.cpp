#include "tinwright/mesh/face_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

struct Faces {
    std::vector<Point3> vertices;
    std::vector<std::uint32_t> corners;
};

/// Every face with vertices of its own, as a file has them.
Faces loose(const std::vector<std::array<Point3, 3>>& faces) {
    Faces result;
    for (const auto& face : faces) {
        for (const Point3& corner : face) {
            result.corners.push_back(static_cast<std::uint32_t>(result.vertices.size()));
            result.vertices.push_back(corner);
        }
    }
    return result;
}

FaceCheckReport report_on(const std::vector<std::array<Point3, 3>>& faces) {
    const Faces soup = loose(faces);
    return check_faces(soup.vertices, soup.corners);
}

/// The one violation of a report that has no other.
FaceViolation only(const FaceCheckReport& report, FaceDefect defect) {
    REQUIRE(report.violations.size() == 1);
    REQUIRE(report.violations[0].defect == defect);
    REQUIRE(report.count(defect) == 1);
    return report.violations[0];
}

/// Centimetres in UTM; z given.
Point3 at(std::int64_t x, std::int64_t y, double z = 0) {
    return {oracle::decimal_value(32345600 + x, 2), oracle::decimal_value(512345600 + y, 2), z};
}

std::vector<std::array<Point3, 3>> faces_of(const Tin& tin) {
    std::vector<std::array<Point3, 3>> faces;
    for (const auto& face : terrain_of(tin.mesh)) {
        faces.push_back({tin.position({face[0]}), tin.position({face[1]}), tin.position({face[2]})});
    }
    return faces;
}

bool operator==(const FaceViolation& a, const FaceViolation& b) {
    return a.defect == b.defect && a.face == b.face && a.other == b.other && a.location == b.location &&
           a.other_z == b.other_z;
}

/// Whether faces lie all around a location: every edge from it then has two of them.
bool is_surrounded(const std::vector<std::array<Point3, 3>>& faces, const Point3& location) {
    std::vector<Point3> ends;
    for (const auto& face : faces) {
        if (std::find(face.begin(), face.end(), location) != face.end()) {
            std::copy_if(face.begin(), face.end(), std::back_inserter(ends),
                         [&](const Point3& corner) { return !(corner == location); });
        }
    }
    return std::all_of(ends.begin(), ends.end(),
                       [&](const Point3& end) { return std::count(ends.begin(), ends.end(), end) == 2; });
}

}  // namespace

TEST_SUITE("mesh/face_check") {
    TEST_CASE("faces of a triangulation have no defect, whether they share vertices or not") {
        for (const KeyFamily& family : key_families()) {
            CAPTURE(family.name);
            Random random(2);
            Tin tin = delaunay_tin(family.make(random, 400));
            for (double& z : tin.z) {
                z = random.real();
            }
            REQUIRE(report_on(shuffled(random, faces_of(tin))).is_clean());
            std::vector<Point3> vertices;
            for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
                vertices.push_back(tin.position({v}));
            }
            std::vector<std::uint32_t> corners;
            for (const auto& face : terrain_of(tin.mesh)) {
                corners.insert(corners.end(), face.begin(), face.end());
            }
            REQUIRE(check_faces(vertices, corners).is_clean());
        }
    }

    TEST_CASE("no faces have no defect") {
        CHECK(check_faces({}, {}).is_clean());
        CHECK(check_faces(std::vector<Point3>{{1, 2, 3}}, {}).is_clean());
    }

    TEST_CASE("a corner that is not finite is found, and its face left out") {
        const double nan = std::numeric_limits<double>::quiet_NaN();
        const FaceCheckReport report = report_on({{at(0, 0), at(100, 0), at(0, 100)},
                                                  {at(0, 0), {nan, 0, 0}, at(50, 50)},
                                                  {at(0, 0), at(90, 0), at(0, 90, nan)}});
        CHECK(report.count(FaceDefect::NotFinite) == 2);
        CHECK(report.violations.size() == 2);
        CHECK(report.violations[0].face == 1);
        CHECK(report.violations[1].face == 2);
    }

    TEST_CASE("a face without area is found: collinear on the decimal lattice, or two corners at one place") {
        const auto thin = only(report_on({{at(0, 0), at(10, 30), at(30, 90)}}), FaceDefect::ZeroArea);
        CHECK(thin.face == 0);
        CHECK(thin.location == at(0, 0));
        CHECK(only(report_on({{at(0, 0), at(10, 30), at(0, 0)}}), FaceDefect::ZeroArea).face == 0);
        // A vertical wall is a crack too.
        const FaceCheckReport wall = report_on({{at(0, 0, 1), at(10, 30, 1), at(0, 0, 5)}});
        CHECK(wall.count(FaceDefect::ZeroArea) == 1);
        CHECK(wall.count(FaceDefect::Crack) == 1);
    }

    TEST_CASE("a clockwise face is found, and is no overlap with its neighbour") {
        const auto found =
            only(report_on({{at(0, 0), at(100, 0), at(0, 100)}, {at(100, 0), at(0, 100), at(100, 100)}}),
                 FaceDefect::Clockwise);
        CHECK(found.face == 1);
    }

    TEST_CASE("a repeated face is found, turned or clockwise as it may be") {
        const FaceCheckReport report = report_on({{at(0, 0), at(100, 0), at(0, 100)},
                                                  {at(100, 0), at(0, 100), at(0, 0)},
                                                  {at(0, 0), at(0, 100), at(100, 0)}});
        CHECK(report.count(FaceDefect::Repeated) == 2);
        CHECK(report.count(FaceDefect::Clockwise) == 1);
        CHECK(report.violations.size() == 3);
        CHECK(report.violations[1].face == 1);
        CHECK(report.violations[1].other == 0);
        CHECK(report.violations[2].other == 0);
    }

    TEST_CASE("an edge with two faces on one side is found") {
        const auto found =
            only(report_on({{at(0, 0), at(100, 0), at(0, 100)}, {at(0, 0), at(100, 0), at(40, 50)}}),
                 FaceDefect::SharedEdge);
        CHECK(found.face == 1);
        CHECK(found.other == 0);
        CHECK(found.location == at(50, 0));
    }

    TEST_CASE("two elevations at one location are found once, with both") {
        const auto found = only(report_on({{at(0, 0, 1), at(100, 0, 2), at(0, 100, 3)},
                                           {at(100, 0, 2.5), at(100, 100, 4), at(0, 100, 3)},
                                           {at(100, 0, 2.5), at(200, 0, 4), at(100, 100, 4)}}),
                                FaceDefect::Crack);
        CHECK(found.face == 1);
        CHECK(found.other == 0);
        CHECK(found.location == at(100, 0, 2.5));
        CHECK(found.other_z == 2);
    }

    TEST_CASE("a vertex on another face's edge is found, decimal as it may be") {
        // (30, 10), (60, 20) on the edge from (0, 0) to (90, 30): straight in centimetres, not in binary.
        const FaceCheckReport report = report_on({{at(0, 0), at(90, 30), at(0, 100)},
                                                  {at(30, 10), at(0, 0), at(50, -90)},
                                                  {at(60, 20), at(30, 10), at(50, -90)},
                                                  {at(90, 30), at(60, 20), at(50, -90)}});
        CHECK(report.violations.size() == 2);
        CHECK(report.count(FaceDefect::VertexOnEdge) == 2);
        CHECK(report.violations[0].face == 0);
        CHECK(report.violations[0].location == at(30, 10));
        CHECK(report.violations[1].location == at(60, 20));
    }

    TEST_CASE("faces that touch at a corner have no defect") {
        CHECK(
            report_on({{at(0, 0), at(100, 0), at(0, 100)}, {at(0, 0), at(-100, 0), at(0, -100)}}).is_clean());
    }

    TEST_CASE("overlapping faces are found with a place in both") {
        const auto found =
            only(report_on({{at(0, 0), at(100, 0), at(0, 100)}, {at(10, 10), at(100, 10), at(100, 100)}}),
                 FaceDefect::Overlap);
        CHECK(found.face == 1);
        CHECK(found.other == 0);
        CHECK(found.location.x > at(10, 0).x);
        CHECK(found.location.x < at(90, 0).x);
        CHECK(found.location.y > at(0, 10).y);
        CHECK(found.location.y < at(0, 50).y);
        // One face within another.
        CHECK(only(report_on({{at(0, 0), at(100, 0), at(0, 100)}, {at(10, 10), at(20, 10), at(10, 20)}}),
                   FaceDefect::Overlap)
                  .face == 1);
        // By one centimetre.
        CHECK(report_on({{at(0, 0), at(1000, 0), at(0, 1000)}, {at(1, 1000), at(1000, 0), at(1000, 1000)}})
                  .is_clean());
        CHECK(report_on({{at(0, 0), at(1000, 0), at(0, 1000)}, {at(499, 500), at(2000, 500), at(2000, 2000)}})
                  .count(FaceDefect::Overlap) == 1);
        CHECK(report_on({{at(0, 0), at(1000, 0), at(0, 1000)}, {at(500, 500), at(2000, 500), at(2000, 2000)}})
                  .count(FaceDefect::Overlap) == 0);
    }

    TEST_CASE("random faces: every face that overlaps an earlier one is found, as by exact clipping") {
        for (int seed = 0; seed < cases(200); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const std::int64_t span = random.integer(6, 60);
            const std::int64_t size = random.integer(2, 12);
            std::vector<std::array<Key2, 3>> keys;
            std::vector<std::array<Point3, 3>> faces;
            for (std::int64_t i = random.integer(2, 40); i > 0; --i) {
                std::array<Key2, 3> face{};
                const std::int64_t x = random.integer(0, span);
                const std::int64_t y = random.integer(0, span);
                do {
                    for (Key2& key : face) {
                        key = {static_cast<double>(x + random.integer(0, size)),
                               static_cast<double>(y + random.integer(0, size))};
                    }
                } while (oracle::orient2d(face[0], face[1], face[2]) <= 0);
                keys.push_back(face);
                faces.push_back({Point3{face[0].x, face[0].y, 0}, Point3{face[1].x, face[1].y, 0},
                                 Point3{face[2].x, face[2].y, 0}});
            }
            const FaceCheckReport report = report_on(faces);
            // Repeated faces and those with a common edge on one side overlap as well, by other names.
            std::set<std::size_t> found;
            for (const FaceViolation& v : report.violations) {
                if (v.defect == FaceDefect::Overlap || v.defect == FaceDefect::SharedEdge ||
                    v.defect == FaceDefect::Repeated) {
                    REQUIRE(v.other < v.face);
                    REQUIRE(oracle::do_interiors_meet(keys[v.face], keys[v.other]));
                    found.insert(v.face);
                }
            }
            std::set<std::size_t> expected;
            for (std::size_t i = 0; i < keys.size(); ++i) {
                for (std::size_t j = 0; j < i; ++j) {
                    if (oracle::do_interiors_meet(keys[i], keys[j])) {
                        expected.insert(i);
                    }
                }
            }
            REQUIRE(found == expected);
        }
    }

    TEST_CASE("a vertex moved in one of its faces is found, in large sets as in small") {
        for (int seed = 0; seed < cases(60); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = delaunay_tin(key_families()[2].make(random, 300));
            std::vector<std::array<Point3, 3>> faces = faces_of(tin);
            const auto f =
                static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(faces.size()) - 1));
            Point3& corner = faces[f][static_cast<std::size_t>(random.integer(0, 2))];
            const Point3 before = corner;
            // A corner on the border may be moved outwards, or up if no other face has it, and all stays
            // well.
            if (!is_surrounded(faces, corner)) {
                continue;
            }
            switch (random.integer(0, 2)) {
                case 0:
                    corner.z += 0.01;
                    break;
                case 1:
                    corner = {-1e6, 3e6, 0};  // over its neighbours, or turned round
                    break;
                default:
                    faces.push_back(faces[f]);
            }
            CAPTURE(before.x);
            REQUIRE_FALSE(report_on(faces).is_clean());
        }
    }

    TEST_CASE("the report is the same for any number of threads") {
        const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
        Random random(17);
        std::vector<std::array<Point3, 3>> faces =
            faces_of(delaunay_tin(key_families()[1].make(random, 5000)));
        for (int i = 0; i < 2000; ++i) {
            const auto any = [&] { return Point3{random.key(128), random.key(128), random.key(3)}; };
            faces.push_back({any(), any(), any()});
        }
        const Faces soup = loose(faces);
        FaceCheckReport one;
        tbb::task_arena(1).execute([&] { one = check_faces(soup.vertices, soup.corners); });
        CHECK(one.count(FaceDefect::Overlap) > 1000);
        tbb::task_arena(4).execute([&] {
            const FaceCheckReport four = check_faces(soup.vertices, soup.corners);
            CHECK(four.counts == one.counts);
            CHECK(std::equal(four.violations.begin(), four.violations.end(), one.violations.begin(),
                             one.violations.end(), [](const auto& a, const auto& b) { return a == b; }));
        });
        const FaceCheckReport few = check_faces(soup.vertices, soup.corners, {.limit = 10});
        CHECK(few.counts == one.counts);
        CHECK(std::count_if(few.violations.begin(), few.violations.end(),
                            [](const FaceViolation& v) { return v.defect == FaceDefect::Overlap; }) == 10);
    }

    TEST_CASE("every defect has a text, and a corner out of range is refused") {
        for (std::size_t i = 0; i < kFaceDefects; ++i) {
            CHECK_FALSE(text_of(static_cast<FaceDefect>(i)).empty());
        }
        CHECK_THROWS_WITH_AS(check_faces(std::vector<Point3>(3), std::vector<std::uint32_t>{0, 1, 3}),
                             "face 0: corner 3 is not one of the 3 vertices", InputError);
        CHECK_THROWS_WITH_AS(check_faces(std::vector<Point3>(3), std::vector<std::uint32_t>{0, 1}),
                             "cannot audit 2 corners of faces and 3 vertices", InputError);
    }
}
