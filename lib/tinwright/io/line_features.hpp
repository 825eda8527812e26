#ifndef TINWRIGHT_IO_LINE_FEATURES_HPP
#define TINWRIGHT_IO_LINE_FEATURES_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/io/raw_slice.hpp"

class OGRFeature;
class OGRGeometry;

/// Private to the reader of lines: features become lines.
namespace tinwright::io {

/// What to take from the features of a layer; fields are indices, -1 for none.
struct LinePlan {
    LineRole role = LineRole::Breakline;
    std::string where;  ///< for messages: `file "a.gpkg", layer "p"`
    int z_field = -1;
    std::optional<double> z_constant;
    bool is_draped = false;        ///< z is none of the file's business
    bool may_lack_z = false;       ///< geometries without z are draped
    bool lists_missing_z = false;  ///< points without a finite z are draped and noted, not an error
    int across_field = -1;
    bool is_sharp = true;  ///< where there is no such field
    std::string advice;    ///< what to try when z is missing
};

/// The lines of one layer.
struct RawLines {
    explicit RawLines(bool skip_bad) : bad(skip_bad) {}

    std::vector<Breakline> lines;
    std::vector<std::int64_t> features;
    std::vector<std::uint32_t> ordinals;  ///< of each line: which feature, counted from 0
    std::vector<bool> is_missing_z;       ///< of each line: draped in want of z
    std::uint32_t count = 0;              ///< features looked at
    std::uint32_t polygons = 0;           ///< numbers given so far, through all layers
    BadSamples bad;

    void resize(std::size_t size);
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
    template <class Curve>
    std::string add_line(const Curve& curve, bool is_ring, std::uint32_t polygon);
    std::uint32_t polygon_of_lines();

    const LinePlan& plan_;
    RawLines& raw_;
    // Of the feature at hand:
    std::int64_t id_ = 0;
    std::optional<double> z_;
    bool is_sharp_ = true;
    std::optional<std::uint32_t> polygon_of_lines_;
};

}  // namespace tinwright::io

#endif
