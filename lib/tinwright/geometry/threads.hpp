#ifndef TINWRIGHT_GEOMETRY_THREADS_HPP
#define TINWRIGHT_GEOMETRY_THREADS_HPP

#include <functional>

namespace tinwright {

/// The number of threads to start when `requested` are asked for: all processors for 0, never more than there
/// are. No result depends on it.
int count_threads(int requested);

/// Does `work` in a task arena of so many threads: what it does in parallel uses them.
void run_with_threads(int requested, const std::function<void()>& work);

}  // namespace tinwright

#endif
