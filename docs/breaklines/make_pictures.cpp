// Draws the pictures of docs/breaklines.md: small scenes, triangulated by the library, as SVG.
//   make_pictures FOLDER          writes them
//   make_pictures --check FOLDER  fails when the folder holds anything else than what would be written
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/optimal/triangulate.hpp"

namespace {

using tinwright::Breakline;
using tinwright::FaceId;
using tinwright::HalfEdgeId;
using tinwright::kDraped;
using tinwright::LineConflict;
using tinwright::LineRole;
using tinwright::Point2;
using tinwright::Point3;
using tinwright::Tin;
using tinwright::VertexId;

/// Numbers that look random, the same on every machine.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double between(double low, double high) {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return low + (high - low) * static_cast<double>(state_ >> 40U) * 0x1p-24;
    }

  private:
    std::uint64_t state_;
};

struct Scene {
    std::vector<Point3> samples;
    std::vector<Breakline> lines;
    tinwright::TriangulateOptions options;
};

/// What a panel shows beside the TIN.
struct Marks {
    bool are_lines_enforced = true;  ///< else they are drawn across the faces
    bool has_conflicts = false;      ///< numbered
    bool has_faces = true;
    bool has_line_points = false;  ///< of the lines as they came
};

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", value + 0.0);
    return text.data();
}

const char* colour_of(LineRole role) {
    switch (role) {
        case LineRole::Boundary:
            return "#222";
        case LineRole::Hole:
            return "#d62728";
        default:
            return "#1f5fb4";
    }
}

/// Panels side by side, 10 picture units a metre.
class Picture {
  public:
    Picture(std::string title, double width, double height)
        : title_(std::move(title)), width_(width), height_(height) {}

    /// Adds a panel; returns what the triangulation reported.
    tinwright::TriangulateReport add(const std::string& caption, const Scene& scene,
                                     const Marks& marks = {}) {
        left_ += panels_ > 0 ? kScale * width_ + kGap : 0;
        ++panels_;
        const std::span<const Breakline> lines =
            marks.are_lines_enforced ? std::span(scene.lines) : std::span<const Breakline>();
        const tinwright::Triangulated made = tinwright::triangulate(scene.samples, lines, scene.options);
        if (marks.has_faces) {
            draw_faces(made.tin);
        }
        if (marks.are_lines_enforced && marks.has_faces) {
            draw_traces(made.tin, scene.lines);
            draw_vertices(made.tin, scene.samples.size());
        } else {
            for (const Point3& p : scene.samples) {
                draw_circle({p.x, p.y}, 2, "#222", "#222");
            }
            draw_lines(scene.lines, marks.has_line_points);
        }
        if (marks.has_conflicts) {
            draw_conflicts(made.report.lines.conflicts);
        }
        draw_text({0, -1.6}, caption, "start", "#222");
        return made.report;
    }

    void note(Point2 place, const std::string& text, const char* anchor = "start") {
        draw_text(place, text, anchor, "#222");
    }

