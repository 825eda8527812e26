#include "sample_queries.hpp"

#include <cmath>
#include <memory>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"

namespace tinwright::tools {

namespace {

/// The sources, and the number of the --at that each one is.
struct NumberedSources {
    std::vector<io::Source> sources;
    std::vector<std::int64_t> numbers;
};

NumberedSources numbered_sources(std::span<const Whereabouts> at) {
    NumberedSources numbered;
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (const auto* const source = std::get_if<io::Source>(&at[i])) {
            numbered.sources.push_back(*source);
            numbered.numbers.push_back(static_cast<std::int64_t>(i) + 1);
        }
    }
    return numbered;
}

/// Stands for "no elevation is asked for": a constant that all sources take but rasters, which have their
/// own.
constexpr const char* kAnyElevation = "0.0";

using SourceKind = io::OpenedSource::Kind;

/// A stream can be read only once, so nobody looks into it first.
bool is_stream(const io::Source& source) {
    return source.path == "-" || source.path.find("/vsistdin") != std::string::npos;
}

SourceKind kind_of(const io::Source& source) {
    return is_stream(source) ? SourceKind::Text : io::open_source(source).kind;
}

/// Whether a text that would be read as rows of numbers has lines instead, as WKT.
bool is_text_of_lines(const io::Source& source) {
    const bool is_for_samples = source.vertices || source.x_field || source.y_field || is_stream(source) ||
                                source.format != io::Source::Format::Auto;
    if (is_for_samples || kind_of(source) != SourceKind::Text) {
        return false;
    }
    const io::GdalMessages messages;
    try {
        const io::OpenedSource opened = io::open_line_source(source);
        for (OGRLayer* const layer : opened.dataset->GetLayers()) {
            const std::unique_ptr<OGRFeature> feature(layer->GetNextFeature());
            const OGRGeometry* const geometry = feature ? feature->GetGeometryRef() : nullptr;
            if (geometry != nullptr && geometry->getDimension() > 0) {
                return true;
            }
        }
    } catch (const Error&) {
        return false;  // rows of numbers, which are no vector file
    }
    return false;
}

/// A surface of which nobody knows where it is takes the system of what is asked about, unless that is
/// degrees.
void guess_surface_crs(const io::WorkingPlane& plane, const QueryOptions& options, Queries& queries) {
    const io::Crs& crs = plane.crs;
    if (crs.is_known() && !options.crs.is_known()) {
        if (plane.is_source_geographic()) {
            throw InputError("the surface has no CRS, and what --at names is in longitude and latitude, " +
                             plane.source_crs.name() + ": assign the surface's with --source-crs");
        }
        queries.warnings.push_back("the surface has no CRS; taken to be in " + crs.name() +
                                   " as what --at names");
    }
}

/// Of sources that carry none: what is said, else that of positions, where that is another than the plane's,
/// which is taken anyway.
io::Crs crs_of_bare_sources(const QueryOptions& options) {
    const bool is_other =
        options.place_crs.is_known() && !options.place_crs.is_same_horizontally(options.crs);
    return options.source_crs.is_known() || !is_other ? options.source_crs : options.place_crs;
}

void read_points(std::span<const Whereabouts> at, const QueryOptions& options, Queries& queries) {
    NumberedSources numbered = numbered_sources(at);
    io::Samples samples;
    if (!numbered.sources.empty()) {
        for (io::Source& source : numbered.sources) {
            if (kind_of(source) == SourceKind::Raster) {
                source.z.reset();
            } else {
                source.z = kAnyElevation;
            }
        }
        io::ReadOptions read;
        read.skip_bad = options.skip_bad;
        read.crs = options.crs.horizontal();
        read.source_crs = crs_of_bare_sources(options);
        read.threads = options.threads;
        read.progress = options.progress;
        samples = io::read_samples(numbered.sources, read);
        queries.warnings = samples.warnings;
        guess_surface_crs(samples.plane, options, queries);
    }
    auto slice = samples.slices.begin();
    for (std::size_t i = 0; i < at.size(); ++i) {
        const auto number = static_cast<std::int64_t>(i) + 1;
        if (const auto* const position = std::get_if<Point2>(&at[i])) {
            queries.points.push_back(place_in_plane(*position, options.place_crs, options.crs));
            queries.given.emplace_back(*position);
            queries.point_ids.push_back({number, number});
            continue;
        }
        for (; slice != samples.slices.end() && numbered.numbers[slice->source] == number; ++slice) {
            for (std::size_t k = 0; k < slice->count; ++k) {
                const Point3& point = samples.points[slice->first + k];
                queries.points.push_back({point.x, point.y});
                queries.given.emplace_back();
                queries.point_ids.push_back({number, slice->id(k)});
            }
        }
    }
}

void read_profile_lines(std::span<const Whereabouts> at, const QueryOptions& options, Queries& queries) {
    const NumberedSources numbered = numbered_sources(at);
    std::vector<io::LineSource> sources;
    for (const io::Source& source : numbered.sources) {
        sources.push_back({source, LineRole::Breakline});
        sources.back().source.z = "drape";
    }
    io::ReadLinesOptions read;
    read.skip_bad = options.skip_bad;
    read.crs = options.crs.horizontal();
    read.source_crs = crs_of_bare_sources(options);
    read.progress = options.progress;
    const io::Lines lines = io::read_lines(sources, read);
    queries.warnings = lines.warnings;
    guess_surface_crs(lines.plane, options, queries);
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
        std::vector<Point2>& line = queries.lines.emplace_back();
        for (const Point3& point : lines.lines[i].points) {
            line.push_back({point.x, point.y});
        }
        queries.line_ids.push_back({numbered.numbers[lines.slice_of(i).source], lines.parts[i].feature});
    }
}

}  // namespace

Point2 place_in_plane(Point2 position, const io::Crs& place_crs, const io::Crs& plane) {
    if (!place_crs.is_known() || !plane.is_known() || place_crs.is_same_horizontally(plane)) {
        return position;
    }
    Point2 placed = position;
    io::CoordinateTransform(place_crs.horizontal(), plane.horizontal()).forward(std::span(&placed, 1));
    if (!std::isfinite(placed.x) || !std::isfinite(placed.y)) {
        throw InputError("the position " + decimal_text(position.x) + "," + decimal_text(position.y) +
                         " cannot be transformed from " + place_crs.name() + " to " + plane.name() +
                         ": positions are in " + place_crs.name());
    }
    return placed;
}

bool are_lines(std::span<const Whereabouts> at) {
    const Whereabouts* with_points = nullptr;
    const io::Source* with_lines = nullptr;
    for (const Whereabouts& where : at) {
        const auto* const source = std::get_if<io::Source>(&where);
        if (source != nullptr && (io::has_lines(*source) || is_text_of_lines(*source))) {
            with_lines = source;
        } else {
            with_points = &where;
        }
    }
    if (with_lines != nullptr && with_points != nullptr) {
        throw UsageError("--at takes points or lines at a time: " + io::quoted(with_lines->path) +
                         " has lines, and others are points; use two commands");
    }
    return with_lines != nullptr;
}

Queries read_queries(std::span<const Whereabouts> at, bool lines, const QueryOptions& options) {
    Queries queries;
    if (lines) {
        read_profile_lines(at, options, queries);
    } else {
        read_points(at, options, queries);
    }
    return queries;
}

}  // namespace tinwright::tools
