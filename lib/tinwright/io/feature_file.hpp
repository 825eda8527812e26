#ifndef TINWRIGHT_IO_FEATURE_FILE_HPP
#define TINWRIGHT_IO_FEATURE_FILE_HPP

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/tin_dataset.hpp"
#include "tinwright/io/tin_drivers.hpp"

/// Private to the writers of contours and graphs: a file of one layer, tried out in memory before it is
/// written.
namespace tinwright::io {

/// Writes one dataset's features; returns how many.
using FillFeatures = std::function<std::size_t(TinDataset&)>;

/// Calls the progress callback every thousand features.
class FeatureProgress {
  public:
    FeatureProgress(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
    void operator()() {
        if (++done_ % 1024 == 0) {
            report_progress(progress_, static_cast<double>(done_) / static_cast<double>(total_));
        }
    }

  private:
    const Progress& progress_;
    std::size_t total_;
    std::size_t done_ = 0;
};

/// The options of the dataset: those of the user, and all digits of coordinates where the driver has a say.
WriteTinOptions feature_file_options(const TinDriver& driver,
                                     const std::vector<std::string>& creation_options,
                                     const std::vector<std::string>& layer_options,
                                     const TinMetadata& metadata);

/// Writes `path`; messages name `target`. Returns the number of features. Throws IoError, Cancelled.
std::size_t write_features(const TinDriver& driver, const std::string& path, const std::string& target,
                           const Crs& crs, const WriteTinOptions& options, const FillFeatures& fill);

/// A feature to try a driver out with.
struct ProbeFeature {
    const char* subject;             ///< what is written, in the plural: "contours"
    FillFeatures fill;               ///< writes one feature
    std::span<const Point3> points;  ///< its points
    /// Whether its fields hold what they should.
    std::function<bool(const OGRFeature&)> has_fields;
};

/// A place for probes: `(east, north)` metres from the middle of a UTM zone at 60 degrees north, or as many
/// degrees from 5 east and 60 north.
Point3 probe_point(const Crs& crs, double east, double north, double z);

/// What came back of it.
struct KeptFeature {
    bool positions = false;  ///< to within a thousandth of a unit
    bool z = false;
    bool fields = false;
    bool crs = false;
};

/// Writes one feature in memory and reads it back. Throws UsageError, with what to use instead, when it
/// cannot be written or is somewhere else.
KeptFeature probe_features(const TinDriver& driver, const std::string& target, const Crs& crs,
                           const WriteTinOptions& options, const ProbeFeature& feature);

/// Throws UsageError: the driver loses the elevations of `subject`.
[[noreturn]] void refuse_lost_elevations(const TinDriver& driver, const char* subject);

/// Whether a field of that name holds the value, to a millionth.
bool has_field_value(const OGRFeature& feature, const char* name, double value);

/// A warning where the driver does not keep the CRS; else empty.
std::string lost_crs_warning(const TinDriver& driver, const KeptFeature& kept, const Crs& crs);

}  // namespace tinwright::io

#endif
