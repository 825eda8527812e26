#include <algorithm>
#include <string>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/placement.hpp"
#include "tinwright/io/read_tin.hpp"

namespace tinwright::io {
namespace {

std::string recorded(const TinMetadata& metadata, const std::string& wanted) {
    for (const auto& [key, value] : metadata) {
        if (key == wanted) {
            return value;
        }
    }
    return {};
}

/// The plane that the file's vertices were made in, where it says so.
Crs recorded_plane(const TinMetadata& metadata) {
    const std::string plane = recorded(metadata, "TINWRIGHT_WORKING_CRS");
    return plane.empty() ? Crs() : Crs::parse(plane);
}

/// Drivers may claim heights that nobody gave: GDAL's GeoJSON has metres above the ellipsoid wherever
/// positions have a z. The unit that was written with the TIN counts.
void drop_claimed_heights(TinFile& file) {
    const std::string unit = recorded(file.metadata, "TINWRIGHT_Z_UNIT");
    if (!unit.empty() && !file.crs.z_unit().empty() && file.crs.z_unit() != unit) {
        file.crs = file.crs.horizontal();
    }
}

}  // namespace

WorkingPlane place_tin(TinFile& file, const Source& source, const ReadOptions& options) {
    PlacementOptions placing{options.crs, options.source_crs, options.plane, {}, options.epoch, false, {}};
    drop_claimed_heights(file);
    if (!file.crs.is_known()) {
        file.crs = options.source_crs.is_known() ? options.source_crs : options.crs;
    }
    const Crs made_in = recorded_plane(file.metadata);
    const bool is_moved =
        file.crs.is_known() && made_in.is_known() && !made_in.is_same_horizontally(file.crs);
    if (is_moved && placing.plane.rule == PlaneRequest::Rule::Auto && !options.crs.is_plane()) {
        placing.plane.rule = PlaneRequest::Rule::Given;
        placing.plane.crs = made_in;
    }
    if (!file.crs.is_geographic() && !is_moved) {
        placing.crs = file.crs;  // its faces are as they are
        placing.plane.rule = PlaneRequest::Rule::Auto;
    }
    Placement placement({&source, 1}, placing);
    placement.note(0, {file.crs, false, file.is_north_first, {}}, file.vertices);
    placement.choose_plane();
    const std::vector<std::size_t> failed = placement.place(0, file.vertices);
    if (!failed.empty()) {
        throw InputError("file " + quoted(source.path) + ": vertex at " +
                         placement.failure(0, file.vertices[failed.front()]));
    }
    const std::vector<std::string> warnings = placement.take_warnings();
    file.warnings.insert(file.warnings.end(), warnings.begin(), warnings.end());
    file.crs = placement.plane().crs;
    WorkingPlane plane = placement.plane();
    const bool is_own = !options.plane.crs.is_known() && !options.crs.is_plane();
    if (plane.origin == WorkingPlane::Origin::Asked && (is_own || !plane.is_source_geographic())) {
        plane.origin =
            WorkingPlane::Origin::Shared;  // the file's, whether its vertices are given in it or not
    }
    return plane;
}

}  // namespace tinwright::io
