#ifndef TINWRIGHT_IO_CRS_HPP
#define TINWRIGHT_IO_CRS_HPP

#include <memory>
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
    /// "EPSG:3875" or empty.
    [[nodiscard]] std::string code() const;
    /// WKT 2, empty when unknown.
    [[nodiscard]] std::string wkt() const;
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
