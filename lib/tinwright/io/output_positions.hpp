#ifndef TINWRIGHT_IO_OUTPUT_POSITIONS_HPP
#define TINWRIGHT_IO_OUTPUT_POSITIONS_HPP

#include <memory>
#include <span>
#include <vector>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/contour.hpp"
#include "tinwright/surface/contour_bands.hpp"

namespace tinwright::io {

/// The way from the plane that is worked in to the system that is written.
///
/// Degrees are rounded to 10^-10, other units to 10^-6. Longitudes are in one piece: they go from the data's
/// west eastward, past 180 where the data lie on both sides of the antimeridian. Of data all around a pole
/// they are from -180 to 180; what crosses the antimeridian then has ends on both sides.
class OutputPositions {
  public:
    /// Positions are written as they are.
    OutputPositions() = default;
    /// `bounds`: of the data, in the plane. Where both systems have the same x and y, or either is unknown,
    /// positions are written as they are. Throws InputError when there is no way between the two.
    OutputPositions(const Crs& plane, const Crs& output, const Box& bounds);

    /// Whether positions are written as they are.
    [[nodiscard]] bool is_identity() const { return state_ == nullptr; }
    /// Whether they are transformed to longitudes and latitudes.
    [[nodiscard]] bool is_geographic() const;
    /// Brings positions of the plane into the output system, in their order. Parallel inside the caller's
    /// task arena; the result does not depend on the threads. Throws InputError naming a position that cannot
    /// be transformed, Cancelled. O(n).
    [[nodiscard]] std::vector<Point2> transform(std::span<const Point2> positions,
                                                const Progress& progress = {}) const;
    [[nodiscard]] Point2 transform(Point2 position) const;
    /// As `transform`, with two more decimals where the plane's 10^-6 would not come back without: faces that
    /// are thinner than what is rounded away must not turn over.
    [[nodiscard]] std::vector<Point2> transform_reversibly(std::span<const Point2> positions) const;
    /// Likewise, in place; z stays.
    void apply_to(std::span<Point3> points) const;
    /// The bounds of what lies within bounds of the plane: corners and points between them transformed.
    [[nodiscard]] Box bounds(const Box& of_plane) const;

  private:
    struct State;
    std::shared_ptr<const State> state_;
};

/// The TIN's vertices as they are written; empty where that is as they are. O(n).
std::vector<Point2> written_vertices(const Tin& tin, const OutputPositions& positions);

/// How far what is drawn between two points of a contour is off the contour at most, CRS units of the plane.
inline constexpr double kChordTolerance = 0.01;

/// Contours as they are written. Chords are straight in the plane and not in the output system: those whose
/// middle would be off by more than `kChordTolerance` get further points, whichever way they run. O(n).
std::vector<LevelLines> written_lines(std::span<const LevelLines> lines, const OutputPositions& positions);
std::vector<Band> written_bands(std::span<const Band> bands, const OutputPositions& positions);

}  // namespace tinwright::io

#endif
