#include "tinwright/io/working_plane.hpp"

#include "tinwright/geometry/error.hpp"

namespace tinwright::io {

PlaneRequest parse_plane_request(const std::string& /*text*/) { return {}; }
double ScaleRange::distortion() const { return 0; }
std::string WorkingPlane::text() const { return crs.name(); }
WorkingPlane choose_working_plane(const Crs& /*source*/, const GeographicExtent& /*extent*/,
                                  const PlaneRequest& /*request*/) {
    return {};
}
std::optional<ScaleRange> find_scale_range(const Crs& /*crs*/, const GeographicExtent& /*extent*/) {
    return std::nullopt;
}
std::string check_distortion(const WorkingPlane& /*plane*/, const PlaneRequest& /*request*/) { return {}; }

}  // namespace tinwright::io