    [[nodiscard]] std::string text() const {
        const double width = left_ + kScale * width_ + 2 * kMargin;
        const double height = kScale * height_ + 2 * kMargin + kCaption;
        std::ostringstream svg;
        svg << R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" << number(width) << ' '
            << number(height) << R"(" width=")" << number(width)
            << R"(" font-family="sans-serif" font-size="13">)"
            << "\n<title>" << title_ << "</title>\n"
            << R"(<rect width="100%" height="100%" fill="#fff"/>)" << '\n'
            << body_.str() << "</svg>\n";
        return svg.str();
    }

  private:
    static constexpr double kScale = 10;
    static constexpr double kMargin = 12;
    static constexpr double kGap = 20;
    static constexpr double kCaption = 22;

    [[nodiscard]] std::string x(Point2 p) const { return number(kMargin + left_ + kScale * p.x); }
    [[nodiscard]] std::string y(Point2 p) const { return number(kMargin + kScale * (height_ - p.y)); }
    static Point2 place(const Tin& tin, VertexId v) {
        const Point3 p = tin.position(v);
        return {p.x, p.y};
    }

    void draw_segment(Point2 a, Point2 b, const char* colour, double width, const char* more = "") {
        body_ << "<line x1=\"" << x(a) << "\" y1=\"" << y(a) << "\" x2=\"" << x(b) << "\" y2=\"" << y(b)
              << "\" stroke=\"" << colour << "\" stroke-width=\"" << number(width) << '"' << more << "/>\n";
    }

    void draw_circle(Point2 p, double radius, const char* fill, const char* stroke) {
        body_ << "<circle cx=\"" << x(p) << "\" cy=\"" << y(p) << "\" r=\"" << number(radius) << "\" fill=\""
              << fill << "\" stroke=\"" << stroke << "\"/>\n";
    }

    void draw_square(Point2 p, double half, const char* fill, const char* turn) {
        body_ << "<rect x=\"" << number(-half) << "\" y=\"" << number(-half) << "\" width=\""
              << number(2 * half) << "\" height=\"" << number(2 * half) << "\" fill=\"" << fill
              << "\" transform=\"translate(" << x(p) << ' ' << y(p) << ')' << turn << "\"/>\n";
    }

    void draw_text(Point2 p, const std::string& text, const char* anchor, const char* colour) {
        body_ << "<text x=\"" << x(p) << "\" y=\"" << y(p) << "\" fill=\"" << colour << "\" text-anchor=\""
              << anchor << "\">" << text << "</text>\n";
    }

    /// Lit from the north-west.
    static std::string shade(const Point3& a, const Point3& b, const Point3& c) {
        const Point3 u{b.x - a.x, b.y - a.y, b.z - a.z};
        const Point3 v{c.x - a.x, c.y - a.y, c.z - a.z};
        const Point3 normal{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
        const double length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
        const double light = (-0.5 * normal.x + 0.5 * normal.y + 0.707 * normal.z) / length;
        const double level = std::clamp(0.45 + 0.75 * (light - 0.35), 0.2, 1.0);
        std::array<char, 8> text{};
        std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(120 + 128 * level),
                      static_cast<unsigned>(128 + 122 * level), static_cast<unsigned>(105 + 125 * level));
        return text.data();
    }

    void draw_faces(const Tin& tin) {
        for (std::uint32_t slot = 0; slot < tin.mesh.slot_count(); ++slot) {
            if (!tin.mesh.is_terrain({slot})) {
                continue;
            }
            const auto corner = [&](unsigned i) { return tin.position(tin.mesh.vertex({slot}, i)); };
            body_ << "<polygon points=\"";
            for (const unsigned i : {0U, 1U, 2U}) {
                const Point2 p{corner(i).x, corner(i).y};
                body_ << (i > 0 ? " " : "") << x(p) << ',' << y(p);
            }
            body_ << "\" fill=\"" << shade(corner(0), corner(1), corner(2))
                  << "\" stroke=\"#777\" stroke-width=\"0.8\" stroke-linejoin=\"round\"/>\n";
        }
    }

    void draw_traces(const Tin& tin, std::span<const Breakline> lines) {
        for (const tinwright::LineTrace& trace : tin.traces) {
            draw_segment(place(tin, trace.a), place(tin, trace.b), colour_of(lines[trace.line].role), 2.5,
                         " stroke-linecap=\"round\"");
        }
    }

    void draw_vertices(const Tin& tin, std::size_t samples) {
        for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
            const Point2 p = place(tin, {v});
            const std::uint32_t from = tin.sample[v];
            if (from == Tin::kNoSample) {
                draw_circle(p, 3.2, "#fff", "#e06c00");
            } else if (from == Tin::kCrossing) {
                draw_square(p, 3.5, "#c2178c", " rotate(45)");
            } else if (from >= samples) {
                draw_square(p, 2.5, "#1f5fb4", "");
            } else {
                draw_circle(p, 2, "#222", "#222");
            }
        }
    }

    void draw_lines(std::span<const Breakline> lines, bool has_points) {
        for (const Breakline& line : lines) {
            for (std::size_t i = 0; i < line.points.size(); ++i) {
                const Point2 p{line.points[i].x, line.points[i].y};
                if (i > 0) {
                    draw_segment({line.points[i - 1].x, line.points[i - 1].y}, p, colour_of(line.role), 2,
                                 has_points ? "" : " stroke-dasharray=\"6 4\"");
                }
                if (has_points) {
                    draw_square(p, 2.5, "#1f5fb4", "");
                }
            }
        }
    }

    void draw_conflicts(std::span<const LineConflict> conflicts) {
        int count = 0;
        for (const LineConflict& conflict : conflicts) {
            const Point2 p{conflict.location.x + 0.5, conflict.location.y + 0.5};
            draw_text(p, std::to_string(++count), "start", "#c2178c");
        }
    }

    std::string title_;
    double width_;
    double height_;
    double left_ = 0;
    int panels_ = 0;
    std::ostringstream body_;
};

