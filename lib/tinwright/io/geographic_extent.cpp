#include "tinwright/io/geographic_extent.hpp"

namespace tinwright::io {

double GeographicExtent::center_longitude() const { return (west + east) / 2; }
double GeographicExtent::center_latitude() const { return (south + north) / 2; }
std::string GeographicExtent::text() const { return {}; }
void ExtentGatherer::add(std::span<const Point3> /*points*/) {}
GeographicExtent ExtentGatherer::extent() const { return {}; }

}  // namespace tinwright::io
