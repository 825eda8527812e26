// Draws the SVG pictures of docs/hydro.md: long profiles of the sample terrain's stream, and water between
// banks.
//   make_hydro_pictures TERRAIN.gpkg FOLDER          writes them
//   make_hydro_pictures --check TERRAIN.gpkg FOLDER  fails when the folder holds anything else
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <numbers>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/water/water.hpp"

namespace {

using tinwright::Breakline;
using tinwright::LineRole;
using tinwright::Point2;
using tinwright::Point3;
using tinwright::RiverFit;
using tinwright::Water;
using tinwright::WaterOptions;

std::string number(double value, int decimals = 1) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value + 0.0);
    return text.data();
}

/// A picture in its own units, y upward.
class Drawing {
  public:
    Drawing(std::string title, double width, double height, Point2 scale)
        : title_(std::move(title)), width_(width), height_(height), scale_(scale) {}

    void line(std::span<const Point2> points, const char* colour, double width, const char* more = "") {
        shape("polyline", points, "none", colour, width, more);
    }
    void area(std::span<const Point2> points, const char* fill, const char* colour) {
        shape("polygon", points, fill, colour, 1.2, "");
    }
    void dot(Point2 p, double radius, const char* colour) {
        body_ << "<circle cx=\"" << x(p) << "\" cy=\"" << y(p) << "\" r=\"" << number(radius) << "\" fill=\""
              << colour << "\"/>\n";
    }
    void text(Point2 p, const std::string& words, const char* anchor = "start", const char* colour = "#222") {
        body_ << "<text x=\"" << x(p) << "\" y=\"" << y(p) << "\" fill=\"" << colour << "\" text-anchor=\""
              << anchor << "\">" << words << "</text>\n";
    }
    [[nodiscard]] std::string svg() const {
        std::ostringstream out;
        const double width = scale_.x * width_ + 2 * kMargin;
        out << R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 )" << number(width) << ' '
            << number(scale_.y * height_ + 2 * kMargin) << R"(" width=")" << number(width)
            << R"(" font-family="sans-serif" font-size="13">)"
            << "\n<title>" << title_ << "</title>\n"
            << R"(<rect width="100%" height="100%" fill="#fff"/>)" << '\n'
            << body_.str() << "</svg>\n";
        return out.str();
    }

  private:
    static constexpr double kMargin = 16;

    [[nodiscard]] std::string x(Point2 p) const { return number(kMargin + scale_.x * p.x); }
    [[nodiscard]] std::string y(Point2 p) const { return number(kMargin + scale_.y * (height_ - p.y)); }

    void shape(const char* kind, std::span<const Point2> points, const char* fill, const char* colour,
               double width, const char* more) {
        body_ << '<' << kind << " points=\"";
        for (const Point2 p : points) {
            body_ << x(p) << ',' << y(p) << ' ';
        }
        body_ << R"(" fill=")" << fill << R"(" stroke=")" << colour << R"(" stroke-width=")" << number(width)
              << R"(" stroke-linejoin="round")" << more << "/>\n";
    }

    std::string title_;
    double width_;
    double height_;
    Point2 scale_;
    std::ostringstream body_;
};

/// Distance along a line and z.
std::vector<Point2> profile_of(const Breakline& line) {
    std::vector<Point2> profile;
    double chainage = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        const Point3& p = line.points[i];
        if (i > 0) {
            chainage += std::hypot(p.x - line.points[i - 1].x, p.y - line.points[i - 1].y);
        }
        profile.push_back({chainage, p.z});
    }
    return profile;
}

/// The stream below the lake, measured on a survey that does not know it.
std::string draw_profile(const std::string& terrain) {
    namespace io = tinwright::io;
    const std::array points{
        io::parse_source(terrain + ",layer=points,where=code IN ('GR',, 'RC',, 'RE',, 'TO')")};
    const std::array rivers{io::LineSource{
        io::parse_source(terrain + ",layer=breaklines,where=fid = 2,z=drape"), LineRole::River}};
    const io::Samples samples = io::read_samples(points);
    const io::Lines lines = io::read_lines(rivers);
    const auto fit = [&](const WaterOptions& options) {
        return profile_of(tinwright::level_water(samples.points, lines.lines, options).lines.front());
    };
    WaterOptions options;
    const std::vector<Point2> isotonic = fit(options);
    options.river_fit = RiverFit::Min;
    const std::vector<Point2> lowest = fit(options);
    options.river_fit = RiverFit::Isotonic;
    options.max_drop = 0.3;
    const std::vector<Point2> limited = fit(options);
    options.max_drop = 0;  // nothing may move: these are the elevations that were measured
    options.max_lift = 0;
    const std::vector<Point2> measured = fit(options);

    constexpr double kFloor = 426.2;
    constexpr double kTop = 429.6;
    const double length = measured.back().x;
    Drawing drawing("Levels of the stream below the lake", length + 24, kTop - kFloor, {2.6, 68});
    const auto place = [&](double chainage, double z) { return Point2{chainage + 18, z - kFloor}; };
    for (const double z : {427.0, 428.0, 429.0}) {
        const std::array grid{place(0, z), place(length, z)};
        drawing.line(grid, "#ddd", 1);
        drawing.text({0, z - kFloor - 0.05}, number(z, 0) + " m");
    }
    const auto draw = [&](std::vector<Point2> profile, const char* colour, double width,
                          const char* more = "") {
        for (Point2& p : profile) {
            p = place(p.x, p.y);
        }
        drawing.line(profile, colour, width, more);
    };
    draw(measured, "#888", 1.5);
    for (const Point2 p : measured) {
        drawing.dot(place(p.x, p.y), 2, "#888");
    }
    draw(limited, "#c2178c", 1.5, " stroke-dasharray=\"5 4\"");
    draw(lowest, "#e06c00", 2);
    draw(isotonic, "#1f5fb4", 2.5);
    const std::array legend{
        std::pair("#888", "as measured on the terrain"), std::pair("#1f5fb4", "--river-fit isotonic"),
        std::pair("#e06c00", "--river-fit min"), std::pair("#c2178c", "isotonic with --max-drop 0.3")};
    double z = 1.15;
    for (const auto& [colour, words] : legend) {
        drawing.text({24, z}, words, "start", colour);
        z -= 0.25;
    }
    drawing.text(place(length, kFloor + 0.1), number(length, 0) + " m downstream, heights 26 times enlarged",
                 "end");
    return drawing.svg();
}

