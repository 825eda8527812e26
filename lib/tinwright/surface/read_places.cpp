#include "tinwright/surface/read_places.hpp"

#include <cstddef>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace tinwright {

namespace {

constexpr std::size_t kBlock = 256;  // places that one thread takes at least

}  // namespace

std::vector<std::optional<SurfacePlace>> find_places(const SurfaceLocator& locator,
                                                     std::span<const Point2> positions) {
    std::vector<std::optional<SurfacePlace>> places(positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), kBlock), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            places[i] = locator.find(positions[i]);
        }
    });
    return places;
}

std::vector<SurfaceReading> read_places(const Interpolator& surface, std::span<const SurfacePlace> places) {
    std::vector<SurfaceReading> readings(places.size());
    tbb::enumerable_thread_specific<std::unique_ptr<SurfaceReader>> readers(
        [&surface] { return surface.make_reader(); });
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), kBlock), [&](const auto& range) {
        SurfaceReader& reader = *readers.local();
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            readings[i] = reader.read(places[i]);
        }
    });
    return readings;
}

}  // namespace tinwright
