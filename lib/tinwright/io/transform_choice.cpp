#include "tinwright/io/transform_choice.hpp"

#include <algorithm>
#include <utility>

#include "tinwright/geometry/error.hpp"

namespace tinwright::io {
namespace {

ProjObject make_system(PJ_CONTEXT* context, const Crs& crs, bool has_elevations) {
    ProjObject system(proj_create(context, (has_elevations ? crs : crs.horizontal()).wkt().c_str()));
    if (system && !has_elevations && proj_get_type(system.get()) == PJ_TYPE_COMPOUND_CRS) {
        system.reset(proj_crs_get_sub_crs(context, system.get(), 0));
    }
    if (!system) {
        throw InputError("CRS " + crs.name() + " is not understood by PROJ");
    }
    return system;
}

}  // namespace

TransformChoice choose_transform(PJ_CONTEXT* context, const Crs& from, const Crs& to,
                                 const TransformOptions& options) {
    const ProjObject source = make_system(context, from, options.has_elevations);
    const ProjObject target = make_system(context, to, options.has_elevations);
    TransformChoice choice;
    const ProjObject way(
        proj_create_crs_to_crs_from_pj(context, source.get(), target.get(), nullptr, nullptr));
    if (way) {
        choice.way.reset(proj_normalize_for_visualization(context, way.get()));
    }
    if (!choice.way) {
        throw InputError("no transformation from " + from.name() + " to " + to.name());
    }
    return choice;
}

}  // namespace tinwright::io
