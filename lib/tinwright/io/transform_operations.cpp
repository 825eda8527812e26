#include "tinwright/io/transform_operations.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tinwright::io {
namespace {

/// Degrees by which an extent is grown on each side: PROJ finds nothing for a single point or a line.
constexpr double kMargin = 1e-6;

/// Degrees from the meridian `from` eastward to `to`: [0, 360).
double eastward(double from, double to) {
    const double degrees = std::fmod(to - from, 360.0);
    return degrees < 0 ? degrees + 360 : degrees;
}

void set_area(PJ_CONTEXT* context, PJ_OPERATION_FACTORY_CONTEXT* factory, const GeographicExtent& extent) {
    double west = extent.west - kMargin;
    double east = extent.east + kMargin;
    if (east - west >= 360) {
        west = -180;
        east = 180;
    }
    // PROJ takes longitudes within 180 degrees, and west east of east for an area across the antimeridian.
    west = west < -180 ? west + 360 : west;
    east = east > 180 ? east - 360 : east;
    proj_operation_factory_context_set_area_of_interest(context, factory, west,
                                                        std::max(-90.0, extent.south - kMargin), east,
                                                        std::min(90.0, extent.north + kMargin));
}

void note_grids(PJ_CONTEXT* context, Operation& operation) {
    const bool is_online = proj_context_is_network_enabled(context) != 0;
    const int count = proj_coordoperation_get_grid_used_count(context, operation.object.get());
    for (int i = 0; i < count; ++i) {
        const char* name = nullptr;
        const char* address = nullptr;
        int is_available = 0;
        if (proj_coordoperation_get_grid_used(context, operation.object.get(), i, &name, nullptr, nullptr,
                                              &address, nullptr, nullptr, &is_available) == 0 ||
            name == nullptr || is_available != 0) {
            continue;
        }
        const bool is_known = address != nullptr && *address != '\0';
        if (is_online && is_known) {
            continue;
        }
        operation.missing_grids.emplace_back(name);
        operation.is_obtainable = operation.is_obtainable && is_known;
    }
}

/// Grids of definitions that files and users write themselves may be lists, or optional ("@null").
void forgive_optional_grids(PJ_CONTEXT* context, Operation& operation) {
    if (operation.missing_grids.empty()) {
        return;
    }
    const char* const steps = proj_as_proj_string(context, operation.object.get(), PJ_PROJ_5, nullptr);
    if (steps != nullptr && ProjObject(proj_create(context, steps))) {
        operation.missing_grids.clear();
    }
}

void note_epochs(PJ_CONTEXT* context, Operation& operation) {
    const char* const steps = proj_as_proj_string(context, operation.object.get(), PJ_PROJ_5, nullptr);
    if (steps == nullptr) {
        return;
    }
    const std::string_view text = steps;
    constexpr std::string_view kKey = "+t_epoch=";
    for (std::size_t at = text.find(kKey); at != std::string_view::npos; at = text.find(kKey, at)) {
        at += kKey.size();
        const std::string epoch(text.substr(at, text.find(' ', at) - at));
        if (std::find(operation.epochs.begin(), operation.epochs.end(), epoch) == operation.epochs.end()) {
            operation.epochs.push_back(epoch);
        }
    }
}

Operation describe(PJ_CONTEXT* context, ProjObject object) {
    Operation operation;
    operation.object = std::move(object);
    if (const char* const name = proj_get_name(operation.object.get()); name != nullptr) {
        operation.name = name;
    }
    const double accuracy = proj_coordoperation_get_accuracy(context, operation.object.get());
    if (accuracy >= 0) {
        operation.accuracy = accuracy;
    }
    operation.is_ballpark =
        proj_coordoperation_has_ballpark_transformation(context, operation.object.get()) != 0;
    note_grids(context, operation);
    forgive_optional_grids(context, operation);
    note_epochs(context, operation);
    return operation;
}

}  // namespace

bool Operation::has_unknown_heights() const {
    // PROJ has no other word for it than the name that it makes up.
    return is_ballpark && name.find("allpark vertical") != std::string::npos;
}

bool Operation::covers(PJ_CONTEXT* context, const GeographicExtent& extent) const {
    double west = 0;
    double south = 0;
    double east = 0;
    double north = 0;
    if (extent.is_empty) {
        return true;
    }
    if (proj_get_area_of_use(context, object.get(), &west, &south, &east, &north, nullptr) == 0) {
        return false;
    }
    const double width = east - west >= 360 ? 360 : eastward(west, east);
    return extent.south >= south && extent.north <= north &&
           (width >= 360 || eastward(west, extent.west) + (extent.east - extent.west) <= width);
}

std::vector<Operation> find_operations(PJ_CONTEXT* context, const PJ* source, const PJ* target,
                                       const OperationQuery& query) {
    const ProjFactory factory(proj_create_operation_factory_context(context, nullptr));
    proj_operation_factory_context_set_allow_ballpark_transformations(context, factory.get(),
                                                                      query.has_ballpark ? 1 : 0);
    proj_operation_factory_context_set_spatial_criterion(context, factory.get(),
                                                         PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
    PROJ_GRID_AVAILABILITY_USE grids = PROJ_GRID_AVAILABILITY_DISCARD_OPERATION_IF_MISSING_GRID;
    if (query.has_missing_grids) {
        grids = PROJ_GRID_AVAILABILITY_IGNORED;
    } else if (proj_context_is_network_enabled(context) != 0) {
        grids = PROJ_GRID_AVAILABILITY_KNOWN_AVAILABLE;
    }
    proj_operation_factory_context_set_grid_availability_use(context, factory.get(), grids);
    if (!query.extent.is_empty) {
        set_area(context, factory.get(), query.extent);
    }
    const ProjList list(proj_create_operations(context, source, target, factory.get()));
    std::vector<Operation> operations;
    const int count = list ? proj_list_get_count(list.get()) : 0;
    for (int i = 0; i < count; ++i) {
        ProjObject object(proj_list_get(context, list.get(), i));
        if (!object) {
            continue;
        }
        Operation operation = describe(context, std::move(object));
        // PROJ takes grids that its database does not know for available.
        if (query.has_missing_grids || operation.missing_grids.empty()) {
            operations.push_back(std::move(operation));
        }
    }
    return operations;
}

}  // namespace tinwright::io
