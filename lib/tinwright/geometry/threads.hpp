#ifndef TINWRIGHT_GEOMETRY_THREADS_HPP
#define TINWRIGHT_GEOMETRY_THREADS_HPP

namespace tinwright {

/// The number of threads to start when `requested` are asked for: all processors for 0, never more than there
/// are. No result depends on it.
int count_threads(int requested);

}  // namespace tinwright

#endif
