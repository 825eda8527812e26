#include <optional>
#include <string>
#include <vector>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/angular_unit.hpp"
#include "tinwright/io/each_point.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/length_unit.hpp"
#include "tinwright/io/placement.hpp"

/// The part of `Placement` that is about elevations.
namespace tinwright::io {

/// What elevations are measured from: as asked for, as the plane given has it, or as the first source says.
void Placement::choose_heights() {
    using Heights = Crs::Heights;
    Crs wanted = options_.crs.heights() != Heights::Unknown ? options_.crs : options_.plane.crs;
    if (wanted.heights() == Heights::Unknown && geoid_ != nullptr) {
        const std::string vertical = geoid_->vertical_code();
        if (!plane_.crs.is_known()) {
            throw InputError(
                "--geoid needs to know where on the earth the samples are; give their CRS with "
                "--source-crs");
        }
        plane_.crs = options_.heights.is_to_ellipsoid ? plane_.crs.with_ellipsoidal_heights()
                     : vertical.empty()               ? plane_.crs.horizontal()
                                                      : plane_.crs.with_vertical(vertical);
        return;
    }
    for (const Noted& noted : noted_) {
        if (wanted.heights() == Heights::Unknown && noted.is_noted) {
            wanted = noted.crs;
        }
    }
    const bool is_known = plane_.crs.is_known() && wanted.heights() != Heights::Unknown;
    if (is_known && !plane_.crs.has_same_heights(wanted)) {
        plane_.crs = plane_.crs.with_heights_of(wanted);
    }
}

void Placement::choose_z_unit() {
    const Crs& asked = options_.crs.heights() != Crs::Heights::Unknown ? options_.crs : options_.plane.crs;
    z_unit_ = options_.z_unit;
    if (z_unit_.empty()) {
        z_unit_ = options_.heights.unit;
    }
    if (z_unit_.empty()) {
        z_unit_ = asked.z_unit();
    }
    for (const Noted& noted : noted_) {
        if (z_unit_.empty() && noted.is_noted) {
            z_unit_ = noted.z_unit;
        }
    }
    if (z_unit_.empty()) {
        z_unit_ = plane_.crs.z_unit();
    }
}

/// Positions in degrees, for the geoid.
std::vector<Point3> Placement::geographic_positions(const Noted& noted,
                                                    std::span<const Point3> points) const {
    const Crs& crs = noted.crs.is_known() ? noted.crs : plane_.crs;
    if (!crs.geographic().is_known()) {
        throw InputError("--geoid needs to know where on the earth the samples are, and " + crs.name() +
                         " does not tell; give their CRS with crs=");
    }
    return in_degrees(points, crs);
}

void Placement::convert_units(std::span<Point3> points, const std::string& from, const std::string& to) {
    const double factor = unit_factor(from, to);
    if (factor != 1) {
        for_each_point(points, [&](Point3& point, std::size_t) { point.z *= factor; });
    }
}

void Placement::shift_to_wanted_heights(std::size_t s, std::span<const Point3> at, std::span<Point3> points,
                                        const Progress& progress) {
    using Heights = Crs::Heights;
    const Heights wanted = options_.heights.is_to_ellipsoid ? Heights::Ellipsoidal : Heights::Gravity;
    const Heights own = noted_[s].crs.heights();
    if (own == wanted) {
        return;
    }
    if (own == Heights::Unknown && !is_geoid_guess_told_) {
        is_geoid_guess_told_ = true;
        warnings_.push_back("file " + quoted(sources_[s].path) +
                            ": does not say what elevations are measured from; taken to be " +
                            (wanted == Heights::Gravity ? "above the ellipsoid" : "above the geoid") +
                            " and shifted by --geoid");
    }
    ExtentGatherer extent;
    extent.add(at);
    geoid_->prepare(extent.extent());
    const std::optional<LengthUnit> unit = find_length_unit(z_unit_.empty() ? plane_.crs.unit() : z_unit_);
    shift_by_geoid(*geoid_, at, points, wanted == Heights::Gravity ? -1 : 1, unit ? unit->metres : 1,
                   progress);
}

}  // namespace tinwright::io
