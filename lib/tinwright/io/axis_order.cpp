#include "tinwright/io/axis_order.hpp"

#include <memory>
#include <vector>

#include <ogr_spatialref.h>

namespace tinwright::io {

bool is_north_first(const OGRSpatialReference* system) {
    if (system == nullptr) {
        return false;
    }
    const std::vector<int>& order = system->GetDataAxisToSRSAxisMapping();
    OGRSpatialReference usual(*system);
    usual.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::vector<int>& east_first = usual.GetDataAxisToSRSAxisMapping();
    return order.size() >= 2 && east_first.size() >= 2 && order[0] == east_first[1] &&
           order[1] == east_first[0];
}

}  // namespace tinwright::io
