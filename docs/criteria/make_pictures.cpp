// Draws the pictures of docs/criteria.md about the longest edge: small sets of samples and what the library
// makes of them, as SVG.
//   make_length_pictures FOLDER          writes them
//   make_length_pictures --check FOLDER  fails when the folder holds anything else than what would be written
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/optimal/expandable_edge.hpp"
#include "tinwright/optimal/incomplete_polygon.hpp"
#include "tinwright/optimal/min_max_length.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/optimal/wall_polygon.hpp"

namespace {

using tinwright::FaceId;
using tinwright::GraphEdge;
using tinwright::half_edge;
using tinwright::HalfEdgeId;
using tinwright::Norm;
using tinwright::Point2;
using tinwright::Tin;
using tinwright::TriangleMesh;
using tinwright::VertexId;
using tinwright::internal::WallPolygon;
using tinwright::internal::Walls;

constexpr const char* kInk = "#222";
constexpr const char* kBlue = "#1f5fb4";
constexpr const char* kRed = "#d62728";
constexpr const char* kGreen = "#2a9d3a";
constexpr const char* kGrey = "#aaa";

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

/// Places to a tenth in a rectangle, none very close to another.
std::vector<Point2> scattered(double width, double height, std::size_t count, double gap,
                              std::uint64_t seed) {
    Random random(seed);
    std::vector<Point2> places;
    while (places.size() < count) {
        const double x = std::round(random.between(5, 10 * width - 5)) / 10;
        const double y = std::round(random.between(5, 10 * height - 5)) / 10;
        const auto is_close = [&](Point2 p) { return std::hypot(p.x - x, p.y - y) < gap; };
        if (std::none_of(places.begin(), places.end(), is_close)) {
            places.push_back({x, y});
        }
    }
    return places;
}

/// Their Delaunay TIN.
Tin triangulated(std::span<const Point2> places) {
    std::vector<tinwright::Point3> samples;
    std::transform(places.begin(), places.end(), std::back_inserter(samples), [](Point2 p) {
        return tinwright::Point3{p.x, p.y, 0};
    });
    return tinwright::triangulate(samples).tin;
}

Point2 place(const Tin& tin, VertexId v) {
    const tinwright::Point3 p = tin.position(v);
    return {p.x, p.y};
}

double distance(Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); }
double distance(const Tin& tin, GraphEdge edge) { return distance(place(tin, edge.a), place(tin, edge.b)); }

/// Edges of the terrain, a < b, ascending.
std::vector<GraphEdge> edges_of(const TriangleMesh& mesh) {
    std::vector<GraphEdge> edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const auto [a, b] = std::minmax({mesh.origin(h), mesh.destination(h)});
            edges.push_back({a, b});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

bool has(std::span<const GraphEdge> sorted, GraphEdge edge) {
    return std::binary_search(sorted.begin(), sorted.end(), edge);
}

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", value + 0.0);
    return text.data();
}

/// Panels side by side.
class Picture {
  public:
    explicit Picture(std::string title) : title_(std::move(title)) {}

    /// Begins a panel for the places from `low` to (width, height) beyond it; `scale`: picture units a metre.
    void begin(const std::string& caption, Point2 low, double width, double height, double scale) {
        scale_ = scale;
        left_ = right_ + (right_ > 0 ? kGap : 0);
        right_ = left_ + scale_ * width;
        height_ = std::max(height_, scale_ * height);
        low_ = low;
        top_ = low.y + height;
        text({low.x, low.y - 18 / scale_}, caption, "start");
    }

