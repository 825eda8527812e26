#ifndef TINWRIGHT_TOOLS_SAMPLE_GRAPH_HPP
#define TINWRIGHT_TOOLS_SAMPLE_GRAPH_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/io/write_graph.hpp"
#include "tinwright/mesh/tin.hpp"

#include "json_value.hpp"
#include "options_graph.hpp"

namespace tinwright::tools {

/// A graph of neighbours in figures; lengths in its norm.
struct GraphReport {
    std::string name;
    std::string norm;
    std::string unit;  ///< of the lengths
    std::size_t edges = 0;
    double longest = 0;
    double total_length = 0;
    double seconds = 0;
};

/// The edges of the graph of `tin`'s vertices as lines, in the library's order, each from the vertex of the
/// lower number, as long as in the graph's norm, under the Euclidean one on the ground. `tin`: Delaunay,
/// without constrained edges. Parallel inside the caller's task arena. Throws Cancelled.
std::vector<io::GraphLine> make_sample_graph(const Tin& tin, const GraphOptions& options,
                                             const GroundMeasures& ground, const Progress& progress);

/// Everything but the unit and the seconds.
GraphReport summarize(const std::vector<io::GraphLine>& lines, const GraphOptions& options);

/// The object `graph` of docs/json.md.
JsonValue graph_json(const GraphReport& report);
/// "rng, norm l2: 1234 edges, longest 56.7, together 8901.2 metre".
std::string graph_line(const GraphReport& report);

}  // namespace tinwright::tools

#endif
