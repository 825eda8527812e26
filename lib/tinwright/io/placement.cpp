#include "tinwright/io/placement.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <locale>
#include <sstream>
#include <utility>

#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/angular_unit.hpp"
#include "tinwright/io/each_point.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/length_unit.hpp"

namespace tinwright::io {
namespace {

constexpr std::size_t kBlock = 65536;  // points that are looked at together

std::string label(const Source& source) { return "file " + quoted(source.path); }

std::string number(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(15);
    text << value;
    return text.str();
}

/// Refuses a vertical system alone.
void require_positions(const std::string& option, const Crs& crs) {
    if (crs.is_known() && crs.gdal()->IsVertical() != 0 && crs.gdal()->IsCompound() == 0) {
        throw UsageError(option + " " + crs.name() +
                         " is for elevations alone; put one for positions before it, as in EPSG:4326+5773");
    }
}

/// One name a unit; what is none is kept as the file spells it.
std::string unit_name(const std::string& spelling) {
    const std::optional<LengthUnit> unit = find_length_unit(spelling);
    return unit ? unit->name : spelling;
}

/// Points along the edges and inside of a box.
std::vector<Point3> net_over(const Box& box) {
    constexpr int kSteps = 20;
    std::vector<Point3> net;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            net.push_back({std::lerp(box.x_min, box.x_max, i / static_cast<double>(kSteps)),
                           std::lerp(box.y_min, box.y_max, j / static_cast<double>(kSteps)), 0});
        }
    }
    return net;
}

}  // namespace

Placement::Placement(std::span<const Source> sources, PlacementOptions options)
    : sources_(sources), options_(std::move(options)), noted_(sources.size()) {
    for (const Source& source : sources) {
        given_.push_back(source.crs ? Crs::parse(*source.crs) : Crs());
    }
    require_positions("--crs", options_.crs);
    for (std::size_t s = 0; s < sources.size(); ++s) {
        require_positions(label(sources[s]) + ": crs=", given_[s]);
    }
    require_positions("--source-crs", options_.source_crs);
    if (options_.crs.is_geocentric()) {
        throw UsageError("--crs " + options_.crs.name() +
                         " is geocentric, without elevations; give a geographic or projected system");
    }
    if (options_.crs.heights() != Crs::Heights::Unknown) {
        options_.heights.is_to_ellipsoid = options_.crs.heights() == Crs::Heights::Ellipsoidal;
    }
    if (!options_.heights.geoid.empty()) {
        geoid_ = std::make_unique<Geoid>(options_.heights.geoid);
    }
}

std::vector<std::size_t> Placement::note(std::size_t s, const CoordinateSystem& own,
                                         std::span<Point3> points) {
    Noted& noted = noted_[s];
    noted.crs = system_of(s, own);
    noted.epoch = noted.crs.epoch() ? noted.crs.epoch() : options_.epoch;
    noted.is_noted = true;
    noted.has_z = own.has_z;
    noted.z_unit = !own.z_unit.empty() ? unit_name(own.z_unit) : noted.crs.z_unit();
    if (noted.z_unit.empty()) {
        noted.z_unit = options_.heights.source_unit;
    }
    if (own.is_north_first) {
        for_each_point(points, [](Point3& point, std::size_t) { std::swap(point.x, point.y); });
    }
    if (noted.crs.is_geocentric()) {
        throw InputError(label(sources_[s]) + ": coordinates are geocentric, " + noted.crs.name() +
                         ", without elevations; transform them first, for example to EPSG:4979");
    }
    noted.is_guessed = !noted.crs.is_known();
    if (noted.is_guessed && options_.crs.is_geographic()) {
        noted.crs = options_.crs;
    }
    if (noted.crs.is_geographic()) {
        note_degrees(noted, points);
    } else {
        for (const Point3& point : points) {
            noted.bounds.add(point.x, point.y);
        }
    }
    return noted.strays;
}

/// Gathers the extent, and the points that are none of the earth's: PROJ would count longitudes round and
/// round.
void Placement::note_degrees(Noted& noted, std::span<const Point3> points) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const double degrees = degrees_per_unit(noted.crs);
    for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
        const std::size_t count = std::min(kBlock, points.size() - begin);
        std::vector<Point3> block(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                  points.begin() + static_cast<std::ptrdiff_t>(begin + count));
        for (std::size_t i = 0; i < count; ++i) {
            if (is_stray(block[i], degrees)) {
                block[i] = {kNone, kNone, 0};
                noted.strays.push_back(begin + i);
            }
        }
        extent_.add(in_degrees(block, noted.crs));
    }
}

Crs Placement::system_of(std::size_t s, const CoordinateSystem& own) {
    if (given_[s].is_known()) {
        if (own.crs.is_known() && !own.crs.is_same(given_[s])) {
            warnings_.push_back(label(sources_[s]) + ": says " + own.crs.name() + "; read as " +
                                given_[s].name() + " because of crs=");
        }
        return given_[s];
    }
    if (own.crs.is_known()) {
        return own.crs;
    }
    if (own.is_lon_lat && !options_.source_crs.is_known() && !options_.crs.is_geographic()) {
        throw InputError(label(sources_[s]) +
                         ": coordinates are longitude and latitude in an unknown system; give theirs, for "
                         "example crs=EPSG:4326");
    }
    return options_.source_crs;
}