    void segment(Point2 a, Point2 b, const char* colour, double width, const char* more = "") {
        body_ << "<line x1=\"" << x(a) << "\" y1=\"" << y(a) << "\" x2=\"" << x(b) << "\" y2=\"" << y(b)
              << "\" stroke=\"" << colour << "\" stroke-width=\"" << number(width)
              << R"(" stroke-linecap="round")" << more << "/>\n";
    }

    void dot(Point2 p, double radius = 2.5, const char* fill = kInk) {
        body_ << "<circle cx=\"" << x(p) << "\" cy=\"" << y(p) << "\" r=\"" << number(radius) << "\" fill=\""
              << fill << "\"/>\n";
    }

    void polygon(std::span<const Point2> corners, const char* fill, const char* stroke, double width) {
        body_ << "<polygon points=\"";
        for (std::size_t i = 0; i < corners.size(); ++i) {
            body_ << (i > 0 ? " " : "") << x(corners[i]) << ',' << y(corners[i]);
        }
        body_ << "\" fill=\"" << fill << "\" stroke=\"" << stroke << "\" stroke-width=\"" << number(width)
              << "\" stroke-linejoin=\"round\"/>\n";
    }

    /// Two arcs around each other's middle.
    void lune(Point2 a, Point2 b, const char* colour) {
        const double radius = distance(a, b);
        const double half = std::numbers::sqrt3 / 2;
        const Point2 middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
        const Point2 s{middle.x - half * (b.y - a.y), middle.y + half * (b.x - a.x)};
        const Point2 t{middle.x + half * (b.y - a.y), middle.y - half * (b.x - a.x)};
        const std::string arc = " A" + number(scale_ * radius) + ' ' + number(scale_ * radius) + " 0 0 1 ";
        body_ << "<path d=\"M" << x(s) << ' ' << y(s) << arc << x(t) << ' ' << y(t) << arc << x(s) << ' '
              << y(s) << "\" fill=\"" << colour << R"(" fill-opacity="0.12" stroke=")" << colour
              << "\" stroke-dasharray=\"4 3\"/>\n";
    }

    void text(Point2 p, const std::string& words, const char* anchor, const char* colour = kInk,
              bool is_letter = false) {
        body_ << "<text x=\"" << x(p) << "\" y=\"" << y(p) << "\" fill=\"" << colour << "\" text-anchor=\""
              << anchor << '"' << (is_letter ? " font-style=\"italic\"" : "") << '>' << words << "</text>\n";
    }

    [[nodiscard]] std::string text() const {
        const double width = right_ + 2 * kMargin;
        const double height = height_ + 2 * kMargin + kCaption;
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
    static constexpr double kMargin = 12;
    static constexpr double kGap = 24;
    static constexpr double kCaption = 14;

    [[nodiscard]] std::string x(Point2 p) const { return number(kMargin + left_ + scale_ * (p.x - low_.x)); }
    [[nodiscard]] std::string y(Point2 p) const { return number(kMargin + scale_ * (top_ - p.y)); }

    std::string title_;
    double scale_ = 1;
    double left_ = 0;
    double right_ = 0;
    double height_ = 0;
    Point2 low_{};
    double top_ = 0;
    std::ostringstream body_;
};

void draw_edges(Picture& picture, const Tin& tin, std::span<const GraphEdge> edges, const char* colour,
                double width) {
    for (const GraphEdge edge : edges) {
        picture.segment(place(tin, edge.a), place(tin, edge.b), colour, width);
    }
}

void draw_vertices(Picture& picture, const Tin& tin) {
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        picture.dot(place(tin, {v}));
    }
}

std::string draw_graphs() {
    Picture picture("Four graphs of the same samples, each in the next");
    const Tin tin = triangulated(scattered(20, 20, 48, 1.3, 5));
    std::vector<GraphEdge> tree = make_minimum_spanning_tree(tin.mesh, tin.keys);
    std::sort(tree.begin(), tree.end());
    const std::array<std::pair<const char*, std::vector<GraphEdge>>, 4> graphs{
        {{"minimum spanning tree", tree},
         {"relative neighbourhood graph", make_relative_neighborhood_graph(tin.mesh, tin.keys)},
         {"Gabriel graph", make_gabriel_graph(tin.mesh, tin.keys)},
         {"Delaunay triangulation", edges_of(tin.mesh)}}};
    std::span<const GraphEdge> former;
    for (const auto& [name, edges] : graphs) {
        picture.begin(name, {0, 0}, 20, 20, 11);
        for (const GraphEdge edge : edges) {
            const bool is_new = !former.empty() && !has(former, edge);
            picture.segment(place(tin, edge.a), place(tin, edge.b), is_new ? kRed : kBlue, 1.8);
        }
        if (!std::includes(edges.begin(), edges.end(), former.begin(), former.end())) {
            throw std::runtime_error("graphs are not nested");
        }
        draw_vertices(picture, tin);
        former = edges;
    }
    return picture.text();
}

