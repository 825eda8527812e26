#ifndef TINWRIGHT_OPTIMAL_RING_MEASURES_HPP
#define TINWRIGHT_OPTIMAL_RING_MEASURES_HPP

#include <span>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/norm.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/optimal/polygon_dp.hpp"

/// What `triangulate_polygon` may make small. Each measure refers to what it was made of, which must outlive
/// it.
namespace tinwright {

/// The longest side of a face, in keys. Its least maximum is the min-max length of the polygon.
RingMeasure longest_side(std::span<const Key2> ring, Norm norm = {});

/// Half the perimeter of a face, in keys. Its least sum is the minimum weight: the length of all inner edges
/// and half that of the ring.
RingMeasure half_perimeter(std::span<const Key2> ring, Norm norm = {});

/// A criterion's measure of a face, for a ring of vertices of a TIN; in the criterion's unit, negated where
/// greater is better. `norm`: for length.
RingMeasure criterion_measure(const Tin& tin, std::span<const VertexId> ring, Criterion criterion,
                              Norm norm = {});

}  // namespace tinwright

#endif
