#include "tinwright/breaklines/sample_hull.hpp"

#include <algorithm>

#include <tbb/parallel_sort.h>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright {
namespace {

/// The chain of sorted keys that has all others on the side given: +1 left, -1 right.
std::vector<Key2> make_chain(std::span<const Key2> sorted, int side) {
    std::vector<Key2> chain;
    for (const Key2 key : sorted) {
        while (chain.size() > 1 && orient2d(chain[chain.size() - 2], chain.back(), key) != side) {
            chain.pop_back();
        }
        chain.push_back(key);
    }
    return chain;
}

/// Whether `key`, lexicographically between the chain's ends, is on the chain or on the side given.
bool is_beside(std::span<const Key2> chain, Key2 key, int side) {
    const auto after = std::upper_bound(chain.begin(), chain.end(), key, precedes);
    if (after == chain.end()) {
        return key == chain.back();
    }
    return orient2d(*(after - 1), *after, key) != -side;
}

}  // namespace

SampleHull::SampleHull(std::span<const Key2> keys) {
    std::vector<Key2> sorted(keys.begin(), keys.end());
    tbb::parallel_sort(sorted.begin(), sorted.end(), precedes);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    lower_ = make_chain(sorted, 1);
    upper_ = make_chain(sorted, -1);
}

bool SampleHull::covers(Key2 key) const {
    if (precedes(key, lower_.front()) || precedes(lower_.back(), key)) {
        return false;
    }
    return is_beside(lower_, key, 1) && is_beside(upper_, key, -1);
}

}  // namespace tinwright
