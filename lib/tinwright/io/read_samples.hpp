#ifndef TINWRIGHT_IO_READ_SAMPLES_HPP
#define TINWRIGHT_IO_READ_SAMPLES_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/height_request.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {

struct ReadOptions {
    bool skip_bad = false;  ///< count unusable rows and features and go on, instead of failing at the first
    Crs crs;         ///< --crs: what is made is in it; if projected, and no plane is given, the working one
    Crs source_crs;  ///< --source-crs: for sources that carry none; a source's crs= comes first
    PlaneRequest plane;  ///< where geographic samples are worked on
    HeightRequest heights;
    std::optional<double>
        epoch;        ///< --epoch: of the sources' coordinates, decimal year; a data set's own comes first
    int threads = 1;  ///< 0: all processors, and never more than there are
    Progress progress;
};

/// The part of a sample array that came from one layer, band or text file.
struct SampleSlice {
    enum class Kind { Vector, Text, Raster };
    Kind kind = Kind::Text;
    std::size_t source = 0;  ///< index of the source on the command line
    std::string file;        ///< as the user wrote it
    std::string layer;       ///< vector layer's name or raster band ("band 1"); empty for text
    std::size_t first = 0;   ///< samples [first, first + count)
    std::size_t count = 0;
    std::size_t skipped = 0;  ///< unusable rows or features under skip_bad
    /// Feature id, line number (from 1) or cell number (row-major from 0) of each sample; empty when
    /// sample i of the slice has id `first_id + i`.
    std::vector<std::int64_t> ids;
    std::int64_t first_id = 0;

    [[nodiscard]] std::int64_t id(std::size_t i) const {
        return ids.empty() ? first_id + static_cast<std::int64_t>(i) : ids[i];
    }
};

struct Samples {
    std::vector<Point3> points;  ///< in the working CRS
    std::vector<SampleSlice> slices;
    Crs crs;  ///< the working CRS, may be unknown: that of `plane`
    WorkingPlane plane;
    std::string z_unit;                 ///< empty when unknown
    std::vector<std::string> warnings;  ///< one line each
    double seconds = 0;

    /// The slice of a sample; null for an index that is none.
    [[nodiscard]] const SampleSlice* find_slice(std::size_t sample) const;
    /// Where a sample came from, for messages: `file "a.csv", line 12` or `file "a.gpkg", layer "p", feature
    /// 7`.
    [[nodiscard]] std::string describe(std::size_t sample) const;
};

/// Reads sources one after the other into one array, in source and feature order. Sources in another system
/// than the working one are transformed to it; those without any are taken to be in it, with one warning.
/// Degrees are never taken for a plane: geographic samples are worked on in one chosen for them.
/// Throws IoError (cannot be opened or read), InputError (unusable content, naming file, layer, feature or
/// line), UsageError (options that do not fit), Cancelled. O(n); text is parsed in parallel by chunks.
Samples read_samples(std::span<const Source> sources, const ReadOptions& options = {});

}  // namespace tinwright::io

#endif