/// Samples in rough rows over width x height metres, on a slope with small bumps.
std::vector<Point3> rough_rows(double width, double height, double step, std::uint64_t seed) {
    Random random(seed);
    std::vector<Point3> samples;
    for (double y = 1; y < height; y += step) {
        for (double x = 1; x < width; x += step) {
            const auto place = [&](double at, double most) {
                const double moved = at + random.between(-0.3 * step, 0.3 * step);
                return std::round(10 * std::clamp(moved, 0.5, most - 0.5)) / 10;
            };
            const double east = place(x, width);
            const double north = place(y, height);
            samples.push_back({east, north, 0.1 * north + random.between(-0.2, 0.2)});
        }
    }
    return samples;
}

Breakline line(std::vector<Point3> points) {
    Breakline made;
    made.points = std::move(points);
    return made;
}

Breakline ring(LineRole role, std::uint32_t polygon, const std::vector<Point2>& corners) {
    Breakline made;
    made.role = role;
    made.polygon = polygon;
    for (const Point2 p : corners) {
        made.points.push_back({p.x, p.y, kDraped});
    }
    made.points.push_back(made.points.front());
    return made;
}

/// A closed ring of `corners` corners around a centre.
std::vector<Point2> around(Point2 centre, double radius, int corners) {
    std::vector<Point2> places;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners + 0.3;
        places.push_back({std::round(10 * (centre.x + radius * std::cos(angle))) / 10,
                          std::round(10 * (centre.y + radius * std::sin(angle))) / 10});
    }
    return places;
}

std::string draw_elevations() {
    Picture picture("A line with elevations of its own, and the same line draped", 30, 20);
    Scene scene;
    scene.samples = rough_rows(30, 20, 4, 3);
    scene.lines = {line({{2, 5, 4}, {9, 9, 4.5}, {16, 9.5, 5}, {22, 13, 5.5}, {28, 15, 5.5}})};
    picture.add("z=geometry: the surface follows the line", scene);
    for (Point3& p : scene.lines[0].points) {
        p.z = kDraped;
    }
    picture.add("z=drape: the line follows the surface", scene);
    return picture.text();
}

Scene conforming_scene() {
    Scene scene;
    scene.samples = rough_rows(24, 18, 3.2, 8);
    scene.lines = {line({{2, 4, 1}, {12, 10.3, 1.6}, {22, 11, 1.8}}), line({{12, 10.3, 1.6}, {20, 16.5, 2}})};
    return scene;
}

std::string draw_triangulations() {
    Picture picture("The same samples: Delaunay, constrained Delaunay, conforming Delaunay", 24, 18);
    Scene scene = conforming_scene();
    picture.add("Delaunay: edges cross the lines", scene, {.are_lines_enforced = false});
    picture.add("constrained: edges run along them", scene);
    scene.options.conforming.emplace();
    const auto report = picture.add("conforming", scene);
    picture.note({24, -1.6}, std::to_string(report.conforming->steiner_vertices) + " Steiner points", "end");
    return picture.text();
}

std::string draw_methods() {
    Picture picture("Steiner points of the two ways to conform", 24, 18);
    Scene scene = conforming_scene();
    for (const auto method : {tinwright::ConformingMethod::Split, tinwright::ConformingMethod::Blocking}) {
        scene.options.conforming.emplace();
        scene.options.conforming->method = method;
        const auto report =
            picture.add(method == tinwright::ConformingMethod::Split ? "split" : "blocking", scene);
        picture.note({24, -1.6}, std::to_string(report.conforming->steiner_vertices) + " Steiner points",
                     "end");
    }
    return picture.text();
}

