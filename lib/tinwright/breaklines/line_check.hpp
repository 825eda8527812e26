#ifndef TINWRIGHT_BREAKLINES_LINE_CHECK_HPP
#define TINWRIGHT_BREAKLINES_LINE_CHECK_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"

/// Audit of lines and samples as they came, before anything is made of them.
namespace tinwright {

/// What an audit has to know of a line beyond its points. Of roles Boundary and Hole only `is_draped` counts:
/// they are rings anyway, and `Breakline::polygon` numbers their polygons.
struct LineTraits {
    bool is_ring = false;       ///< ring of a polygon
    std::uint32_t polygon = 0;  ///< of a ring: rings of one role with the same number belong together
    bool is_draped = false;     ///< may lack z, since it is to be taken from the samples
};

struct LineCheckOptions {
    /// Distance (CRS units, >= 0) below which points count as missed by an oversight. Empty: the power of ten
    /// that is at most a thousandth of the median length of the lines' segments.
    std::optional<double> snap;
    /// An end is dangling when prolonging its line by this (CRS units, >= 0) would reach another line. Empty:
    /// fifty times the default of `snap`.
    std::optional<double> dangling;
    double crossing_tolerance = 0;  ///< elevations that differ by at most this (unit of z, >= 0) agree
    double line_tolerance = 0;      ///< samples closer to a line than this (CRS units, >= 0) are listed
    /// One a line; or empty: default ones, boundaries and holes without any z to be draped.
    std::vector<LineTraits> traits;
    Progress progress;
};

struct LineCheckReport {
    /// By kind, then location in curve order, then lines. Action is `Reported` throughout.
    std::vector<LineConflict> conflicts;
    double snap = 0;  ///< the distances used, CRS units
    double dangling = 0;
};

/// Finds everything in lines and samples that a triangulation would have to sort out, or could not.
///
/// Crossing, SelfCrossing, Touch, Overlap, Duplicate, ElevationClash: as `node_lines` lists them; crossings
/// and touches whatever their z, since only a common point of both lines makes them harmless. Lines that
/// share points, stretches between two such points that polygons have in common or that have different roles,
/// and closed rings are no conflict as long as their z agree. ElevationClash is also listed for two samples
/// at one location. ZeroLength, Spike, OpenRing: as `clean_line` finds them, one a run of points, tip, or
/// ring. NearMiss: a point no farther than `snap` from another line that it is not on, or the two ends of one
/// line so close to each other; one a pair of points, or a point and a line. Dangling: see
/// `LineCheckOptions::dangling`; line_a is the line that ends there, whichever has the smaller number.
/// MissingZ: one a run of points without z in a line that is not to be draped.
/// OutsideSamples: a draped breakline leaves the samples' hull; one a line. Not when there are no samples.
/// OutsideBoundary: one a connected part of a breakline or hole that no polygon of role Boundary covers.
/// SampleOnLine, SampleNearLine: one a sample and line.
///
/// All but distances is decided exactly, on the lattice that samples and lines share, refined as for
/// triangulating. `lines`: points finite in x and y, one a line at least. Throws InputError as `find_lattice`
/// does; UsageError for options out of range; Cancelled. O((n + k) log n) in practice for n points and k
/// conflicts; parallel inside the caller's task arena, same report for any number of threads.
LineCheckReport check_lines(std::span<const Breakline> lines, std::span<const Point3> samples,
                            const LineCheckOptions& options = {});

}  // namespace tinwright

#endif
