#ifndef TINWRIGHT_SURFACE_PROFILE_HPP
#define TINWRIGHT_SURFACE_PROFILE_HPP

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// A place on a line that is laid over a surface.
struct ProfilePoint {
    enum class Kind : std::uint8_t {
        Line,    ///< a point of the line
        Vertex,  ///< the line passes a vertex of the TIN
        Edge,    ///< the line crosses an edge
        Step     ///< a whole number of steps from the line's start
    };
    static constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

    Point2 position{};  ///< CRS units; of a point of the line as given
    /// From the line's start along it, seen from above, `ProfileOptions::ground.unit`: lengths of the
    /// segments before, and that from the start of its own.
    double chainage = 0;
    Kind kind = Kind::Line;
    /// The part of the profile that it belongs to, from 0: a new one starts wherever the line comes back to
    /// the terrain. `kOutside`: the place is not on the terrain.
    std::uint32_t part = kOutside;
    /// The face that the line goes on over; where a part ends, the one that it came over. Along an edge, of
    /// the faces on both sides the one of smaller id. Empty outside.
    std::optional<SurfacePlace> place;
};

struct ProfileOptions {
    /// Every edge and vertex that the line meets is a point; else only those where it enters or leaves the
    /// terrain.
    bool has_cuts = true;
    double step = 0;  ///< distance of further points along the line, `ground.unit`; 0: none
    /// Of chainages. Points that are steps on the ground are found to 10^-7 of a unit, before they are
    /// rounded.
    GroundMeasures ground{};
};

/// Lays lines over the terrain of a TIN, whatever its shape: with holes, voids, or of several parts.
class ProfileCutter {
  public:
    /// `tin` must outlive it. O(slots log slots), parallel inside the caller's task arena; 50 bytes a face.
    explicit ProfileCutter(const Tin& tin);
    ~ProfileCutter();
    ProfileCutter(const ProfileCutter&) = delete;
    ProfileCutter& operator=(const ProfileCutter&) = delete;

    /// The points of the profile along a line of one point or more, in order; points of the line that repeat
    /// the one before are left out. Which faces are met, and in which order, is decided exactly for the
    /// line's points as the TIN's `QueryLattice` rounds them (of what lies farther out than predicates reach,
    /// for the points where the line comes near); crossings are rounded to that lattice once. O(k log k) for
    /// k faces met, and O(log n) a segment. May be called from several threads at a time.
    /// Throws InputError for a position that is not finite, and for more than 10^8 points.
    [[nodiscard]] std::vector<ProfilePoint> cut(std::span<const Point2> line,
                                                const ProfileOptions& options = {}) const;

  private:
    struct State;
    std::unique_ptr<const State> state_;
};

}  // namespace tinwright

#endif
