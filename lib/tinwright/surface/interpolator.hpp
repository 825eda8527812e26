#ifndef TINWRIGHT_SURFACE_INTERPOLATOR_HPP
#define TINWRIGHT_SURFACE_INTERPOLATOR_HPP

#include <memory>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/surface_place.hpp"

/// What every way of reading a surface between its vertices has in common. What each does at the hull, at
/// breaklines and at peaks: docs/interpolation.md.
namespace tinwright {

/// Elevation and slope of a surface at a place.
struct SurfaceReading {
    double z = 0;
    Point2 gradient{};  ///< of z along x and y, z units over CRS units
};

/// The share that a vertex has in the elevation at a place.
struct VertexWeight {
    VertexId vertex{};
    double weight = 0;
};

/// Reads one surface, place after place, on one thread: keeps what it can use again for the next place. What
/// it says of a place depends on nothing read before.
class SurfaceReader {
  public:
    SurfaceReader() = default;
    virtual ~SurfaceReader() = default;
    SurfaceReader(const SurfaceReader&) = delete;
    SurfaceReader& operator=(const SurfaceReader&) = delete;

    /// Elevation; at a vertex its own, bit for bit (`nearest`: of a vertex that was given).
    virtual double elevation(const SurfacePlace& place) = 0;
    /// Elevation (the same bits) and gradient. Where the surface has a crease, or a vertex that it is not
    /// differentiable at, the gradient is that on the side of `place.face`.
    virtual SurfaceReading read(const SurfacePlace& place) = 0;
    /// The shares of the vertices, in no particular order, each vertex once: they sum to one, and the
    /// elevation is the sum of shares times z, but for what a method clamps afterwards. For a method that
    /// estimates gradients, vertices that count only through them have shares as well, some negative.
    virtual void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) = 0;
};

/// A surface over the terrain of a TIN that passes through its vertices.
///
/// Outside the terrain there is no surface: only places on terrain faces can be read. The TIN must outlive
/// the interpolator, and the interpolator its readers.
class Interpolator {
  public:
    Interpolator() = default;
    virtual ~Interpolator() = default;
    Interpolator(const Interpolator&) = delete;
    Interpolator& operator=(const Interpolator&) = delete;

    /// One for each thread; may be called from several threads at a time.
    [[nodiscard]] virtual std::unique_ptr<SurfaceReader> make_reader() const = 0;
    /// Whether the surface is the face itself there by decree (`keep_facets`), whatever the method does next
    /// to it: the side that the face's edges are best read from.
    [[nodiscard]] virtual bool is_facet(FaceId /*face*/) const { return false; }
};

}  // namespace tinwright

#endif
