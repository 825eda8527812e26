#include "profile_plot.hpp"

#include <algorithm>
#include <cstdint>

#include <doctest/doctest.h>

#include "stroke_font.hpp"

namespace {

using namespace tinwright;
using namespace tinwright::tools;

/// The strokes of curves: those that are wider than axes.
std::vector<LineDrawing::Stroke> curves_of(const LineDrawing& drawing) {
    std::vector<LineDrawing::Stroke> curves;
    std::copy_if(drawing.strokes.begin(), drawing.strokes.end(), std::back_inserter(curves),
                 [](const LineDrawing::Stroke& stroke) { return stroke.width > 1; });
    return curves;
}

bool has_label(const LineDrawing& drawing, const std::string& text) {
    return std::any_of(drawing.labels.begin(), drawing.labels.end(),
                       [&](const LineDrawing::Label& label) { return label.text == text; });
}

}  // namespace

TEST_SUITE("tools/profile_plot") {
    TEST_CASE("every part of a profile is a stroke, and higher points are further up") {
        const LineDrawing drawing =
            draw_profiles({{"a", {{{0, 10}, {5, 20}}, {{8, 15}, {10, 15}}}}}, {"metre", "metre"});
        const std::vector<LineDrawing::Stroke> curves = curves_of(drawing);
        REQUIRE(curves.size() == 2);
        CHECK(curves[0].points[0].y > curves[0].points[1].y);
        CHECK(curves[1].points[0].y == curves[1].points[1].y);
        CHECK(curves[0].points[1].x < curves[1].points[0].x);
        for (const LineDrawing::Stroke& stroke : drawing.strokes) {
            for (const Point2 point : stroke.points) {
                CHECK((point.x >= 0 && point.x <= drawing.width));
                CHECK((point.y >= 0 && point.y <= drawing.height));
            }
        }
        CHECK(has_label(drawing, "distance, metre"));
        CHECK(has_label(drawing, "elevation, metre"));
        CHECK(has_label(drawing, "20"));
        CHECK_FALSE(has_label(drawing, "a"));  // one curve needs no name
    }

    TEST_CASE("profiles without height, length or points can be drawn") {
        for (const std::vector<ProfileCurve>& curves : {std::vector<ProfileCurve>{},
                                                        {{"none", {}}},
                                                        {{"dot", {{{3, 1e6}}}}},
                                                        {{"level", {{{0, 5}, {10, 5}}}}},
                                                        {{"upright", {{{5, 0}, {5, 1e-9}}}}}}) {
            const LineDrawing drawing = draw_profiles(curves, {});
            CHECK(svg_text(drawing).find("nan") == std::string::npos);
            CHECK(svg_text(drawing).find("inf") == std::string::npos);
            CHECK(paint(drawing).bytes.size() == std::size_t{960} * 480 * 4 * 3);
        }
    }

    TEST_CASE("names are escaped in SVG, and points that round to one are written once") {
        LineDrawing drawing;
        drawing.strokes.push_back({{{0, 0}, {0.001, 0}, {1, 0}}, {}, 1});
        drawing.labels.push_back({{1, 2}, "a<b&c", LineDrawing::Anchor::Start, {}, false});
        const std::string svg = svg_text(drawing);
        CHECK(svg.find(">a&lt;b&amp;c<") != std::string::npos);
        CHECK(svg.find("points=\"0,0 1,0\"") != std::string::npos);
    }

    TEST_CASE("painted strokes and letters are where the drawing has them") {
        LineDrawing drawing;
        drawing.width = 40;
        drawing.height = 20;
        drawing.strokes.push_back({{{0, 10}, {40, 10}}, {200, 0, 0}, 2});
        const Picture picture = paint(drawing);
        CHECK(picture.width == 80);
        const auto red_at = [&](int column, int row) {
            const auto at = static_cast<std::size_t>(3 * (row * picture.width + column));
            return picture.bytes[at] == 200 && picture.bytes[at + 1] == 0;
        };
        CHECK(red_at(40, 19));
        CHECK(red_at(40, 20));
        CHECK_FALSE(red_at(40, 24));
        CHECK_FALSE(strokes_of('8').empty());
        CHECK(strokes_of('m').size() == strokes_of('M').size());
        CHECK(strokes_of(' ').empty());
    }
}
