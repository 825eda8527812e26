#include "tinwright/surface/contour.hpp"

#include <map>
#include <set>
#include <utility>

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"

#include "support/cases.hpp"
#include "surface/contour_pieces.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

using Line = std::vector<Point2>;

std::vector<Line> lines_at(const Tin& tin, double level) {
    const std::vector<double> levels{level};
    const LevelLines lines = make_contours(tin, levels).front();
    std::vector<Line> result;
    for (std::size_t i = 0; i < lines.count(); ++i) {
        const auto line = lines.line(i);
        result.emplace_back(line.begin(), line.end());
    }
    return result;
}

Tin tin_with(const std::vector<Point3>& samples) { return tin_of_samples(samples); }

/// The chains that pieces form when they are joined at the edges they share, each by the number of edges
/// from and to: how many are closed, and how many are open; those that are one point only left out.
struct Chains {
    std::size_t closed = 0;
    std::size_t open = 0;
};

Chains join(const std::vector<oracle::Piece>& pieces) {
    std::map<std::array<std::uint32_t, 2>, const oracle::Piece*> by_start;
    std::set<std::array<std::uint32_t, 2>> ends;
    for (const oracle::Piece& piece : pieces) {
        CHECK(by_start.emplace(piece.from_edge, &piece).second);
        CHECK(ends.insert(piece.to_edge).second);
    }
    Chains chains;
    const auto follow = [&](std::array<std::uint32_t, 2> edge, std::size_t& count) {
        bool has_length = false;
        for (auto at = by_start.find(edge); at != by_start.end(); at = by_start.find(edge)) {
            has_length = has_length || !(at->second->from == at->second->to);
            edge = at->second->to_edge;
            by_start.erase(at);
        }
        count += has_length ? 1U : 0U;
    };
    for (const oracle::Piece& piece : pieces) {
        if (!ends.contains(piece.from_edge)) {
            follow(piece.from_edge, chains.open);
        }
    }
    while (!by_start.empty()) {
        follow(by_start.begin()->first, chains.closed);
    }
    return chains;
}

oracle::Spot exact(Point2 p) { return {oracle::Rational(p.x), oracle::Rational(p.y)}; }

bool is_close(const oracle::Spot& a, Point2 b, double tolerance) {
    return std::abs(static_cast<double>(a.x) - b.x) <= tolerance &&
           std::abs(static_cast<double>(a.y) - b.y) <= tolerance;
}

/// Whether two segments cross in a point inside both.
bool do_segments_cross(const std::array<oracle::Spot, 2>& s, const std::array<oracle::Spot, 2>& t) {
    return oracle::side(s[0], s[1], t[0]) * oracle::side(s[0], s[1], t[1]) < 0 &&
           oracle::side(t[0], t[1], s[0]) * oracle::side(t[0], t[1], s[1]) < 0;
}

/// Whether `p` lies on the segment.
bool is_on(const std::array<oracle::Spot, 2>& s, const oracle::Spot& p) {
    return oracle::side(s[0], s[1], p) == 0 && std::min(s[0], s[1]) < p && p < std::max(s[0], s[1]);
}

}  // namespace