std::string draw_polygons() {
    Picture picture("A boundary, a hole and an island in it", 34, 24);
    Scene scene;
    scene.samples = rough_rows(34, 24, 3.2, 5);
    scene.lines = {ring(LineRole::Boundary, 0, {{2, 3}, {30, 1.5}, {32, 14}, {24, 22.5}, {6, 21}}),
                   ring(LineRole::Hole, 1, around({16, 11.5}, 7, 9)),
                   ring(LineRole::Hole, 1, around({16.5, 11}, 3.2, 6))};
    picture.add("polygons as they came", scene, {.are_lines_enforced = false, .has_faces = false});
    picture.add("the domain", scene);
    return picture.text();
}

std::string draw_meetings() {
    Picture picture("Lines that cross, touch, overlap and cross themselves, before and after", 34, 24);
    Scene scene;
    scene.samples = rough_rows(34, 24, 4.4, 12);
    const auto z = [](double x, double y) { return 0.1 * y + 0.02 * x; };
    const auto on_slope = [&](const std::vector<Point2>& places) {
        std::vector<Point3> points;
        points.reserve(places.size());
        for (const Point2 p : places) {
            points.push_back({p.x, p.y, z(p.x, p.y)});
        }
        return line(points);
    };
    scene.lines = {on_slope({{2, 3}, {32, 9}}),
                   on_slope({{6, 11}, {14, 1}}),
                   on_slope({{22, 7}, {20, 15}}),
                   on_slope({{4, 17}, {18, 17}}),
                   on_slope({{10, 17}, {24, 17}, {26, 20}}),
                   on_slope({{24, 13}, {32, 19}, {31, 13}, {25, 18.5}})};
    Marks before;
    before.are_lines_enforced = false;
    before.has_faces = false;
    before.has_line_points = true;
    picture.add("lines as they came", scene, before);
    const auto report = picture.add("in the TIN", scene, {.has_conflicts = true});
    // Named by number in docs/breaklines.md.
    using Kind = LineConflict::Kind;
    const std::array kinds{Kind::Crossing, Kind::Overlap, Kind::Touch, Kind::Touch, Kind::SelfCrossing};
    const std::vector<LineConflict>& conflicts = report.lines.conflicts;
    if (!std::equal(conflicts.begin(), conflicts.end(), kinds.begin(), kinds.end(),
                    [](const LineConflict& conflict, Kind kind) { return conflict.kind == kind; })) {
        throw std::runtime_error("lines meet otherwise than the text says");
    }
    return picture.text();
}

std::string draw_drape_edge() {
    Picture picture("A draped boundary that goes beyond the samples", 34, 24);
    Scene scene;
    scene.samples = rough_rows(22, 16, 3.4, 9);
    for (Point3& p : scene.samples) {
        p.x += 6;
        p.y += 4;
    }
    scene.lines = {ring(LineRole::Boundary, 0, {{2, 8}, {20, 1}, {26, 6}, {32, 20}, {9, 18}})};
    picture.add("boundary and samples", scene, {.are_lines_enforced = false, .has_faces = false});
    picture.add("the domain: within both", scene);
    return picture.text();
}

std::string read_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

int run(const std::vector<std::string>& arguments) {
    const bool is_check = arguments.size() == 2 && arguments[0] == "--check";
    if (!is_check && arguments.size() != 1) {
        std::cerr << "usage: make_pictures [--check] FOLDER\n";
        return 2;
    }
    const std::vector<std::pair<std::string, std::string>> pictures{
        {"elevations", draw_elevations()}, {"triangulations", draw_triangulations()},
        {"methods", draw_methods()},       {"polygons", draw_polygons()},
        {"meetings", draw_meetings()},     {"drape_edge", draw_drape_edge()}};
    for (const auto& [name, text] : pictures) {
        const std::string path = arguments.back() + "/" + name + ".svg";
        if (is_check && read_text(path) != text) {
            throw std::runtime_error(path + " is not what the program draws; run make_pictures again");
        }
        if (!is_check) {
            std::ofstream out(path, std::ios::binary);
            if (!(out << text).flush()) {
                throw std::runtime_error("cannot write " + path);
            }
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const std::exception& error) {
        std::cerr << "make_pictures: " << error.what() << '\n';
        return 1;
    }
}
