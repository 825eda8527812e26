#ifndef TINWRIGHT_SURFACE_BREAKLINE_DISTANCE_HPP
#define TINWRIGHT_SURFACE_BREAKLINE_DISTANCE_HPP

#include <memory>
#include <vector>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/surface_place.hpp"

namespace tinwright {

/// How far places are from the nearest breakline, seen from above.
///
/// Edges of terrain faces count that a breakline runs along, and constrained ones within the terrain that no
/// line says anything of. Those of a boundary or a hole do not.
class BreaklineDistance {
  public:
    /// `is_breakline`: for each line that `Tin::traces` number; lines beyond its end are breaklines.
    /// O(slots log traces), O(m log m) for m edges found. Does not keep a reference.
    BreaklineDistance(const Tin& tin, const std::vector<bool>& is_breakline);
    ~BreaklineDistance();
    BreaklineDistance(const BreaklineDistance&) = delete;
    BreaklineDistance& operator=(const BreaklineDistance&) = delete;

    /// Whether there is no breakline.
    [[nodiscard]] bool is_empty() const;
    /// To the nearest one, CRS units, to a few units in the last place; infinite without any. O(log m) for
    /// places near one. May be called from several threads at a time.
    [[nodiscard]] double at(Key2 at) const;
    /// On the ground, to the point of breaklines that is nearest in the plane; `ground.unit`.
    [[nodiscard]] double at(Key2 at, const GroundMeasures& ground) const;

  private:
    struct State;
    std::unique_ptr<const State> state_;
};

}  // namespace tinwright

#endif
