#include "sample_graph.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "tinwright/delaunay/proximity_graphs.hpp"

#include "criterion_report.hpp"

namespace tinwright::tools {

namespace {

std::vector<GraphEdge> make_edges(const Tin& tin, const GraphOptions& options, const Progress& progress) {
    switch (options.kind.value_or(GraphKind::SpanningTree)) {
        case GraphKind::RelativeNeighbors:
            return make_relative_neighborhood_graph(tin.mesh, tin.keys, options.norm, LuneRim::Outside,
                                                    progress);
        case GraphKind::Gabriel:
            return make_gabriel_graph(tin.mesh, tin.keys);
        case GraphKind::SpanningTree:
            break;
    }
    return options.norm.is_euclidean()
               ? make_minimum_spanning_tree(tin.mesh, tin.keys)
               : make_minimum_spanning_tree(tin.mesh, tin.keys, options.norm, progress);
}

std::string length_text(double length) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.6g", length);
    return text.data();
}

}  // namespace

std::vector<io::GraphLine> make_sample_graph(const Tin& tin, const GraphOptions& options,
                                             const GroundMeasures& ground, const Progress& progress) {
    const bool is_on_ground = ground.is_geodesic() && options.norm.is_euclidean();
    std::vector<io::GraphLine> lines;
    for (const GraphEdge& edge : make_edges(tin, options, progress)) {
        io::GraphLine& line = lines.emplace_back();
        line.from = tin.position(edge.a);
        line.to = tin.position(edge.b);
        line.length = is_on_ground
                          ? ground.length({line.from.x, line.from.y}, {line.to.x, line.to.y})
                          : tin.lattice.quantum() * length(options.norm, tin.key(edge.a), tin.key(edge.b));
    }
    return lines;
}

GraphReport summarize(const std::vector<io::GraphLine>& lines, const GraphOptions& options) {
    GraphReport report;
    report.name = options.name();
    report.norm = norm_name(options.norm);
    report.edges = lines.size();
    for (const io::GraphLine& line : lines) {
        report.longest = std::max(report.longest, line.length);
        report.total_length += line.length;
    }
    return report;
}

JsonValue graph_json(const GraphReport& report) {
    return JsonValue::object()
        .set("name", report.name)
        .set("norm", report.norm)
        .set("edges", report.edges)
        .set("longest", report.longest)
        .set("total_length", report.total_length)
        .set("unit", report.unit);
}

std::string graph_line(const GraphReport& report) {
    const std::string unit = report.unit == kUnknownLengthUnit ? std::string() : " " + report.unit;
    return report.name + ", norm " + report.norm + ": " + std::to_string(report.edges) +
           (report.edges == 1 ? " edge" : " edges") + ", longest " + length_text(report.longest) + unit +
           ", together " + length_text(report.total_length) + unit;
}

}  // namespace tinwright::tools
