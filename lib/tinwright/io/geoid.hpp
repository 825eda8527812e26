#ifndef TINWRIGHT_IO_GEOID_HPP
#define TINWRIGHT_IO_GEOID_HPP

#include <memory>
#include <span>
#include <string>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/geographic_extent.hpp"

namespace tinwright::io {

/// Heights of a geoid above its ellipsoid, from a file in GeographicLib's format (PGM), interpolated by its
/// cubic.
class Geoid {
  public:
    /// `file`: a path, or the name of a file in the folder that GeographicLib looks in, ".pgm" may be left
    /// out. Throws IoError: not found (naming the places looked at), not readable, not a geoid.
    explicit Geoid(const std::string& file);
    ~Geoid();
    Geoid(const Geoid&) = delete;
    Geoid& operator=(const Geoid&) = delete;

    /// Keeps the part of the file over `extent` in memory, for each of the threads of the caller's task arena
    /// or, if that would take less, the whole file for all; elsewhere each point reads from the file. Not
    /// while others call `height`. Throws IoError.
    void prepare(const GeographicExtent& extent);
    /// Metres; latitude and longitude in degrees, of any turn. NaN for what is no place on the earth. From
    /// any thread. Throws IoError when the file cannot be read any more.
    [[nodiscard]] double height(double latitude, double longitude) const;

    /// Path of the file that was found.
    [[nodiscard]] const std::string& path() const;
    /// What the file says it is, one line: "WGS84 EGM96, 15-minute grid"; may be empty.
    [[nodiscard]] const std::string& description() const;
    /// The vertical system of heights above it where the description tells (EGM84, EGM96, EGM2008):
    /// "EPSG:5773" and the like, also where only the file's name does; else empty.
    [[nodiscard]] std::string vertical_code() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Adds to each z the sign (+1: from above the geoid to above the ellipsoid, -1: back) times the geoid's
/// height at `at` (x: longitude, y: latitude, degrees), which is as long as `points`, in units of z, which
/// have `metres_per_unit` metres. Where `at` is no place on the earth z becomes NaN. Parallel inside the
/// caller's task arena. Throws Cancelled. O(n).
void shift_by_geoid(const Geoid& geoid, std::span<const Point3> at, std::span<Point3> points, int sign,
                    double metres_per_unit, const Progress& progress = {});

}  // namespace tinwright::io

#endif
