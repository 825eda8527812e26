#include "tinwright/surface/spline_store.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tinwright {

SplineBlock::SplineBlock(SplineFitter& fitter, std::uint32_t first, std::uint32_t last) : first_(first) {
    splines_.reserve(last - first);
    starts_.reserve(last - first);
    for (std::uint32_t v = first; v < last; ++v) {
        starts_.push_back(static_cast<std::uint32_t>(nodes_.size()));
        splines_.push_back(fitter.fit({v}, nodes_, coefficients_));
    }
    nodes_.shrink_to_fit();
    coefficients_.shrink_to_fit();
}

SplineBlock::View SplineBlock::view(VertexId v) const {
    const std::uint32_t i = v.value - first_;
    const VertexSpline& spline = splines_[i];
    return {spline, std::span(nodes_).subspan(starts_[i], spline.node_count),
            std::span(coefficients_).subspan(starts_[i], spline.node_count)};
}

std::size_t SplineBlock::bytes() const {
    return sizeof(*this) + splines_.capacity() * sizeof(VertexSpline) +
           starts_.capacity() * sizeof(std::uint32_t) + nodes_.capacity() * sizeof(VertexId) +
           coefficients_.capacity() * sizeof(double);
}

namespace {

std::size_t count_blocks(const Tin& tin) {
    return (tin.vertex_count() + SplineBlock::kBlock - 1) / SplineBlock::kBlock;
}

/// A row of a raster passes about the square root of the blocks' number, and threads read rows apart from
/// each other.
std::size_t first_limit(std::size_t blocks) {
    return 256 + 16 * static_cast<std::size_t>(std::sqrt(static_cast<double>(blocks)));
}

}  // namespace

SplineStore::SplineStore(const SplineSources& sources)
    : SplineStore(sources, first_limit(count_blocks(sources.tin))) {}

SplineStore::SplineStore(const SplineSources& sources, std::size_t limit)
    : tin_(sources.tin), places_(count_blocks(sources.tin)), limit_(limit) {}

std::shared_ptr<const SplineBlock> SplineStore::block_of(VertexId v, SplineFitter& fitter) {
    const std::uint32_t number = v.value / SplineBlock::kBlock;
    Place& place = places_[number];
    std::unique_lock lock(place.mutex, std::try_to_lock);
    if (!lock.owns_lock()) {
        fit_beside(number, fitter);
        lock.lock();
    }
    place.used.store(fitted_.load(std::memory_order_relaxed), std::memory_order_relaxed);
    if (place.block) {
        return place.block;
    }
    return fit(number, fitter, std::move(lock));
}

/// Another thread is fitting a block that this one needs too. Instead of waiting it fits one that both will
/// need soon: of those next to it on the curve the first that nobody has.
void SplineStore::fit_beside(std::uint32_t number, SplineFitter& fitter) {
    constexpr std::uint32_t kBeside = 16;
    for (std::uint32_t step = 1; step < kBeside; ++step) {
        const std::uint32_t other = number ^ step;
        if (other < places_.size()) {
            std::unique_lock lock(places_[other].mutex, std::try_to_lock);
            if (lock.owns_lock() && !places_[other].block && !places_[other].was_dropped) {
                places_[other].used.store(fitted_.load(std::memory_order_relaxed), std::memory_order_relaxed);
                fit(other, fitter, std::move(lock));
                return;
            }
        }
    }
}

/// Fits a block whose place is locked.
std::shared_ptr<const SplineBlock> SplineStore::fit(std::uint32_t number, SplineFitter& fitter,
                                                    std::unique_lock<std::mutex> lock) {
    Place& place = places_[number];
    const std::uint32_t first = number * SplineBlock::kBlock;
    const auto last = static_cast<std::uint32_t>(
        std::min<std::size_t>(first + std::size_t{SplineBlock::kBlock}, tin_.vertex_count()));
    auto block = std::make_shared<const SplineBlock>(fitter, first, last);
    place.block = block;
    const bool is_regretted = place.was_dropped;
    lock.unlock();
    fitted_.fetch_add(1, std::memory_order_relaxed);
    drop_oldest(number, is_regretted);
    return block;
}

void SplineStore::drop_oldest(std::uint32_t fitted, bool is_regretted) {
    const std::lock_guard lock(held_mutex_);
    held_.push_back(fitted);
    limit_ += is_regretted ? kRegret : 0;
    if (held_.size() <= limit_) {
        return;
    }
    const auto oldest = std::min_element(held_.begin(), held_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return places_[a].used.load(std::memory_order_relaxed) <
               places_[b].used.load(std::memory_order_relaxed);
    });
    Place& place = places_[*oldest];
    const std::unique_lock of_place(place.mutex, std::try_to_lock);
    if (of_place.owns_lock()) {
        place.block.reset();
        place.was_dropped = true;
        *oldest = held_.back();
        held_.pop_back();
    }
}

std::size_t SplineStore::bytes() const {
    std::size_t sum = places_.size() * sizeof(Place);
    for (const Place& place : places_) {
        sum += place.block ? place.block->bytes() : 0;
    }
    return sum;
}

}  // namespace tinwright
