#include "tinwright/geometry/threads.hpp"

#include <algorithm>

#include <tbb/info.h>
#include <tbb/task_arena.h>

namespace tinwright {

int count_threads(int requested) {
    const int processors = tbb::info::default_concurrency();
    return requested > 0 ? std::min(requested, processors) : processors;
}

void run_with_threads(int requested, const std::function<void()>& work) {
    tbb::task_arena arena(count_threads(requested));
    arena.execute(work);
}

}  // namespace tinwright
