#ifndef TINWRIGHT_BREAKLINES_CLEAN_LINE_HPP
#define TINWRIGHT_BREAKLINES_CLEAN_LINE_HPP

#include <limits>
#include <span>
#include <vector>

#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"

/// What can be put right in one line without looking at any other.
namespace tinwright {

/// A line on the lattice: one point or more, consecutive ones distinct; a closed line repeats its first point
/// at its end.
struct CleanLine {
    std::vector<Key2> keys;
    std::vector<double> z;  ///< one a key; NaN: none

    /// Whether it goes round something: four points or more, the last one at the first.
    [[nodiscard]] bool is_closed() const { return keys.size() > 3 && keys.front() == keys.back(); }
};

/// A place where a line was put right: ZeroLength, Spike or OpenRing.
struct LineFault {
    LineConflict::Kind kind = LineConflict::Kind::ZeroLength;
    Key2 key{};
    double z_a = std::numeric_limits<double>::quiet_NaN();  ///< of the point kept, or of the spike's tip
    double z_b = std::numeric_limits<double>::quiet_NaN();  ///< ZeroLength: of a point merged with it,
                                                            ///< another z if any has one
};

struct CleanOptions {
    double snap = 0;       ///< in keys, >= 0: a tip this narrow is a spike
    bool is_ring = false;  ///< is to be closed
    /// z of points at one location; Error takes the mean.
    CrossingPolicy crossing_z = CrossingPolicy::Mean;
};

/// Merges consecutive points at one location (a line of one point is listed too), closes a ring that is open,
/// and cuts off spikes: places where the line turns back exactly on itself, or so narrowly that the end of
/// the shorter arm is within `snap` of the longer one (the shorter arm itself being longer than `snap`). Cut
/// off is what lies twice over itself; at the end of an open line that turns back, the part that turned back.
/// `points`: one or more, x and y finite. Appends what was found to `faults`. O(n).
CleanLine clean_line(std::span<const Point3> points, const Lattice& lattice, const CleanOptions& options,
                     std::vector<LineFault>& faults);

/// One elevation for several at one location, NaN among them left out; NaN if there is no other.
double merge_z(std::vector<double> z, CrossingPolicy policy);

}  // namespace tinwright

#endif
