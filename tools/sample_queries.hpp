#ifndef TINWRIGHT_TOOLS_SAMPLE_QUERIES_HPP
#define TINWRIGHT_TOOLS_SAMPLE_QUERIES_HPP

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"

#include "options_sample.hpp"

namespace tinwright::tools {

/// Where something asked about came from.
struct QueryId {
    std::int64_t source = 1;  ///< number of its --at, from 1
    std::int64_t feature =
        0;  ///< feature id, line of a text, or cell of a raster; of an X,Y the source again
};

/// What --at names, in the surface's plane and the order of the command line: points or lines.
struct Queries {
    std::vector<Point2> points;
    std::vector<QueryId> point_ids;
    std::vector<std::optional<Point2>> given;  ///< one a point: as the command line has it; empty of a file
    std::vector<std::vector<Point2>> lines;
    std::vector<QueryId> line_ids;
    std::vector<std::string> warnings;  ///< one line each
};

/// Whether lines are asked about. Opens every source, so that a file that is not there is found before any
/// work is done. Throws IoError; UsageError for points and lines at once.
bool are_lines(std::span<const Whereabouts> at);

struct QueryOptions {
    io::Crs crs;         ///< the surface's plane, may be unknown
    io::Crs place_crs;   ///< of positions on the command line
    io::Crs source_crs;  ///< of sources that carry none; unknown: `place_crs`
    bool skip_bad = false;
    int threads = 0;
    Progress progress;
};

/// A position on the command line, brought to the plane. Throws InputError where it is none of the plane.
Point2 place_in_plane(Point2 position, const io::Crs& place_crs, const io::Crs& plane);

/// Reads them; elevations that they have do not matter. Throws what `read_samples` and `read_lines` do, and
/// InputError for a position that is none of the plane.
Queries read_queries(std::span<const Whereabouts> at, bool lines, const QueryOptions& options);

}  // namespace tinwright::tools

#endif
