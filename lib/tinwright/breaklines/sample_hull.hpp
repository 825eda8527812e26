#ifndef TINWRIGHT_BREAKLINES_SAMPLE_HULL_HPP
#define TINWRIGHT_BREAKLINES_SAMPLE_HULL_HPP

#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// The convex hull of samples.
class SampleHull {
  public:
    /// `keys`: one or more, any order. O(n log n) [andrew1979].
    explicit SampleHull(std::span<const Key2> keys);

    /// Whether a key is inside or on the border. Exact. O(log n).
    [[nodiscard]] bool covers(Key2 key) const;

  private:
    // From the first to the last key in lexicographic order, along the lower and the upper side.
    std::vector<Key2> lower_;
    std::vector<Key2> upper_;
};

}  // namespace tinwright

#endif
