#ifndef TINWRIGHT_IO_COORDINATE_TRANSFORM_HPP
#define TINWRIGHT_IO_COORDINATE_TRANSFORM_HPP

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/geographic_extent.hpp"

namespace tinwright::io {

struct TransformOptions {
    /// z is transformed with x and y, from what `from` measures it from to what `to` does; else it is left
    /// alone, and the systems are taken without their vertical parts.
    bool has_elevations = false;
    /// Where the points are, degrees: the operation is chosen for it. Empty: for wherever the systems are
    /// used.
    GeographicExtent extent{};
    /// When the coordinates were measured, decimal year: for systems that move.
    std::optional<double> epoch = std::nullopt;
};

/// The way between two coordinate reference systems, by PROJ; x is easting or longitude, y northing or
/// latitude, whatever the authorities' axis order; angles in the system's own unit.
///
/// A grid that a transformation of elevations needs and that is not there is an error, never a shift of zero.
/// Where positions are concerned the best operation that is there is taken, and a better one that lacks its
/// grid is told of (`warning`).
class CoordinateTransform {
  public:
    /// Throws InputError when there is no way, or none for the elevations: which grid is missing and where it
    /// was looked for, or which system does not say what z is measured from; and for geocentric systems. Some
    /// milliseconds, a tenth of a second where PROJ knows many operations.
    CoordinateTransform(const Crs& from, const Crs& to, const TransformOptions& options = {});
    ~CoordinateTransform();
    CoordinateTransform(CoordinateTransform&&) noexcept;
    CoordinateTransform& operator=(CoordinateTransform&&) noexcept;

    /// Transforms points in place. Returns the ascending positions of those that cannot be, left as they
    /// were. Parallel inside the caller's task arena; the result does not depend on the threads. Throws
    /// Cancelled. O(n).
    std::vector<std::size_t> forward(std::span<Point3> points, const Progress& progress = {}) const;
    std::vector<std::size_t> inverse(std::span<Point3> points, const Progress& progress = {}) const;
    /// Positions alone; those that cannot be transformed become NaN. For short spans, from any thread.
    void forward(std::span<Point2> positions) const;
    void inverse(std::span<Point2> positions) const;

    /// PROJ's name of what is done, for people; of several operations by area the first.
    [[nodiscard]] std::string operation() const;
    /// Metres, as the authority states it; empty when it does not.
    [[nodiscard]] std::optional<double> accuracy() const;
    /// One line: that a better operation lacks its grid, that the datums' shift is unknown, that an epoch is
    /// wanting; or empty.
    [[nodiscard]] const std::string& warning() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace tinwright::io

#endif
