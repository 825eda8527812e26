#include "options_graph.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "option_values.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kGraphs =
    std::to_array<std::pair<std::string_view, GraphKind>>({{"mst", GraphKind::SpanningTree},
                                                           {"rng", GraphKind::RelativeNeighbors},
                                                           {"gabriel", GraphKind::Gabriel}});

}  // namespace

void GraphOptions::add_to(CLI::App& parser) {
    add_value(parser, "--graph", graph_text, "NAME", "write lines instead: mst|rng|gabriel");
}

void GraphOptions::finish(const std::string& norm_text) {
    kind.reset();
    norm = {};
    if (graph_text.empty()) {
        return;
    }
    kind = choice_value("--graph", graph_text, kGraphs);
    norm = norm_value(norm_text);
    if (kind == GraphKind::Gabriel && !norm.is_euclidean()) {
        throw UsageError("--graph gabriel is defined by Euclidean disks: --norm " + norm_text +
                         " is for --graph mst and rng");
    }
}

std::string GraphOptions::name() const { return kind ? choice_name(*kind, kGraphs) : std::string(); }

std::string GraphOptions::canonical() const { return "--graph " + name() + " --norm " + norm_name(norm); }

}  // namespace tinwright::tools
