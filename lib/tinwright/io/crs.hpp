#ifndef TINWRIGHT_IO_CRS_HPP
#define TINWRIGHT_IO_CRS_HPP

#include <memory>
#include <optional>
#include <string>

class OGRSpatialReference;

namespace tinwright::io {

/// A coordinate reference system or the lack of one; x is easting, y northing, whatever the authority's
/// axis order. A value: copies share an immutable system.
class Crs {
  public:
    /// No CRS.
    Crs() = default;
    /// "EPSG:3875", WKT, PROJJSON, a PROJ string, or anything that GDAL takes. Throws UsageError.
    static Crs parse(const std::string& definition);
    /// A dataset's CRS; null, and systems named "Undefined ..." (GeoPackage's srs_id 0 and -1) or local
    /// placeholders that GDAL makes up for them, give no CRS.
    static Crs from_gdal(const OGRSpatialReference* system);

    [[nodiscard]] bool is_known() const { return system_ != nullptr; }
    [[nodiscard]] bool is_geographic() const;
    /// Same system for coordinates (axis order and names aside); two unknown ones are the same.
    [[nodiscard]] bool is_same(const Crs& other) const;
    /// "EPSG:3875 (ETRS89 / GK21FIN)", the name alone without a code, "none" when unknown.
    [[nodiscard]] std::string name() const;
    /// "EPSG:3875"; "EPSG:25832+5783" of a compound system by its parts'; or empty.
    [[nodiscard]] std::string code() const;
    /// WKT 2, empty when unknown.
    [[nodiscard]] std::string wkt() const;
    /// Whether it is one of geocentric X, Y, Z.
    [[nodiscard]] bool is_geocentric() const;
    /// Whether positions are in a plane: a projected system, or a local one, with elevations or without.
    [[nodiscard]] bool is_plane() const { return is_known() && !is_geographic(); }

    /// What z is measured from: unknown without z, or where a file tells no more of it than a unit. X, Y, Z
    /// from the earth's centre count as ellipsoidal, since such are the heights they become.
    enum class Heights { Unknown, Ellipsoidal, Gravity };
    [[nodiscard]] Heights heights() const;
    /// The same without z: the horizontal part of a compound system, a 3-D one made 2-D.
    [[nodiscard]] Crs horizontal() const;
    /// The 2-D geographic system that it is one of or is based on; unknown where there is none (local
    /// systems).
    [[nodiscard]] Crs geographic() const;
    /// The horizontal part of this with z measured as in `other` and in its unit, which has a vertical part
    /// or is 3-D; this one's horizontal part alone when `other` has none. Heights above an ellipsoid are then
    /// above this one's, as a system has but one.
    [[nodiscard]] Crs with_heights_of(const Crs& other) const;
    /// This one's horizontal part with heights in a vertical system by its code, "EPSG:5773". Throws
    /// UsageError.
    [[nodiscard]] Crs with_vertical(const std::string& vertical_code) const;
    /// This one's horizontal part with z above the ellipsoid, in metres unless it says so already.
    [[nodiscard]] Crs with_ellipsoidal_heights() const;
    /// Whether x and y are the same; vertical parts do not matter. Two unknown ones are.
    [[nodiscard]] bool is_same_horizontally(const Crs& other) const;
    /// Whether z is measured from the same and in the same direction, in whatever unit; false when either
    /// does not say.
    [[nodiscard]] bool has_same_heights(const Crs& other) const;
    /// Whether axes are not the usual ones, east and north: in words, "x points west and y points south";
    /// else empty, also for those of polar systems, along two meridians.
    [[nodiscard]] std::string axis_directions() const;
    /// Metres that a horizontal unit has; NaN for angles and where unknown.
    [[nodiscard]] double metres_per_unit() const;
    /// The epoch of coordinates that the data set gives with it, decimal year.
    [[nodiscard]] std::optional<double> epoch() const;

    /// Horizontal unit, "metre", "US survey foot", ...; empty when unknown.
    [[nodiscard]] std::string unit() const;
    /// Unit of z where a vertical part tells it, else empty.
    [[nodiscard]] std::string z_unit() const;
    /// GDAL's object in traditional GIS axis order; null when unknown.
    [[nodiscard]] const OGRSpatialReference* gdal() const { return system_.get(); }

  private:
    std::shared_ptr<const OGRSpatialReference> system_;
};

}  // namespace tinwright::io

#endif