/// Walls of a TIN and the polygons between them.
class Subdivision {
  public:
    explicit Subdivision(const Tin& tin)
        : tin_(tin), order_(tin.keys), in_graph_(mark_relative_neighbors(tin.mesh, tin.keys)) {
        const TriangleMesh& mesh = tin.mesh;
        walls_.is_wall = in_graph_;
        walls_.position.assign(in_graph_.size(), 0);
        std::vector<bool> is_seen(mesh.slot_count());
        for_each_half_edge([&](HalfEdgeId h) {
            if (mesh.is_border(h)) {
                walls_.is_wall[h.value] = 1;
            }
        });
        for_each_half_edge([&](HalfEdgeId h) {
            if (walls_.is_wall[h.value] != 0 && !is_seen[face_of(h).value]) {
                const WallPolygon polygon = trace(h);
                for (const FaceId face : polygon.faces()) {
                    is_seen[face.value] = true;
                }
                walls_of_polygons_.push_back(h);
            }
        });
    }

    [[nodiscard]] std::span<const HalfEdgeId> polygons() const { return walls_of_polygons_; }
    [[nodiscard]] bool is_wall(HalfEdgeId h) const { return walls_.is_wall[h.value] != 0; }
    WallPolygon trace(HalfEdgeId wall) {
        WallPolygon polygon(tin_.mesh, order_, walls_);
        polygon.trace(wall);
        return polygon;
    }
    /// Whether a side is not in the graph: without constrained edges it is then long.
    [[nodiscard]] bool is_incomplete(const WallPolygon& polygon) const {
        for (std::uint32_t i = 0; i < polygon.size(); ++i) {
            if (in_graph_[polygon.side(i).value] == 0) {
                return true;
            }
        }
        return false;
    }

  private:
    template <class Visitor>
    void for_each_half_edge(Visitor visitor) const {
        for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && tin_.mesh.is_terrain({f}); ++i) {
                visitor(half_edge({f}, i));
            }
        }
    }

    const Tin& tin_;
    tinwright::LengthOrder order_;
    std::vector<std::uint8_t> in_graph_;
    Walls walls_;
    std::vector<HalfEdgeId> walls_of_polygons_;
};

void draw_faces(Picture& picture, const Tin& tin, const WallPolygon& polygon, const char* colour) {
    for (const FaceId face : polygon.faces()) {
        std::array<Point2, 3> corners{};
        for (unsigned i = 0; i < 3; ++i) {
            corners.at(i) = place(tin, tin.mesh.vertex(face, i));
        }
        picture.polygon(corners, colour, colour, 0.7);
    }
}

void draw_walls(Picture& picture, const Tin& tin, const Subdivision& subdivision) {
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (subdivision.is_wall(h)) {
                picture.segment(place(tin, tin.mesh.origin(h)), place(tin, tin.mesh.destination(h)), kBlue,
                                1.8);
            }
        }
    }
}

/// The faces that the two ends of a divided polygon's edge lead to, drawn.
void draw_division(Picture& picture, const Tin& tin, WallPolygon& polygon) {
    std::vector<GraphEdge> pairs;
    for (std::uint32_t a = 0; a < tin.vertex_count(); ++a) {
        for (std::uint32_t b = a + 1; b < tin.vertex_count(); ++b) {
            pairs.push_back({{a}, {b}});
        }
    }
    const auto [nearest, farthest] =
        std::minmax_element(pairs.begin(), pairs.end(),
                            [&](GraphEdge x, GraphEdge y) { return distance(tin, x) < distance(tin, y); });
    const auto poll = [] { return true; };
    const auto best = tinwright::internal::ExpandableEdgeSearch(polygon)
                          .find_among_many({nearest->a, nearest->b}, {farthest->a, farthest->b}, poll)
                          .value();
    std::vector<tinwright::CavityFace> faces;
    tinwright::internal::IncompletePolygon parts(polygon);
    if (!parts.triangulate(best.low, best.high, {}, faces, poll)) {
        throw std::runtime_error("one part has no face");
    }
    const std::size_t other = faces.size();
    if (!parts.triangulate(best.high, best.low, tinwright::CavityFace::Across::inner(0, 2), faces, poll)) {
        throw std::runtime_error("the other part has no face");
    }
    for (const tinwright::CavityFace& face : faces) {
        for (unsigned i = 0; i < 3; ++i) {
            picture.segment(place(tin, face.vertex.at(i)), place(tin, face.vertex.at((i + 1) % 3)), kGrey,
                            1.2);
        }
    }
    const Point2 p = place(tin, polygon.vertex(best.low));
    const Point2 q = place(tin, polygon.vertex(best.high));
    const Point2 r = place(tin, faces[0].vertex[1]);
    const Point2 s = place(tin, faces[other].vertex[1]);
    picture.lune(p, q, kRed);
    for (const Point2 apex : {r, s}) {
        picture.segment(p, apex, kGreen, 2.2);
        picture.segment(apex, q, kGreen, 2.2);
    }
    for (std::uint32_t i = 0; i < polygon.size(); ++i) {
        const Point2 a = place(tin, polygon.vertex(i));
        picture.segment(a, place(tin, polygon.vertex(polygon.after(i))), kBlue, 1.8);
        picture.dot(a);
    }
    picture.segment(p, q, kRed, 2.6);
    const std::array<std::pair<const char*, Point2>, 4> letters{{{"p", p}, {"q", q}, {"r", r}, {"s", s}}};
    const Point2 middle{(p.x + q.x) / 2, (p.y + q.y) / 2};
    for (const auto& [letter, at] : letters) {
        const double away = 0.4 / distance(middle, at);
        picture.text({at.x + away * (at.x - middle.x), at.y + away * (at.y - middle.y) - 0.1}, letter,
                     "middle", kInk, true);
    }
}

