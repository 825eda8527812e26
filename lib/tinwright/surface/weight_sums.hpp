#ifndef TINWRIGHT_SURFACE_WEIGHT_SUMS_HPP
#define TINWRIGHT_SURFACE_WEIGHT_SUMS_HPP

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tinwright/surface/interpolator.hpp"

namespace tinwright {

/// Leaves each vertex once, with the sum of its weights in the order they came; vertices ascend.
inline void sum_weights(std::vector<VertexWeight>& weights) {
    std::stable_sort(weights.begin(), weights.end(),
                     [](const VertexWeight& a, const VertexWeight& b) { return a.vertex < b.vertex; });
    std::size_t count = 0;
    for (const VertexWeight& each : weights) {
        if (count > 0 && weights[count - 1].vertex == each.vertex) {
            weights[count - 1].weight += each.weight;
        } else {
            weights[count++] = each;
        }
    }
    weights.resize(count);
}

}  // namespace tinwright

#endif