const Placement::Noted* Placement::first_known() const {
    const auto known = std::find_if(noted_.begin(), noted_.end(), [](const Noted& noted) {
        return noted.is_noted && noted.crs.is_known();
    });
    return known == noted_.end() ? nullptr : &*known;
}

bool Placement::is_asked_for() const {
    return options_.crs.is_known() || options_.plane.rule != PlaneRequest::Rule::Auto;
}

void Placement::require_shared_system() const {
    const Noted* const first = first_known();
    if (first == nullptr || is_asked_for()) {
        return;
    }
    for (const Noted& noted : noted_) {
        if (noted.is_noted && noted.crs.is_known() && !noted.crs.is_same_horizontally(first->crs)) {
            const auto a = static_cast<std::size_t>(first - noted_.data());
            const auto b = static_cast<std::size_t>(&noted - noted_.data());
            throw InputError(label(sources_[a]) + " is in " + first->crs.name() + ", " + label(sources_[b]) +
                             " in " + noted.crs.name() + "; give the system to work in with --crs");
        }
    }
}

void Placement::choose_plane() {
    require_shared_system();
    choose_horizontally();
    choose_heights();
    choose_z_unit();
    place_guessed_sources();
}

void Placement::choose_horizontally() {
    using Rule = PlaneRequest::Rule;
    using Origin = WorkingPlane::Origin;
    const Noted* const first = first_known();
    const Rule rule = options_.is_plane_decided ? Rule::Auto : options_.plane.rule;
    if (rule == Rule::Given) {
        plane_.crs = options_.plane.crs;
        plane_.origin = Origin::Asked;
    } else if (rule == Rule::Auto && options_.crs.is_plane()) {
        plane_.crs = options_.crs;
        plane_.origin = Origin::Asked;
    } else if (rule == Rule::Auto && first != nullptr && first->crs.is_plane()) {
        plane_.crs = first->crs;
        plane_.origin = Origin::Shared;
    }
    if (!plane_.crs.is_known() && first == nullptr && rule != Rule::Auto) {
        throw InputError(
            "--working-crs needs to know where on the earth the sources are, and none carries a CRS; "
            "assign one with --source-crs");
    }
    if (plane_.crs.is_known() || first != nullptr) {
        measure_plane();
    }
    if (first != nullptr && first->crs.is_geographic()) {
        plane_.source_crs = first->crs.horizontal();
    }
}

/// The data's extent on the earth, and the plane: chosen for it, or how true the one chosen is.
void Placement::measure_plane() {
    const Noted* const first = first_known();
    for (const Noted& noted : noted_) {
        const Crs& crs = noted.crs.is_known() ? noted.crs : plane_.crs;
        if (!noted.is_noted || noted.bounds.is_empty() || !crs.is_plane() || !crs.geographic().is_known()) {
            continue;
        }
        extent_.add(in_degrees(net_over(noted.bounds), crs));
    }
    const GeographicExtent extent = extent_.extent();
    if (!plane_.crs.is_known()) {
        const Crs geographic = first->crs.geographic();
        if (!geographic.is_known()) {
            throw InputError(label(sources_[static_cast<std::size_t>(first - noted_.data())]) + ": " +
                             first->crs.name() +
                             " has no place on the earth that a plane could be chosen for; leave out "
                             "--working-crs, or assign the true system with crs=");
        }
        plane_ = choose_working_plane(in_plain_degrees(geographic), extent, options_.plane);
        plane_.source_crs = {};
        if (plane_.scale.distortion() > options_.plane.max_distortion) {
            std::ostringstream percent;
            percent.imbue(std::locale::classic());
            percent.precision(2);
            percent << 100 * plane_.scale.distortion();
            warnings_.push_back("no plane is true to scale over the data's extent, " + extent.text() +
                                "; lengths and slopes are off by up to " + percent.str() + " %");
        }
        return;
    }
    plane_.extent = extent;
    if (const std::optional<ScaleRange> scale = find_scale_range(plane_.crs.horizontal(), extent)) {
        plane_.scale = *scale;
    }
    if (!options_.is_plane_decided) {
        if (std::string warning = check_distortion(plane_, options_.plane); !warning.empty()) {
            warnings_.push_back(std::move(warning));
        }
        if (const std::string axes = plane_.crs.axis_directions(); !axes.empty()) {
            warnings_.push_back("in " + plane_.crs.name() + " " + axes +
                                "; rows of rasters and aspects go by these axes");
        }
    }
}