TEST_SUITE("surface/contour") {
    TEST_CASE("a pyramid has a square, closed, counter-clockwise around the peak") {
        const Tin tin = tin_with({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 2}});
        const std::vector<Line> lines = lines_at(tin, 1);
        REQUIRE(lines.size() == 1);
        REQUIRE(lines[0].size() == 5);
        CHECK(lines[0].front() == lines[0].back());
        double area = 0;
        for (std::size_t i = 1; i < lines[0].size(); ++i) {
            area += lines[0][i - 1].x * lines[0][i].y - lines[0][i].x * lines[0][i - 1].y;
        }
        CHECK(area / 2 == 4);
    }

    TEST_CASE("a slope is crossed from border to border, higher ground on the left") {
        const Tin tin = tin_with({{0, 0, 0}, {4, 0, 0}, {4, 4, 4}, {0, 4, 4}});
        const std::vector<Line> lines = lines_at(tin, 1);
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].front() == Point2{0, 1});
        CHECK(lines[0].back() == Point2{4, 1});
    }

    TEST_CASE("what lies at the level is below it") {
        // A lake at 1 in rising ground has a shore through its vertices; a mesa at 1 has no line.
        std::vector<Point3> lake{{0, 0, 5}, {6, 0, 5}, {6, 6, 5}, {0, 6, 5},
                                 {2, 2, 1}, {4, 2, 1}, {4, 4, 1}, {2, 4, 1}};
        const std::vector<Line> shore = lines_at(tin_with(lake), 1);
        REQUIRE(shore.size() == 1);
        CHECK(shore[0].size() == 5);
        const std::set<std::pair<double, double>> expected{{2, 2}, {4, 2}, {4, 4}, {2, 4}};
        std::set<std::pair<double, double>> found;
        for (const Point2 p : shore[0]) {
            found.emplace(p.x, p.y);
        }
        CHECK(found == expected);
        for (Point3& p : lake) {
            p.z = 6 - p.z;
        }
        CHECK(lines_at(tin_with(lake), 5).empty());
        CHECK(lines_at(tin_with(lake), 1).size() == 1);  // the outer edge, at the level
    }

    TEST_CASE("a pit whose bottom is at the level has no line") {
        CHECK(lines_at(tin_with({{0, 0, 5}, {4, 0, 5}, {4, 4, 5}, {0, 4, 5}, {2, 2, 1}}), 1).empty());
    }

    TEST_CASE("lines are those of the faces, one by one, joined wherever they share an edge") {
        for (int seed = 0; seed < cases(400); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = contour_tin(random, static_cast<std::size_t>(seed));
            if (tin.vertex_count() == 0) {
                continue;
            }
            const double tolerance = 4e-16 * extent_of(tin);
            for (const double level : contour_levels_for(random, tin)) {
                CAPTURE(level);
                std::vector<oracle::Piece> pieces = oracle::cut_faces(tin, level);
                const Chains chains = join(pieces);
                const std::vector<Line> lines = lines_at(tin, level);
                CHECK(lines.size() == chains.closed + chains.open);
                std::erase_if(pieces, [](const oracle::Piece& piece) { return piece.from == piece.to; });
                std::size_t segments = 0;
                std::size_t found = 0;
                for (const Line& line : lines) {
                    REQUIRE(line.size() >= 2);
                    for (std::size_t i = 1; i < line.size(); ++i) {
                        CHECK(line[i - 1] != line[i]);
                        ++segments;
                        const auto piece =
                            std::find_if(pieces.begin(), pieces.end(), [&](const oracle::Piece& p) {
                                return is_close(p.from, line[i - 1], tolerance) &&
                                       is_close(p.to, line[i], tolerance);
                            });
                        if (piece != pieces.end()) {
                            pieces.erase(piece);
                            ++found;
                        }
                    }
                }
                CHECK(found == segments);
                CHECK(pieces.empty());
            }
        }
    }

    TEST_CASE("no line crosses another, and lines of different levels do not touch") {
        for (int seed = 0; seed < cases(40); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = contour_tin(random, static_cast<std::size_t>(seed));
            if (tin.vertex_count() == 0) {
                continue;
            }
            struct Segment {
                std::size_t level = 0;
                std::array<oracle::Spot, 2> ends{};
            };
            const std::vector<double> levels = contour_levels_for(random, tin);
            std::vector<Segment> segments;
            for (std::size_t level = 0; level < levels.size(); ++level) {
                for (const Line& line : lines_at(tin, levels[level])) {
                    for (std::size_t i = 1; i < line.size(); ++i) {
                        Segment& segment = segments.emplace_back();
                        segment.level = level;
                        segment.ends[0] = exact(line[i - 1]);
                        segment.ends[1] = exact(line[i]);
                    }
                }
            }
            std::size_t crossings = 0;
            std::size_t touches = 0;
            for (std::size_t i = 0; i < segments.size(); ++i) {
                for (std::size_t k = 0; k < i; ++k) {
                    const auto& s = segments[i].ends;
                    const auto& t = segments[k].ends;
                    crossings += do_segments_cross(s, t) ? 1U : 0U;
                    if (segments[i].level != segments[k].level) {
                        for (std::size_t end = 0; end < 2; ++end) {
                            touches += is_on(s, t[end]) || is_on(t, s[end]) ? 1U : 0U;
                            touches += s[end] == t[0] || s[end] == t[1] ? 1U : 0U;
                        }
                    }
                }
            }
            CHECK(crossings == 0);
            CHECK(touches == 0);
        }
    }

    TEST_CASE("crossings of ascending levels never go back along an edge") {
        Random random(7);
        for (int round = 0; round < cases(2000); ++round) {
            const double x = 600000 + random.real();
            const double y = 5700000 + random.real();
            const double reach = std::pow(10, -6 * random.real());
            const Tin tin = tin_with({{x, y, 300 * random.real()},
                                      {x + reach, y + reach * (random.real() - 0.5), 300 * random.real()},
                                      {x, y + 3, -1000}});
            std::vector<double> levels;
            const double low = std::min(tin.z[0], tin.z[1]);
            for (int i = 0; i < 50; ++i) {
                levels.push_back(low + i * 1e-13 * low);
            }
            levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
            std::vector<Point2> on_edge;
            for (const LevelLines& lines : make_contours(tin, levels)) {
                for (std::size_t i = 0; i < lines.count(); ++i) {
                    // The end that is on the edge towards the lowest vertex is of no interest.
                    const auto line = lines.line(i);
                    on_edge.push_back(line.front().y < line.back().y ? line.front() : line.back());
                }
            }
            bool is_ascending = true;
            bool is_descending = true;
            for (std::size_t i = 1; i < on_edge.size(); ++i) {
                is_ascending = is_ascending && on_edge[i - 1].x <= on_edge[i].x;
                is_descending = is_descending && on_edge[i - 1].x >= on_edge[i].x;
            }
            const bool is_monotone = is_ascending || is_descending;
            CHECK(is_monotone);
        }
    }

    TEST_CASE("the lines do not depend on the order of faces or on threads") {
        for (int seed = 0; seed < cases(30); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = tied_grid(random, 9, 7, 3);
            std::vector<std::uint32_t> corners;
            for (const auto& face : terrain_of(tin.mesh)) {
                corners.insert(corners.end(), face.begin(), face.end());
            }
            Tin other = tin;
            other.mesh = mesh_of(tin.vertex_count(), shuffled_faces(random, corners));
            const std::vector<double> levels{0, 0.5, 1, 2, 2.25};
            const std::vector<LevelLines> expected = make_contours(tin, levels);
            std::vector<LevelLines> found;
            tbb::task_arena arena(1);
            arena.execute([&] { found = make_contours(other, levels); });
            REQUIRE(found.size() == expected.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                CHECK(found[i].points == expected[i].points);
                CHECK(found[i].ends == expected[i].ends);
            }
        }
    }

    TEST_CASE("elevations near the greatest double are cut too") {
        const Tin tin = tin_with({{0, 0, -1.5e308}, {4, 0, -1.5e308}, {4, 4, 1.5e308}, {0, 4, 1.5e308}});
        const std::vector<Line> lines = lines_at(tin, 0);
        REQUIRE(lines.size() == 1);
        CHECK(lines[0].front() == Point2{0, 2});
        CHECK(lines[0].back() == Point2{4, 2});
    }

    TEST_CASE("the callback can stop it") {
        const Tin tin = tin_with({{0, 0, 0}, {4, 0, 0}, {4, 4, 4}, {0, 4, 4}});
        const Progress stop = [](double) { return false; };
        const std::vector<double> levels{1};
        CHECK_THROWS_AS(make_contours(tin, levels, stop), Cancelled);
    }
}
