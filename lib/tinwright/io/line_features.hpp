#ifndef TINWRIGHT_IO_LINE_FEATURES_HPP
#define TINWRIGHT_IO_LINE_FEATURES_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/io/line_plan.hpp"
#include "tinwright/io/raw_slice.hpp"
#include "tinwright/io/read_lines.hpp"

class OGRFeature;
class OGRGeometry;
class OGRSimpleCurve;

/// Private to the reader of lines: features become lines.
namespace tinwright::io {

/// The lines of one layer.
struct RawLines {
    explicit RawLines(bool skip_bad) : bad(skip_bad) {}

    std::vector<Breakline> lines;
    std::vector<LinePart> parts;          ///< one a line
    std::vector<std::uint32_t> ordinals;  ///< of each line: which feature, counted from 0
    std::vector<FeatureFault> faults;  ///< instead of `bad` where faults are kept; source and layer not set
    std::uint32_t count = 0;           ///< features looked at
    std::uint32_t polygons = 0;        ///< numbers given so far, through all layers
    BadSamples bad;

    void resize(std::size_t size);
    /// Notes a feature that cannot be used. Throws InputError unless such are skipped or kept.
    void add_bad(const LinePlan& plan, std::int64_t feature, const std::string& why);
};

/// Turns features into lines.
class FeatureLines {
  public:
    FeatureLines(const LinePlan& plan, RawLines& raw) : plan_(plan), raw_(raw) {}

    /// All lines of a feature or none: with one unusable part it is unusable.
    void add(const OGRFeature& feature);

  private:
    std::string read_attributes(const OGRFeature& feature);
    std::string collect(const OGRGeometry& geometry);
    std::string append_points(const OGRSimpleCurve& curve, std::vector<Point3>& points,
                              bool& is_missing_z) const;
    std::string add_line(const OGRSimpleCurve& curve, bool is_ring, std::uint32_t polygon);
    std::uint32_t polygon_of_lines();

    const LinePlan& plan_;
    RawLines& raw_;
    // Of the feature at hand:
    std::int64_t id_ = 0;
    std::optional<double> z_;
    bool is_sharp_ = true;
    std::optional<std::uint32_t> polygon_of_lines_;
    std::uint32_t part_ = 0;
};

}  // namespace tinwright::io

#endif
