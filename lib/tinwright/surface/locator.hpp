#ifndef TINWRIGHT_SURFACE_LOCATOR_HPP
#define TINWRIGHT_SURFACE_LOCATOR_HPP

#include <memory>
#include <optional>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// Finds the face that a position is on, for any TIN: with voids, holes, or of several parts.
class SurfaceLocator {
  public:
    /// `tin` must outlive it. O(slots log slots), parallel inside the caller's task arena; 50 bytes a face.
    explicit SurfaceLocator(const Tin& tin);
    ~SurfaceLocator();
    SurfaceLocator(const SurfaceLocator&) = delete;
    SurfaceLocator& operator=(const SurfaceLocator&) = delete;

    /// The terrain face of smallest id whose closure holds the place; empty outside the terrain. Exact for
    /// the place as rounded. O(log n).
    [[nodiscard]] std::optional<SurfacePlace> find(Key2 at) const;
    /// The same for a position in CRS units.
    [[nodiscard]] std::optional<SurfacePlace> find(Point2 position) const;

    [[nodiscard]] const QueryLattice& lattice() const;

  private:
    struct State;
    std::unique_ptr<const State> state_;
};

}  // namespace tinwright

#endif
