#ifndef TINWRIGHT_IO_TIN_LAYERS_HPP
#define TINWRIGHT_IO_TIN_LAYERS_HPP

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/io/tin_dataset.hpp"

/// Private to the TIN writer: the layers of docs/formats.md, one function each. All return the number of
/// features written, throw IoError, and call `tick` once a feature.
namespace tinwright::io {

using Tick = std::function<void()>;

/// `is_water_face`: by slot; empty: no field `water`.
std::size_t write_faces(TinDataset& dataset, const std::string& layer, const Tin& tin,
                        const std::vector<bool>& is_water_face, const Tick& tick);
std::size_t write_surface(TinDataset& dataset, const std::string& layer, const Tin& tin, const Tick& tick);
/// All edges of terrain faces, or the constrained ones only. Of several lines along an edge the first by
/// source and feature is told, lines of water before others.
std::size_t write_edges(TinDataset& dataset, const std::string& layer, const Tin& tin,
                        std::span<const LineOrigin> lines, bool constrained_only, const Tick& tick);
std::size_t write_vertices(TinDataset& dataset, const std::string& layer, const Tin& tin,
                           const VertexOrigins& origins, const Tick& tick);

/// Edges of terrain faces, and how many of them are constrained. O(slots).
struct EdgeCounts {
    std::size_t all = 0;
    std::size_t constrained = 0;
};
EdgeCounts count_edges(const TriangleMesh& mesh);

}  // namespace tinwright::io

#endif
