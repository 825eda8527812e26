#include "sample_queries.hpp"

#include <algorithm>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
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

/// Stands for "no elevation is asked for": a constant that every kind of source takes.
constexpr const char* kAnyElevation = "0.0";

void warn_of_guess(const io::Crs& crs, const QueryOptions& options, Queries& queries) {
    if (crs.is_known() && !options.crs.is_known()) {
        queries.warnings.push_back("the surface has no CRS; taken to be in " + crs.name() +
                                   " as what --at names");
    }
}

void read_points(std::span<const Whereabouts> at, const QueryOptions& options, Queries& queries) {
    NumberedSources numbered = numbered_sources(at);
    io::Samples samples;
    if (!numbered.sources.empty()) {
        for (io::Source& source : numbered.sources) {
            source.z = kAnyElevation;
        }
        io::ReadOptions read;
        read.skip_bad = options.skip_bad;
        read.crs = options.crs;
        read.source_crs = options.source_crs;
        read.threads = options.threads;
        read.progress = options.progress;
        samples = io::read_samples(numbered.sources, read);
        queries.warnings = samples.warnings;
        warn_of_guess(samples.crs, options, queries);
    }
    auto slice = samples.slices.begin();
    for (std::size_t i = 0; i < at.size(); ++i) {
        const auto number = static_cast<std::int64_t>(i) + 1;
        if (const auto* const position = std::get_if<Point2>(&at[i])) {
            queries.points.push_back(*position);
            queries.point_ids.push_back({number, number});
            continue;
        }
        for (; slice != samples.slices.end() && numbered.numbers[slice->source] == number; ++slice) {
            for (std::size_t k = 0; k < slice->count; ++k) {
                const Point3& point = samples.points[slice->first + k];
                queries.points.push_back({point.x, point.y});
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
    read.crs = options.crs;
    read.source_crs = options.source_crs;
    read.progress = options.progress;
    const io::Lines lines = io::read_lines(sources, read);
    queries.warnings = lines.warnings;
    warn_of_guess(lines.crs, options, queries);
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
        std::vector<Point2>& line = queries.lines.emplace_back();
        for (const Point3& point : lines.lines[i].points) {
            line.push_back({point.x, point.y});
        }
        queries.line_ids.push_back({numbered.numbers[lines.slice_of(i).source], lines.parts[i].feature});
    }
}

}  // namespace

bool are_lines(std::span<const Whereabouts> at) {
    const Whereabouts* with_points = nullptr;
    const io::Source* with_lines = nullptr;
    for (const Whereabouts& where : at) {
        const auto* const source = std::get_if<io::Source>(&where);
        if (source != nullptr && io::has_lines(*source)) {
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
