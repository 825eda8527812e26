#ifndef TINWRIGHT_IO_WRITE_GRAPH_HPP
#define TINWRIGHT_IO_WRITE_GRAPH_HPP

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/write_tin.hpp"

namespace tinwright::io {

/// An edge of a graph of samples, to be written.
struct GraphLine {
    Point3 from;
    Point3 to;
    double length = 0;  ///< in the graph's norm, CRS units, or on the ground
};

struct WriteGraphOptions {
    std::string driver;  ///< GDAL's short name; empty: from the file's extension
    std::string layer_name = "graph";
    std::vector<std::string> creation_options;
    std::vector<std::string> layer_options;
    bool overwrite = false;
    TinMetadata metadata;
    Progress progress;
};

struct WrittenGraph {
    std::string driver;
    std::size_t features = 0;
    std::vector<std::string> warnings;
};

/// Checks, before any work is done, that the target's driver exists and keeps positions and elevations.
/// Throws UsageError naming the driver and what to use instead.
void check_graph_target(const std::string& target, const WriteGraphOptions& options);

/// Writes one `LINESTRING Z` of two points an edge, with the fields `id`, its place in the order given, and
/// `length`, under a temporary name. Same lines and options, same bytes. Throws UsageError, IoError,
/// Cancelled; leaves nothing behind then. O(n).
WrittenGraph write_graph(std::span<const GraphLine> lines, const Crs& crs, const std::string& target,
                         const WriteGraphOptions& options);

}  // namespace tinwright::io

#endif
