#ifndef TINWRIGHT_SURFACE_BAND_INDEX_HPP
#define TINWRIGHT_SURFACE_BAND_INDEX_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

namespace tinwright {

/// Rows first..last, both included; empty when last < first.
struct RowRange {
    std::int32_t first = 0;
    std::int32_t last = -1;
};

/// Which items (numbered from 0) meet which band of rows: a counting sort.
class BandIndex {
  public:
    BandIndex() = default;

    /// `rows_of(i)` gives the RowRange of item i, within the raster. Two passes over the items, parallel
    /// inside the caller's task arena. Memory: 4 bytes an item and band it meets.
    template <class RowsOf>
    BandIndex(std::size_t items, std::size_t bands, std::int64_t band_rows, const RowsOf& rows_of);

    /// Items of a band, ascending.
    [[nodiscard]] std::span<const std::uint32_t> band(std::size_t band) const {
        return std::span(items_).subspan(start_[band], start_[band + 1] - start_[band]);
    }

  private:
    std::vector<std::uint32_t> items_;
    std::vector<std::size_t> start_;
};

template <class RowsOf>
BandIndex::BandIndex(std::size_t items, std::size_t bands, std::int64_t band_rows, const RowsOf& rows_of)
    : start_(bands + 1) {
    // Few chunks, so that their tables of one counter a band stay small beside the items.
    const std::size_t chunks = std::clamp<std::size_t>(items / (bands + 4096), 1, 64);
    std::vector<std::size_t> next(chunks * bands);
    const auto for_each_entry = [&](std::size_t chunk, const auto& visit) {
        std::size_t* counter = next.data() + chunk * bands;
        const std::size_t end = items * (chunk + 1) / chunks;
        for (std::size_t i = items * chunk / chunks; i < end; ++i) {
            const RowRange rows = rows_of(i);
            if (rows.last < rows.first) {
                continue;
            }
            const auto last = static_cast<std::size_t>(rows.last / band_rows);
            for (auto band = static_cast<std::size_t>(rows.first / band_rows); band <= last; ++band) {
                visit(counter[band], i);
            }
        }
    };
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        for_each_entry(chunk, [](std::size_t& counter, std::size_t) { ++counter; });
    });
    std::size_t total = 0;
    for (std::size_t band = 0; band < bands; ++band) {
        start_[band] = total;
        for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
            const std::size_t count = next[chunk * bands + band];
            next[chunk * bands + band] = total;
            total += count;
        }
    }
    start_[bands] = total;
    items_.resize(total);
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t chunk) {
        for_each_entry(chunk, [&](std::size_t& counter, std::size_t i) {
            items_[counter++] = static_cast<std::uint32_t>(i);
        });
    });
}

}  // namespace tinwright

#endif
