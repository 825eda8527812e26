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

/// No field `water` where no face is.
std::size_t write_faces(TinDataset& dataset, const std::string& layer, const Tin& tin,
                        const WriteTinOptions& options, const Tick& tick);
std::size_t write_surface(TinDataset& dataset, const std::string& layer, const Tin& tin,
                          const WriteTinOptions& options, const Tick& tick);
/// All edges of terrain faces, or the constrained ones only. Of several lines along an edge the first by
/// source and feature is told, lines of water before others.
std::size_t write_edges(TinDataset& dataset, const std::string& layer, const Tin& tin,
                        const WriteTinOptions& options, bool constrained_only, const Tick& tick);
std::size_t write_vertices(TinDataset& dataset, const std::string& layer, const Tin& tin,
                           const WriteTinOptions& options, const Tick& tick);

/// Whether any face is water.
bool has_water(const WriteTinOptions& options);

/// Edges of terrain faces, and how many of them are constrained. O(slots).
struct EdgeCounts {
    std::size_t all = 0;
    std::size_t constrained = 0;
};
EdgeCounts count_edges(const TriangleMesh& mesh);

}  // namespace tinwright::io

#endif
