#ifndef TINWRIGHT_IO_EACH_POINT_HPP
#define TINWRIGHT_IO_EACH_POINT_HPP

#include <cstddef>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/point.hpp"

namespace tinwright::io {

/// Calls `work(point, index)` for every point, in parallel inside the caller's task arena.
template <class Work>
void for_each_point(std::span<Point3> points, const Work& work) {
    constexpr std::size_t kPointsOfTask = 65536;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kPointsOfTask),
                      [&](const auto& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              work(points[i], i);
                          }
                      });
}

}  // namespace tinwright::io

#endif
