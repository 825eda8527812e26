#ifndef TINWRIGHT_IO_RAW_SLICE_HPP
#define TINWRIGHT_IO_RAW_SLICE_HPP

#include <cstddef>
#include <string>
#include <vector>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/sample_ids.hpp"

namespace tinwright::io {

/// Unusable rows, features and cells: the first one ends the reading, or all are counted (--skip-bad).
class BadSamples {
  public:
    explicit BadSamples(bool skip) : skip_(skip) {}

    /// `message` says what is wrong with the first of `count` and where; throws InputError with it unless bad
    /// samples are skipped.
    void add(const std::string& message, std::size_t count = 1) {
        if (!skip_) {
            throw InputError(message + "; --skip-bad goes on without it");
        }
        if (count_ == 0) {
            first_ = message;
        }
        count_ += count;
    }

    [[nodiscard]] bool skips() const { return skip_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    /// Message of the first one, empty when there was none.
    [[nodiscard]] const std::string& first() const { return first_; }

  private:
    bool skip_;
    std::size_t count_ = 0;
    std::string first_;
};

/// What a reader found in one text file, vector layer or raster band. Its points, in `crs`, are at the end of
/// the array that the reader was given.
struct RawSlice {
    explicit RawSlice(SampleSlice::Kind what, bool skip_bad) : kind(what), bad(skip_bad) {}

    SampleSlice::Kind kind;
    std::string layer;
    SampleIds ids;
    BadSamples bad;
    Crs crs;                      ///< the file's own, may be unknown
    bool is_lon_lat = false;      ///< columns are called longitude and latitude
    bool is_north_first = false;  ///< coordinates are northing or latitude first, and not yet put right
    std::string z_unit;           ///< where the file itself tells it
    std::vector<std::string> warnings;
};

/// What every reader is given: the source, the path in GDAL's spelling, and the file's name for messages.
struct SliceRequest {
    const Source& source;
    std::string path;
    std::string file;  ///< as in `file "a.csv"`
    const ReadOptions& options;
    Progress progress;  ///< fraction of this source
};

}  // namespace tinwright::io

#endif
