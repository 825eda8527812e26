#ifndef TINWRIGHT_IO_READ_LINES_HPP
#define TINWRIGHT_IO_READ_LINES_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/height_request.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {

/// A source of lines and what they are there for.
struct LineSource {
    Source source;
    LineRole role = LineRole::Breakline;
};

struct ReadLinesOptions {
    bool skip_bad = false;  ///< count unusable features and go on, instead of failing at the first
    Crs crs;                ///< as of `ReadOptions`; or with samples, the plane that they were brought to
    bool is_plane_decided = false;  ///< `crs` is that of samples read before
    Crs source_crs;      ///< --source-crs: for sources that carry none; a source's crs= comes first
    PlaneRequest plane;  ///< where geographic lines are worked on when `crs` is unknown
    HeightRequest heights;
    std::optional<double> epoch;  ///< --epoch
    std::string z_unit;           ///< of the samples; empty when unknown
    double snap = 0;  ///< rings whose ends are at most this far apart (CRS units, >= 0) are closed
    /// For audits: keeps and lists faults that otherwise end the reading. Points without a finite z become
    /// draped (`MissingZ`, one a line), rings that are not closed stay open (`OpenRing`), lines may have a
    /// single point; features that cannot be used at all are left out and are in `Lines::faults`.
    bool keep_faults = false;
    Progress progress;
};

/// Which part of a feature a line is.
struct LinePart {
    std::int64_t feature = 0;  ///< feature id
    std::uint32_t part = 0;    ///< number among the curves of the feature's geometry, depth first, from 0
    bool is_ring = false;      ///< of a polygon
    bool lacks_z = false;      ///< a point should have had z and has none; under keep_faults only
};

/// A feature that cannot be used, under keep_faults.
struct FeatureFault {
    std::size_t source = 0;  ///< index of the source
    std::string layer;
    std::int64_t feature = 0;
    std::string what;  ///< half a sentence: `has a coordinate that is not finite`
};

/// The part of an array of lines that came from one layer.
struct LineSlice {
    LineRole role = LineRole::Breakline;
    std::size_t source = 0;  ///< index of the source
    std::string file;        ///< as the user wrote it
    std::string layer;
    std::size_t first = 0;  ///< lines [first, first + count)
    std::size_t count = 0;
    std::size_t skipped = 0;  ///< unusable features under skip_bad
};

struct Lines {
    std::vector<Breakline> lines;  ///< in the working CRS; polygons numbered through all sources
    std::vector<LinePart> parts;   ///< one a line
    std::vector<LineSlice> slices;
    /// What was done while reading: rings closed within `snap`, and under keep_faults those above.
    std::vector<LineConflict> conflicts;
    std::vector<FeatureFault> faults;  ///< under keep_faults
    Crs crs;                           ///< the working CRS, may be unknown: that of `plane`
    WorkingPlane plane;
    std::string z_unit;                 ///< empty when unknown
    std::vector<std::string> warnings;  ///< one line each
    double seconds = 0;

    /// The slice of a line. O(log slices).
    [[nodiscard]] const LineSlice& slice_of(std::size_t line) const;
    /// Where a line came from, for messages: `file "a.gpkg", layer "p", feature 7`.
    [[nodiscard]] std::string describe(std::size_t line) const;
};

/// Reads the lines of vector layers, in source and feature order: lines, rings of polygons, and collections
/// of them; curves are made of straight parts. z is the geometry's, a field, a constant, or draped, as z=
/// says; boundaries and holes without z are draped. Of roles Boundary and Hole lines must be closed, those of
/// one feature being rings of one polygon. Systems are treated as `read_samples` does, but that lines go to
/// the samples' one without being asked. Throws IoError (cannot be opened or read), InputError (unusable
/// content, naming file, layer and feature), UsageError (keys that do not fit), Cancelled. O(n).
Lines read_lines(std::span<const LineSource> sources, const ReadLinesOptions& options = {});

/// Whether the source is lines or polygons rather than samples: the layer that it names, or all that there
/// are (one of them at least), by their declared types, or where those leave it open by the first feature.
/// Keys that only samples have say no. A TIN of polygons counts as well: ask `is_tin` first. Throws IoError
/// when it cannot be opened.
bool has_lines(const Source& source);

/// Of a source that `has_lines`: whether these are polygons, by the declared type of the layer, or where that
/// leaves it open by the first feature. Throws IoError when it cannot be opened.
bool has_polygons(const Source& source);

}  // namespace tinwright::io

#endif
