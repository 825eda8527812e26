#include "vertex_origins.hpp"

#include <algorithm>
#include <cstddef>

namespace tinwright::tools {

io::VertexOrigins make_vertex_origins(const Tin& tin, std::span<const io::SampleSlice> slices,
                                      bool keep_ids) {
    std::size_t sources = 0;
    bool any_feature = false;
    for (const io::SampleSlice& slice : slices) {
        sources = std::max(sources, slice.source + 1);
        any_feature = any_feature || keep_ids || slice.kind == io::SampleSlice::Kind::Vector;
    }
    std::vector<std::int32_t> number(sources, 0);  // 0: owns no vertex yet
    std::int32_t numbered = 0;

    io::VertexOrigins origins;
    origins.source.resize(tin.vertex_count(), 0);
    if (any_feature) {
        origins.feature.resize(tin.vertex_count(), -1);
    }
    for (std::size_t v = 0; v < tin.vertex_count(); ++v) {
        const std::size_t sample = tin.sample[v];
        if (sample == Tin::kNoSample) {
            continue;
        }
        // The last slice that begins at or before the sample; empty slices begin where the next one does.
        const auto after =
            std::upper_bound(slices.begin(), slices.end(), sample,
                             [](std::size_t s, const io::SampleSlice& slice) { return s < slice.first; });
        const io::SampleSlice& slice = *std::prev(after);
        if (number[slice.source] == 0) {
            number[slice.source] = ++numbered;
        }
        origins.source[v] = number[slice.source];
        if (keep_ids || slice.kind == io::SampleSlice::Kind::Vector) {
            origins.feature[v] = slice.id(sample - slice.first);
        }
    }
    return origins;
}

}  // namespace tinwright::tools
