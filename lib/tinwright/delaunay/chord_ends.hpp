#ifndef TINWRIGHT_DELAUNAY_CHORD_ENDS_HPP
#define TINWRIGHT_DELAUNAY_CHORD_ENDS_HPP

#include <span>
#include <vector>

#include "tinwright/delaunay/lines_in_disks.hpp"

namespace tinwright {

/// Moves the ends of chords a little along their lines, so that rounding to the lattice does not cost them
/// their empty disks.
///
/// All ends on one circle are co-circular: the chords are Delaunay edges, but so is any other edge between
/// the ends, and after rounding any triangulation of the polygon they span may be the Delaunay one. The
/// power of each end with regard to the circle becomes a convex function of its place that is linear but for
/// a crease along each chord: then the chords, and little else, are Delaunay [edelsbrunner1986]. A crease is
/// no deeper than what rounding can do to the end nearest to it; ends move by some steps of the lattice.
/// O(k^2) for k chords in a disk; disks with more than a thousand are left as they are.
void move_chord_ends(const BlockingDisks& disks, std::span<const Key2> keys, std::span<LineInDisks> edges);

}  // namespace tinwright

#endif
