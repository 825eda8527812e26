#ifndef TINWRIGHT_DELAUNAY_SAMPLE_VERTICES_HPP
#define TINWRIGHT_DELAUNAY_SAMPLE_VERTICES_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Which elevation a location gets when several samples share it.
enum class DuplicatePolicy { Error, First, Last, Min, Max, Mean, Median };

struct DuplicateOptions {
    DuplicatePolicy policy = DuplicatePolicy::Error;
    /// Elevations at one location that differ by at most this (unit of z, >= 0) do not conflict.
    double tolerance = 0;
};

struct DuplicateReport {
    std::size_t equal = 0;        ///< samples merged into another whose z was the same within the tolerance
    std::size_t conflicting = 0;  ///< samples merged into another at a location where z conflicts
    std::vector<DuplicateConflict> first;  ///< the first conflicts in vertex order, at most ten
};

/// The samples' distinct locations, ready to be triangulated.
struct SampleVertices {
    Lattice lattice;
    Box bounds;              ///< of the samples, CRS units
    LargeVector<Key2> keys;  ///< distinct, in curve order (geometry/curve.hpp)
    LargeVector<double> z;   ///< one a key
    /// The smallest index of the samples at each key; under policies First and Last, that of the one taken.
    LargeVector<std::uint32_t> sample;
    DuplicateReport duplicates;
};

/// Snaps samples on their lattice, orders them along the curve and merges duplicates.
///
/// Under `Error`, locations whose z differ within the tolerance get the mean of the sorted z; beyond it
/// DuplicateError is thrown. Throws InputError also for coordinates or elevations that are not finite, for
/// more than 2^29 samples, and where the lattice cannot tell two samples apart that the data do.
/// The result depends on the set of samples only, but for policies First and Last (and `sample`).
/// O(n log n) worst case, a radix sort in practice; parallel inside the caller's task arena.
SampleVertices make_sample_vertices(std::span<const Point3> samples, const DuplicateOptions& options = {});
/// On a lattice found before, for these samples and perhaps more.
SampleVertices make_sample_vertices(std::span<const Point3> samples, const FoundLattice& found,
                                    const DuplicateOptions& options);

/// The elevation that `policy` takes of those at one location, ascending; for First and Last the mean.
double choose_elevation(DuplicatePolicy policy, std::span<const double> z);

}  // namespace tinwright

#endif
