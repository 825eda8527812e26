#ifndef TINWRIGHT_IO_WORKING_PLANE_HPP
#define TINWRIGHT_IO_WORKING_PLANE_HPP

#include <optional>
#include <string>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/geographic_extent.hpp"

/// The plane that a job works in. Triangles, distances and slopes need one that is true to scale; degrees are
/// none. Which one is chosen, and how far it may be off: docs/geodesy.md.
namespace tinwright::io {

/// What the user says about it: --working-crs, --max-distortion.
struct PlaneRequest {
    enum class Rule {
        Auto,   ///< the system asked for or shared if it is projected, else Utm if it is within the limit,
                ///< else Local
        Given,  ///< `crs`
        Utm,    ///< the zone of UTM or UPS at the data's centre
        Local   ///< a projection of its own, centred on the data
    };
    Rule rule = Rule::Auto;
    Crs crs{};                      ///< of Given: projected
    double max_distortion = 0.001;  ///< greatest |scale - 1| over the data's extent
    bool takes_best = false;        ///< where no chosen plane is within the limit: the best, with a warning
    bool is_limit_given = false;    ///< the limit counts for systems that users or files name as well
};

/// "auto", "utm", "local" or a CRS, as --working-crs takes it. Throws UsageError: not understood, geographic,
/// geocentric or vertical alone.
PlaneRequest parse_plane_request(const std::string& text);

/// Least and greatest factor by which a projection stretches lengths.
struct ScaleRange {
    double least = 1;
    double greatest = 1;
    /// Greatest |scale - 1|.
    [[nodiscard]] double distortion() const;
    /// A bound on how far beyond this range the scale may go between the places that were looked at.
    [[nodiscard]] double uncertainty() const;
};

/// The plane of a job.
struct WorkingPlane {
    enum class Origin {
        Unknown,  ///< no CRS is known
        Asked,    ///< by --crs, --working-crs
        Shared,   ///< of the sources themselves
        Utm,      ///< chosen: a zone of UTM or UPS
        Local     ///< chosen: a projection of its own
    };
    Crs crs;  ///< projected, or unknown; with a vertical part when what z is measured from is known
    Origin origin = Origin::Unknown;
    /// The sources' geographic system, when that is what they are in; else unknown.
    Crs source_crs;
    GeographicExtent extent;  ///< of the data; empty when no CRS is known
    ScaleRange scale;         ///< over the extent; 1 to 1 where it is empty

    [[nodiscard]] bool is_source_geographic() const { return source_crs.is_known(); }
    /// "EPSG:32612 (WGS 84 / UTM zone 12N), chosen for the data's longitudes and latitudes; scale 0.99960 to
    /// 0.99998", for people.
    [[nodiscard]] std::string text() const;
};

/// Chooses the plane for data in the geographic system `source` over `extent`, by a rule other than Given.
/// Both UTM and local systems are on the sources' own datum, so nothing is lost on the way; a zone that the
/// authority has a code for is taken by that. Of two local ones, transverse Mercator (tall extents) and
/// oblique or polar stereographic (round ones and poles), the one of less distortion is taken; its scale at
/// the centre, rounded to millionths, balances the errors. Centres are rounded to hundredths of a degree. The
/// plane has no vertical part: what z is measured from is the caller's to add. Throws InputError when the
/// distortion exceeds the limit, whichever rule it is, saying what would help, and for an empty extent. O(1),
/// some tens of milliseconds.
WorkingPlane choose_working_plane(const Crs& source, const GeographicExtent& extent,
                                  const PlaneRequest& request);

/// The scale of a projected system over an extent, by the derivatives of the projection at places of a net of
/// 25 by 25 over it, edges included, and of finer ones around its extremes. Between those places the scale of
/// a projection without a singularity nearby exceeds what is found by less than a 250th of greatest - least
/// (a net of 25 lines a side misses 1/576 of the rise of a parabola, each way), and derivatives are right to
/// 1e-8 (`ScaleRange::uncertainty`). Empty when it cannot be told: a local engineering system, or one place
/// at least that cannot be projected. `extent` in degrees of the system's own geographic one. O(1), some
/// 20 milliseconds.
std::optional<ScaleRange> find_scale_range(const Crs& crs, const GeographicExtent& extent);

/// Throws InputError when the plane's distortion exceeds a limit that counts for it; else returns what there
/// is to warn of (a plane that users or files name off by more than a hundredth), or nothing.
std::string check_distortion(const WorkingPlane& plane, const PlaneRequest& request);

}  // namespace tinwright::io

#endif
