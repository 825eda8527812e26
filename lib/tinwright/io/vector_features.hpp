#ifndef TINWRIGHT_IO_VECTOR_FEATURES_HPP
#define TINWRIGHT_IO_VECTOR_FEATURES_HPP

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/raw_slice.hpp"

class OGRFeature;
class OGRGeometry;
class OGRLayer;

namespace tinwright::io {

/// What to take from the features of a layer; fields are indices, -1 for none.
struct VectorPlan {
    OGRLayer* layer = nullptr;
    std::string where;  ///< for messages: `file "a.gpkg", layer "p"`
    int x_field = -1;   ///< with y_field: in place of the geometry's position
    int y_field = -1;
    int z_field = -1;
    std::optional<double> z_constant;
    bool vertices = false;       ///< of lines and polygons
    bool has_filter = false;     ///< fields that are not read may be needed to select features
    std::string numeric_fields;  ///< quoted, separated by commas
};

/// Turns features into samples.
class FeatureSamples {
  public:
    FeatureSamples(const VectorPlan& plan, std::vector<Point3>& points, RawSlice& slice)
        : plan_(plan), points_(points), slice_(slice) {}

    /// Samples of a geometry; `z` in place of its own elevations. All of them or none: a feature with one
    /// unusable vertex is unusable.
    void add(const OGRGeometry* geometry, std::optional<double> z, std::int64_t id);
    /// A sample whose position is known to be finite.
    void add(const Point3& sample, std::int64_t id) {
        points_.push_back(sample);
        slice_.ids.add(id);
    }
    void add(const OGRFeature& feature);
    void add_bad(std::int64_t id, const std::string& why);

  private:
    std::string collect(const OGRGeometry& geometry, std::optional<double> z);
    std::string collect_point(double x, double y, bool has_z, double own_z, std::optional<double> z);
    template <typename Curve>
    std::string collect_curve(const Curve& curve, std::optional<double> z);

    const VectorPlan& plan_;
    std::vector<Point3>& points_;
    RawSlice& slice_;
};

/// Reads all features of the plan's layer one by one: any driver, any geometry.
void read_features(const VectorPlan& plan, const SliceRequest& request, std::vector<Point3>& points,
                   RawSlice& slice);

}  // namespace tinwright::io

#endif
