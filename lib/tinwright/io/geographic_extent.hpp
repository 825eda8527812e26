#ifndef TINWRIGHT_IO_GEOGRAPHIC_EXTENT_HPP
#define TINWRIGHT_IO_GEOGRAPHIC_EXTENT_HPP

#include <array>
#include <bitset>
#include <cstddef>
#include <span>
#include <string>

#include "tinwright/geometry/point.hpp"

namespace tinwright::io {

/// A part of the earth between two parallels and two meridians, degrees. Longitudes go from `west` eastward
/// to `east`, which may be past 180; of a part that goes round they are -180 and 180.
struct GeographicExtent {
    double west = 0;   ///< [-180, 180)
    double east = 0;   ///< [west, west + 360]
    double south = 0;  ///< [-90, 90]
    double north = 0;  ///< [south, 90]
    bool is_empty = true;
    /// A pole is inside: there are data all around it. `south` or `north` is then its latitude.
    bool has_pole = false;

    [[nodiscard]] double center_longitude() const;  ///< [-180, 180); 0 with a pole
    [[nodiscard]] double center_latitude() const;   ///< the pole's, with a pole
    /// "103.1 W to 101.5 W, 35.2 N to 36.0 N".
    [[nodiscard]] std::string text() const;
    friend bool operator==(const GeographicExtent&, const GeographicExtent&) = default;
};

/// Gathers the extent of points in degrees, whichever way their longitudes are counted (-180..180, 0..360)
/// and whatever their order.
///
/// The extent leaves out the widest gap between longitudes (found on arcs of a tenth of a degree), so that
/// data on both sides of the antimeridian are one piece; where no gap is as wide as 180 degrees data go round
/// the pole that they are nearer to, which is then inside.
class ExtentGatherer {
  public:
    /// O(n). Points that are not finite or beyond 90 degrees of latitude are not looked at.
    void add(std::span<const Point3> points);
    [[nodiscard]] GeographicExtent extent() const;

  private:
    static constexpr std::size_t kArcs = 3600;
    std::bitset<kArcs> has_points_;
    // Of the points in each arc, longitudes in [-180, 180): set where there are any.
    std::array<double, kArcs> least_{};
    std::array<double, kArcs> greatest_{};
    double south_ = 90;
    double north_ = -90;
};

}  // namespace tinwright::io

#endif
