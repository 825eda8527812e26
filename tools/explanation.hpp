#ifndef TINWRIGHT_TOOLS_EXPLANATION_HPP
#define TINWRIGHT_TOOLS_EXPLANATION_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/products.hpp"

#include "json_value.hpp"
#include "options_interpolation.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

/// Where something came from: a source as the user named it, or where only its number is known that, and the
/// feature in it.
struct Provenance {
    SourceName source;          ///< `file "a.gpkg", layer "p"`; empty: not known
    std::int32_t number = 0;    ///< as in TIN files, from 1; 0: not known
    std::int64_t feature = -1;  ///< feature id, line of a text, cell of a raster; -1: not known
};

struct ExplainedVertex {
    VertexId vertex{};
    Point3 position{};
    std::string kind;  ///< "sample", "line vertex", "crossing" or "Steiner point"
    Provenance from;
};

/// A line that runs along an edge.
struct ExplainedLine {
    std::string role;
    bool is_sharp = true;
    Provenance from;
};

struct ExplainedEdge {
    VertexId a{};
    VertexId b{};
    double length = 0;  ///< on the ground
    bool is_constrained = false;
    bool is_border = false;
    bool is_sharp = false;  ///< smooth interpolators may have a crease there
    /// Whether the circles through the faces on both sides are empty of each other's third vertex; nothing on
    /// the border.
    std::optional<bool> is_delaunay;
    std::vector<ExplainedLine> lines;
};

/// The longest edge of a face of a TIN that was made for length.
struct ExplainedLength {
    std::size_t edge = 0;  ///< of `Explanation::edges`; of equal ones the first
    double of_tin = 0;     ///< longest edge of the whole TIN as it is here, in the plane
    double told = 0;       ///< the edge's length for people: Euclidean ones on the ground
    double of_tin_told = 0;
    std::string unit;  ///< of what is told
};

struct ExplainedMethod {
    std::string name;
    SurfaceReading reading;
    std::vector<VertexWeight> weights;  ///< largest first
};

/// Why a surface is as it is at one place.
struct Explanation {
    Point2 asked{};
    double quantum = 0;  ///< vertices lie at multiples of it, CRS units of the plane
    double step = 0;     ///< the place was rounded to multiples of this
    bool is_inside = false;
    ExplainedVertex nearest;  ///< vertex that was given, rather than made
    double nearest_distance = 0;
    std::optional<double> breakline_distance;

    // Inside only:
    std::uint32_t face = 0;  ///< number as in TIN files
    std::array<ExplainedVertex, 3> corners;
    std::array<ExplainedEdge, 3> edges;  ///< from each corner to the next
    std::string made_by;                 ///< a sentence
    std::optional<double> measure;       ///< of the face under the TIN's criterion
    std::optional<ExplainedLength> length;
    std::vector<ExplainedMethod> methods;
};

struct ExplainOptions {
    Point2 at{};                               ///< as given
    Point2 in_plane{};                         ///< the same in the surface's plane
    io::Crs place_crs;                         ///< of `at`, and of locations that are told
    const InterpolationChoice& interpolation;  ///< options of methods, for the one it names
    SlopeUnit slope_unit = SlopeUnit::Degree;
    int threads = 0;
};

/// Parallel inside the caller's task arena. Throws InputError for a surface without vertices.
Explanation explain(const Surface& surface, const ExplainOptions& options);

/// For people.
std::string explanation_text(const Explanation& explanation, const Surface& surface,
                             const ExplainOptions& options);
/// The object `explanation` of the JSON report.
JsonValue explanation_json(const Explanation& explanation, const Surface& surface,
                           const ExplainOptions& options);

}  // namespace tinwright::tools

#endif
