#ifndef TINWRIGHT_IO_WRITE_GRAPH_HPP
#define TINWRIGHT_IO_WRITE_GRAPH_HPP

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"

namespace tinwright::io {

/// An edge of a graph of samples, to be written.
struct GraphLine {
    Point3 from;
    Point3 to;
    double length = 0;  ///< in the graph's norm, CRS units
};

struct WriteGraphOptions {
    std::string driver;                         ///< empty: from the extension
    std::string layer_name;                     ///< empty: "graph"
    std::vector<std::string> creation_options;  ///< KEY=VALUE
    std::vector<std::string> layer_options;     ///< KEY=VALUE
    bool overwrite = false;
    std::vector<std::pair<std::string, std::string>> metadata;  ///< of the layer, where the format keeps any
    Progress progress;
};

/// Writes lines of two points (LineString Z) in their order, with a field `length`. Same lines, same bytes.
/// Drivers that lose z are refused, as in `write_tin`. Returns the driver's name.
/// Throws IoError, UsageError; leaves nothing behind then. O(n).
std::string write_graph(std::span<const GraphLine> lines, const Crs& crs, const std::string& target,
                        const WriteGraphOptions& options);
/// Throws what `write_graph` would for the target and options, before there is anything to write.
void check_graph_target(const std::string& target, const WriteGraphOptions& options);

}  // namespace tinwright::io

#endif