std::string draw_polygons() {
    Picture picture("What the relative neighbourhood graph and the hull leave open");
    const Tin tin = triangulated(scattered(20, 15, 44, 1.1, 28));
    Subdivision subdivision(tin);
    picture.begin("walls; polygons: complete (green), incomplete (orange)", {0, 0}, 20, 15, 20);
    std::optional<WallPolygon> largest;
    for (const HalfEdgeId wall : subdivision.polygons()) {
        const WallPolygon polygon = subdivision.trace(wall);
        const bool is_incomplete = subdivision.is_incomplete(polygon);
        if (polygon.size() > 3) {
            draw_faces(picture, tin, polygon, is_incomplete ? "#fbe3c4" : "#d8eed6");
        }
        if (!is_incomplete && (!largest || polygon.size() > largest->size())) {
            largest = polygon;
        }
    }
    draw_walls(picture, tin, subdivision);
    draw_vertices(picture, tin);

    WallPolygon polygon = subdivision.trace(largest.value().side(0));
    Point2 low{1e9, 1e9};
    Point2 high{-1e9, -1e9};
    for (std::uint32_t i = 0; i < polygon.size(); ++i) {
        const Point2 p = place(tin, polygon.vertex(i));
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double side = std::max(high.x - low.x, high.y - low.y) + 2.6;
    picture.begin("the largest complete one, its edge pq",
                  {(low.x + high.x - side) / 2, (low.y + high.y - side) / 2}, side, side, 300 / side);
    draw_division(picture, tin, polygon);
    return picture.text();
}

/// The longest edge in red, and its length.
void draw_longest(Picture& picture, const Tin& tin, Point2 note) {
    const std::vector<GraphEdge> edges = edges_of(tin.mesh);
    const GraphEdge longest = *std::max_element(edges.begin(), edges.end(), [&](GraphEdge x, GraphEdge y) {
        return distance(tin, x) < distance(tin, y);
    });
    draw_edges(picture, tin, edges, kBlue, 1.8);
    for (const GraphEdge edge : edges) {
        if (distance(tin, edge) > distance(tin, longest) - 0.005) {
            picture.segment(place(tin, edge.a), place(tin, edge.b), kRed, 2.6);
        }
    }
    draw_vertices(picture, tin);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", distance(tin, longest));
    picture.text(note, text.data(), "end", kRed);
}

void minimize(Tin& tin) {
    tinwright::OptimizeOptions options;
    options.criterion = tinwright::Criterion::Length;
    if (minimize_longest_edge(tin, options).proof != tinwright::Proof::Theorem) {
        throw std::runtime_error("no proof");
    }
}

std::string draw_longest_edge() {
    Picture picture("The longest edges of triangulations");
    // An equilateral triangle, and a fourth sample just inside its circle, of radius 5.
    Tin tin = triangulated(std::array<Point2, 4>{Point2{0.5, 5.5}, {8, 1.17}, {8, 9.83}, {10.4, 5.5}});
    picture.begin("Delaunay", {0, 0}, 11, 11, 18);
    draw_longest(picture, tin, {11, 10.3});
    picture.begin("min-max length", {0, 0}, 11, 11, 18);
    minimize(tin);
    draw_longest(picture, tin, {11, 10.3});

    // As in [tan1993, Fig. 5.2].
    const Point2 x{1.9, 2.5};
    const Point2 y{9.1, 2.5};
    const Point2 z{5.5, 10.5};
    const Point2 u{1.3, 6.8};
    const Point2 v{5.5, 0.5};
    const Point2 w{9.7, 6.8};
    const std::array rows{distance(x, y), distance(u, v), distance(w, u),
                          distance(y, z), distance(u, y), distance(z, v)};
    if (!std::is_sorted(rows.begin(), rows.end(), std::less_equal<>())) {
        throw std::runtime_error("the six samples are no trap");
    }
    tin = triangulated(std::array{x, y, z, u, v, w});
    minimize(tin);
    picture.begin("caught: xy, yz, zx", {0, 0}, 11, 11, 18);
    const std::array ring{x, v, y, w, z, u};
    for (std::size_t i = 0; i < ring.size(); ++i) {
        picture.segment(ring.at(i), ring.at((i + 1) % ring.size()), kBlue, 1.8);
    }
    const char* dashed = " stroke-dasharray=\"6 4\"";
    picture.segment(x, y, kBlue, 1.8, dashed);
    picture.segment(y, z, kRed, 2.6, dashed);
    picture.segment(z, x, kRed, 2.6, dashed);
    draw_vertices(picture, tin);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", distance(y, z));
    picture.text({11, 10.3}, text.data(), "end", kRed);
    picture.begin("min-max length: uv, vw, wu", {0, 0}, 11, 11, 18);
    draw_longest(picture, tin, {11, 10.3});
    const std::array<std::pair<const char*, Point2>, 6> letters{{{"x", {1.3, 1.9}},
                                                                 {"y", {9.7, 1.9}},
                                                                 {"z", {5.5, 10.8}},
                                                                 {"u", {0.7, 6.6}},
                                                                 {"v", {6.2, 0}},
                                                                 {"w", {10.3, 6.6}}}};
    for (const auto& [letter, at] : letters) {
        picture.text(at, letter, "middle", kInk, true);
        picture.text({at.x - 11 - 24 / 18.0, at.y}, letter, "middle", kInk, true);
    }
    return picture.text();
}

/// Where a direction meets the circle of radius 1.
Point2 on_unit_circle(Norm norm, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double x = std::fabs(c);
    const double y = std::fabs(s);
    double size = std::max(x, y);
    if (!norm.is_maximum()) {
        size = norm.power() == 1 ? x + y : std::hypot(x, y);
    }
    return {c / size, s / size};
}

std::string draw_norms() {
    Picture picture("Relative neighbourhood graphs in three norms");
    const Tin tin = triangulated(scattered(20, 20, 48, 1.3, 5));
    const std::vector<GraphEdge> euclidean =
        make_relative_neighborhood_graph(tin.mesh, tin.keys, Norm(), tinwright::LuneRim::Ordered);
    for (const Norm norm : {Norm(), Norm::lp(1), Norm::maximum()}) {
        picture.begin(norm_name(norm), {0, -3}, 20, 23, 13);
        std::vector<Point2> circle;
        constexpr int kSteps = 72;
        for (int i = 0; i < kSteps; ++i) {
            const Point2 p = on_unit_circle(norm, 2 * std::numbers::pi * i / kSteps);
            circle.push_back({10 + 1.7 * p.x, -2.2 + 1.7 * p.y});
        }
        picture.polygon(circle, "#eef3f8", kInk, 1.2);
        const std::vector<GraphEdge> edges =
            make_relative_neighborhood_graph(tin.mesh, tin.keys, norm, tinwright::LuneRim::Ordered);
        for (const GraphEdge edge : euclidean) {
            if (!has(edges, edge)) {
                picture.segment(place(tin, edge.a), place(tin, edge.b), kGrey, 1.2,
                                " stroke-dasharray=\"4 4\"");
            }
        }
        for (const GraphEdge edge : edges) {
            picture.segment(place(tin, edge.a), place(tin, edge.b), has(euclidean, edge) ? kBlue : kRed, 1.8);
        }
        draw_vertices(picture, tin);
    }
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
        std::cerr << "usage: make_length_pictures [--check] FOLDER\n";
        return 2;
    }
    const std::vector<std::pair<std::string, std::string>> pictures{{"graphs", draw_graphs()},
                                                                    {"polygons", draw_polygons()},
                                                                    {"longest_edge", draw_longest_edge()},
                                                                    {"norms", draw_norms()}};
    for (const auto& [name, text] : pictures) {
        const std::string path = arguments.back() + "/" + name + ".svg";
        if (is_check && read_text(path) != text) {
            throw std::runtime_error(path + " is not what the program draws; run make_length_pictures again");
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
        std::cerr << "make_length_pictures: " << error.what() << '\n';
        return 1;
    }
}
