#include "tinwright/geometry/threads.hpp"

#include <algorithm>

#include <tbb/info.h>

namespace tinwright {

int count_threads(int requested) {
    const int processors = tbb::info::default_concurrency();
    return requested > 0 ? std::min(requested, processors) : processors;
}

}  // namespace tinwright
