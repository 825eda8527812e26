#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/delaunay/half_lune_search.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"

namespace tinwright {

namespace {

constexpr std::uint32_t kSlotsPerReport = 1U << 17U;
constexpr std::uint32_t kSlotsPerTask = 4096;

// Marks what the lower half-edge of each edge, that of `h` or its twin, stands for.
void mark_edge(const TriangleMesh& mesh, HalfEdgeId h, HalfLuneSearch& search,
               std::vector<std::uint8_t>& marks) {
    const HalfEdgeId twin = mesh.twin(h);
    if (twin < h) {
        return;
    }
    const bool is_terrain = mesh.is_terrain(face_of(h)) || mesh.is_terrain(face_of(twin));
    // Collinear vertices have no terrain, but edges between two ghosts.
    const bool is_of_row = mesh.is_ghost(face_of(h)) && mesh.is_ghost(face_of(twin)) && corner_of(h) == 0;
    if (is_of_row || (is_terrain && search.is_empty(h))) {
        marks[h.value] = 1;
        marks[twin.value] = 1;
    }
}

std::vector<std::uint8_t> mark_edges(const TriangleMesh& mesh, std::span<const Key2> keys, LuneRim rim,
                                     const Progress& progress) {
    const auto slots = static_cast<std::uint32_t>(mesh.slot_count());
    std::vector<std::uint8_t> marks(4 * mesh.slot_count());
    using Slots = tbb::blocked_range<std::uint32_t>;
    for (std::uint32_t begin = 0; begin < slots; begin += std::min(kSlotsPerReport, slots - begin)) {
        report_progress(progress, static_cast<double>(begin) / slots);
        const std::uint32_t end = begin + std::min(kSlotsPerReport, slots - begin);
        tbb::parallel_for(Slots(begin, end, kSlotsPerTask), [&](const Slots& block) {
            HalfLuneSearch search(mesh, keys, rim);
            for (std::uint32_t f = block.begin(); f < block.end(); ++f) {
                for (unsigned i = 0; i < 3; ++i) {
                    mark_edge(mesh, half_edge({f}, i), search, marks);
                }
            }
        });
    }
    report_progress(progress, 1);
    return marks;
}

}  // namespace

std::vector<std::uint8_t> mark_relative_neighbors(const TriangleMesh& mesh, std::span<const Key2> keys,
                                                  const Progress& progress) {
    return mark_edges(mesh, keys, LuneRim::Ordered, progress);
}

}  // namespace tinwright
