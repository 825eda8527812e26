#include "point_layer.hpp"

#include <utility>

namespace tinwright::tools {

namespace {

io::WriteTinOptions layer_options(const io::TinDriver& driver, const io::Crs& crs,
                                  const io::TinMetadata& metadata) {
    io::WriteTinOptions options;
    options.metadata = metadata;
    if (driver.name.starts_with("GeoJSON")) {
        options.layer_options = {crs.is_geographic() ? "COORDINATE_PRECISION=12" : "COORDINATE_PRECISION=9"};
    }
    return options;
}

}  // namespace

void PointLayer::check_target(const std::string& target, const std::string& driver) {
    static_cast<void>(io::find_tin_driver(target, driver));
}

PointLayer::PointLayer(const std::string& target, const std::string& driver, bool overwrite,
                       const std::string& layer, std::span<const io::TinField> fields, io::Crs crs,
                       Shape shape, const io::TinMetadata& metadata)
    : shape_(shape),
      driver_(io::find_tin_driver(target, driver)),
      crs_(std::move(crs)),
      options_(layer_options(driver_, crs_, metadata)),
      output_(std::make_unique<io::AtomicOutput>(target, overwrite)),
      dataset_(driver_, output_->path(), target, crs_, options_),
      layer_(dataset_.add_layer(layer, shape == Shape::Flat ? wkbPoint : wkbPoint25D, fields, Tin{})) {}

std::unique_ptr<io::AtomicOutput> PointLayer::finish() {
    dataset_.add_metadata_table();
    dataset_.close();
    return std::move(output_);
}

void PointLayer::write(const Point3& location) {
    auto& point = layer_.geometry<OGRPoint>();
    point.setX(location.x);
    point.setY(location.y);
    if (shape_ == Shape::Flat) {
        point.set3D(FALSE);
    } else {
        point.setZ(location.z);
    }
    layer_.write();
}

}  // namespace tinwright::tools
