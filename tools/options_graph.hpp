#ifndef TINWRIGHT_TOOLS_OPTIONS_GRAPH_HPP
#define TINWRIGHT_TOOLS_OPTIONS_GRAPH_HPP

#include <cstdint>
#include <optional>
#include <string>

#include "tinwright/geometry/norm.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// Graphs of neighbours, which are written instead of a TIN.
enum class GraphKind : std::uint8_t { SpanningTree, RelativeNeighbors, Gabriel };

struct GraphOptions {
    std::string graph_text;  ///< empty: a TIN

    // After `finish`:
    std::optional<GraphKind> kind;
    Norm norm;

    void add_to(CLI::App& parser);
    /// `norm_text`: that of --norm. Throws UsageError, also for a norm that the graph does not know.
    void finish(const std::string& norm_text);

    /// "mst", "rng" or "gabriel".
    [[nodiscard]] std::string name() const;
    /// The options that say which graph it is: what outputs record.
    [[nodiscard]] std::string canonical() const;
};

}  // namespace tinwright::tools

#endif
