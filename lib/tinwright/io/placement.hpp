#ifndef TINWRIGHT_IO_PLACEMENT_HPP
#define TINWRIGHT_IO_PLACEMENT_HPP

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/geographic_extent.hpp"
#include "tinwright/io/geoid.hpp"
#include "tinwright/io/height_request.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/working_plane.hpp"

namespace tinwright::io {

/// What a file says about the coordinates in it.
struct CoordinateSystem {
    Crs crs;                      ///< may be unknown
    bool is_lon_lat = false;      ///< columns are called longitude and latitude
    bool is_north_first = false;  ///< x is northing or latitude
    std::string z_unit;           ///< where the file itself tells it
    bool has_z = true;            ///< of its own
};

struct PlacementOptions {
    Crs crs;         ///< of what is made; unknown: that of the plane
    Crs source_crs;  ///< of sources that carry none
    PlaneRequest plane;
    HeightRequest heights;
    std::optional<double> epoch;
    bool is_plane_decided = false;  ///< `crs` is the plane of data read before
    std::string z_unit;             ///< of data read before; empty when unknown
};

/// Private to the readers: brings what several sources hold into one plane, one unit of elevations and one
/// reference of theirs. First all sources are noted, then the plane is chosen, then each is placed, at once.
class Placement {
  public:
    /// `sources` are kept by reference. Throws UsageError when a source's crs= is not understood, when the
    /// CRS or unit asked for is none to work in.
    Placement(std::span<const Source> sources, PlacementOptions options);

    /// Says what source `s` is in; puts easting first. Throws InputError for geocentric coordinates, and for
    /// longitudes and latitudes in an unknown system. Returns the ascending positions of points that are no
    /// longitude and latitude though their system has such: those `place` returns too.
    std::vector<std::size_t> note(std::size_t s, const CoordinateSystem& own, std::span<Point3> points);
    /// Throws InputError when systems differ and none was asked for, and when no plane is true enough.
    void choose_plane();
    /// Brings the points of source `s` into the plane, in place, parallel inside the caller's task arena.
    /// Returns the ascending positions of those that cannot be transformed, left as they were. Points must
    /// have a finite z. Throws InputError when there is no way between the systems.
    std::vector<std::size_t> place(std::size_t s, std::span<Point3> points, const Progress& progress = {});
    /// Why a point that `note` or `place` returned is none of the plane: `(x, y) cannot be transformed from A
    /// to B`, or `(x, y) is no longitude and latitude`.
    [[nodiscard]] std::string failure(std::size_t s, const Point3& point) const;

    [[nodiscard]] const WorkingPlane& plane() const { return plane_; }
    /// Of all elevations placed; empty when unknown.
    [[nodiscard]] const std::string& z_unit() const { return z_unit_; }
    /// Hands over what there is to warn of since the last time, one line each.
    std::vector<std::string> take_warnings();

  private:
    /// What a source is in.
    struct Noted {
        Crs crs;             // may be unknown
        std::string z_unit;  // empty when unknown
        std::optional<double> epoch;
        bool is_noted = false;
        bool has_z = true;
        bool is_guessed = false;          // carries no system
        Box bounds;                       // of points in a plane
        std::vector<std::size_t> strays;  // points that are no longitude and latitude, ascending
    };

    Crs system_of(std::size_t s, const CoordinateSystem& own);
    /// The first source that has a system; null: none has.
    [[nodiscard]] const Noted* first_known() const;
    void require_shared_system() const;
    [[nodiscard]] bool is_asked_for() const;
    void note_degrees(Noted& noted, std::span<const Point3> points);
    void choose_horizontally();
    void choose_heights();
    void choose_z_unit();
    void place_guessed_sources();
    void measure_plane();

    [[nodiscard]] std::vector<Point3> geographic_positions(const Noted& noted,
                                                           std::span<const Point3> points) const;
    static void convert_units(std::span<Point3> points, const std::string& from, const std::string& to);
    std::vector<std::size_t> transform(const Noted& noted, std::span<Point3> points, bool has_elevations,
                                       const Progress& progress);
    void shift_to_wanted_heights(std::size_t s, std::span<const Point3> at, std::span<Point3> points,
                                 const Progress& progress);

    std::span<const Source> sources_;
    PlacementOptions options_;
    std::vector<Crs> given_;  // by crs=, one a source
    std::vector<Noted> noted_;
    ExtentGatherer extent_;
    WorkingPlane plane_;
    std::string z_unit_;
    std::unique_ptr<Geoid> geoid_;
    /// The way of the last source transformed, and where it came from.
    std::optional<CoordinateTransform> way_;
    Crs from_;
    bool has_way_elevations_ = false;
    std::optional<double> way_epoch_;
    bool is_geoid_guess_told_ = false;
    std::vector<std::string> warnings_;
};

}  // namespace tinwright::io

#endif