/// Sources without a system are in the one asked for, or in the plane.
void Placement::place_guessed_sources() {
    std::vector<std::string> files;
    for (std::size_t s = 0; s < noted_.size(); ++s) {
        if (noted_[s].is_noted && noted_[s].is_guessed) {
            files.push_back(sources_[s].path);
        }
    }
    const Crs& taken = options_.crs.is_geographic() ? options_.crs : plane_.crs;
    if (!files.empty() && taken.is_known()) {
        warnings_.push_back((files.size() == 1 ? "file " : "files ") + quoted_list(files) +
                            (files.size() == 1 ? ": has" : ": have") + " no CRS; taken to be in " +
                            taken.name());
    }
    if (geoid_ != nullptr || plane_.crs.heights() == Crs::Heights::Unknown) {
        return;
    }
    files.clear();
    for (std::size_t s = 0; s < noted_.size(); ++s) {
        const Noted& noted = noted_[s];
        if (noted.is_noted && noted.has_z && !noted.is_guessed &&
            noted.crs.heights() == Crs::Heights::Unknown) {
            files.push_back(sources_[s].path);
        }
    }
    if (!files.empty()) {
        warnings_.push_back((files.size() == 1 ? "file " : "files ") + quoted_list(files) +
                            (files.size() == 1 ? ": does" : ": do") +
                            " not say what elevations are measured from; taken to be as in " +
                            plane_.crs.name());
    }
}

std::vector<std::size_t> Placement::place(std::size_t s, std::span<Point3> points, const Progress& progress) {
    const Noted& noted = noted_[s];
    if (options_.heights.scale != 1) {
        for_each_point(points, [&](Point3& point, std::size_t) { point.z *= options_.heights.scale; });
    }
    const bool is_plane_new = noted.crs.is_known() && !noted.crs.is_same_horizontally(plane_.crs);
    const bool is_datum_new = noted.crs.heights() != Crs::Heights::Unknown &&
                              plane_.crs.heights() != Crs::Heights::Unknown &&
                              !noted.crs.has_same_heights(plane_.crs) &&
                              (geoid_ == nullptr || noted.crs.heights() == plane_.crs.heights());
    std::vector<Point3> strays;
    for (const std::size_t i : noted.strays) {
        strays.push_back(points[i]);
    }
    std::vector<Point3> degrees;
    if (geoid_ != nullptr) {
        degrees = geographic_positions(noted, points);
    }
    std::vector<std::size_t> failed;
    if (is_datum_new) {
        convert_units(points, noted.z_unit, noted.crs.z_unit());
        failed = transform(noted, points, true, progress);
        convert_units(points, plane_.crs.z_unit(), z_unit_);
    } else {
        if (is_plane_new) {
            failed = transform(noted, points, false, progress);
        }
        convert_units(points, noted.z_unit, z_unit_);
    }
    if (geoid_ != nullptr) {
        shift_to_wanted_heights(s, degrees, points, progress);
    }
    if (noted.strays.empty()) {
        return failed;
    }
    std::vector<std::size_t> all;
    std::set_union(failed.begin(), failed.end(), noted.strays.begin(), noted.strays.end(),
                   std::back_inserter(all));
    for (std::size_t k = 0; k < strays.size(); ++k) {
        points[noted.strays[k]] = strays[k];
    }
    return all;
}

std::vector<std::size_t> Placement::transform(const Noted& noted, std::span<Point3> points,
                                              bool has_elevations, const Progress& progress) {
    const bool is_same_way = way_ && from_.is_same(noted.crs) && has_way_elevations_ == has_elevations &&
                             way_epoch_ == noted.epoch;
    if (!is_same_way) {
        way_.emplace(noted.crs, plane_.crs, TransformOptions{has_elevations, plane_.extent, noted.epoch});
        has_way_elevations_ = has_elevations;
        way_epoch_ = noted.epoch;
        if (!way_->warning().empty()) {
            warnings_.push_back(way_->warning());
        }
    }
    from_ = noted.crs;
    const bool is_in_place = noted.crs.is_same_horizontally(plane_.crs);
    const std::vector<Point3> before =
        is_in_place ? std::vector<Point3>(points.begin(), points.end()) : std::vector<Point3>();
    std::vector<std::size_t> failed = way_->forward(points, progress);
    // On a decimal lattice, with room below any meaningful precision, rows stay rows, predicates are quick,
    // and what two mathematical libraries differ by is rounded away.
    constexpr double kStepsPerUnit = 1e6;
    for_each_point(points, [&](Point3& point, std::size_t i) {
        if (is_in_place) {
            point.x = before[i].x;
            point.y = before[i].y;
        } else if (!std::binary_search(failed.begin(), failed.end(), i)) {
            point.x = std::nearbyint(point.x * kStepsPerUnit) / kStepsPerUnit;
            point.y = std::nearbyint(point.y * kStepsPerUnit) / kStepsPerUnit;
        }
    });
    return failed;
}

std::string Placement::failure(std::size_t s, const Point3& point) const {
    std::string text = number(point.x) + ", " + number(point.y);
    text.insert(text.begin(), '(');
    const Crs& crs = noted_[s].crs;
    if (crs.is_geographic() && is_stray(point, degrees_per_unit(crs))) {
        return text + ") is no longitude and latitude; is " + crs.name() + " the right CRS?";
    }
    return text + ") cannot be transformed from " + crs.name() + " to " + plane_.crs.name();
}

std::vector<std::string> Placement::take_warnings() { return std::exchange(warnings_, {}); }

}  // namespace tinwright::io