constexpr double kReach = 64;  // metres of river drawn

/// A winding river; `side`: -1 and 1 are its banks.
Point3 river_place(double x, double side) {
    const double slope = 0.55 * std::cos(x / 9);
    const double length = std::sqrt(1 + slope * slope);
    const double half = 3.6 + 1.6 * std::exp(-(x - 34) * (x - 34) / 60) + 0.4 * std::sin(x / 3.1);
    const double y = 14 + 4.95 * std::sin(x / 9);
    const double z = 101.2 - 0.02 * x + 0.06 * std::sin(1.7 * x + 2 * side) + 0.05 * side;
    return {std::round(100 * (x - side * half * slope / length)) / 100,
            std::round(100 * (y + side * half / length)) / 100, std::round(100 * z) / 100};
}

std::vector<Breakline> banks() {
    Breakline outer;
    outer.role = LineRole::Bank;
    for (double x = 2; x <= kReach; x += 2) {
        outer.points.push_back(river_place(x, -1));
    }
    for (double x = kReach; x >= 2; x -= 2) {
        outer.points.push_back(river_place(x, 1));
    }
    outer.points.push_back(outer.points.front());
    Breakline island;
    island.role = LineRole::Bank;
    for (int i = 0; i < 12; ++i) {
        const double angle = 2 * std::numbers::pi * i / 12;
        const Point3 middle = river_place(34, 0);
        island.points.push_back(
            {std::round(100 * (middle.x + 3.4 * std::cos(angle))) / 100,
             std::round(100 * (middle.y + 1.5 * std::sin(angle) - 0.8 * std::cos(angle))) / 100, 100.5});
    }
    island.points.push_back(island.points.front());
    return {outer, island};
}

std::vector<Point2> flat(std::span<const Point3> points) {
    std::vector<Point2> places;
    for (const Point3& p : points) {
        places.push_back({p.x, p.y});
    }
    return places;
}

std::string draw_banks() {
    const std::vector<Breakline> lines = banks();
    const Water water = tinwright::level_water({}, lines);
    Drawing drawing("Sections of a river between its banks, and the middle of the water", 67, 28, {12, 12});
    drawing.area(flat(water.lines[0].points), "#d4e6f5", "#1f5fb4");
    drawing.area(flat(water.lines[1].points), "#fff", "#1f5fb4");
    std::size_t count = 0;
    for (const Breakline& line : water.lines) {
        if (line.role != LineRole::Section) {
            continue;
        }
        const std::vector<Point2> ends = flat(line.points);
        drawing.line(ends, "#777", 1);
        if (count++ % 5 == 0) {
            const Point2 upper = ends.front().y > ends.back().y ? ends.front() : ends.back();
            drawing.text({upper.x, upper.y + 0.5}, number(line.points.front().z, 2), "middle");
        }
    }
    for (const tinwright::Reach& reach : water.report.reaches) {
        drawing.line(flat(reach.points), "#d62728", 1.8, " stroke-dasharray=\"7 4\"");
    }
    for (const Breakline& line : lines) {
        for (const Point2 p : flat(line.points)) {
            drawing.dot(p, 2, "#1f5fb4");
        }
    }
    return drawing.svg();
}

std::string read_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

int run(std::vector<std::string> arguments) {
    const bool is_check = !arguments.empty() && arguments.front() == "--check";
    if (is_check) {
        arguments.erase(arguments.begin());
    }
    if (arguments.size() != 2) {
        std::cerr << "usage: make_hydro_pictures [--check] TERRAIN.gpkg FOLDER\n";
        return 2;
    }
    const std::vector<std::pair<std::string, std::string>> pictures{{"profile", draw_profile(arguments[0])},
                                                                    {"banks", draw_banks()}};
    for (const auto& [name, text] : pictures) {
        const std::string path = arguments[1] + "/" + name + ".svg";
        if (is_check && read_text(path) != text) {
            throw std::runtime_error(path + " is not what the program draws; run make_hydro_pictures again");
        }
        if (!is_check && !(std::ofstream(path, std::ios::binary) << text).flush()) {
            throw std::runtime_error("cannot write " + path);
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << "make_hydro_pictures: " << error.what() << '\n';
        return 1;
    }
}
