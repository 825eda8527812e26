#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "tinwright/delaunay/half_lune_search.hpp"
#include "tinwright/delaunay/octant_search.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

constexpr std::uint32_t kSlotsPerReport = 1U << 17U;
constexpr std::uint32_t kSlotsPerTask = 4096;
constexpr std::size_t kTasksPerReport = 64;
constexpr std::size_t kVerticesPerTask = 64;  // in clusters one may take a millisecond

// Calls visit(search, f) for every face slot.
template <class Visit>
void for_each_slot(const TriangleMesh& mesh, std::span<const Key2> keys, LuneRim rim,
                   const Progress& progress, const Visit& visit) {
    const auto slots = static_cast<std::uint32_t>(mesh.slot_count());
    using Slots = tbb::blocked_range<std::uint32_t>;
    for (std::uint32_t begin = 0; begin < slots; begin += std::min(kSlotsPerReport, slots - begin)) {
        report_progress(progress, static_cast<double>(begin) / slots);
        const std::uint32_t end = begin + std::min(kSlotsPerReport, slots - begin);
        tbb::parallel_for(Slots(begin, end, kSlotsPerTask), [&](const Slots& block) {
            HalfLuneSearch search(mesh, keys, rim);
            for (std::uint32_t f = block.begin(); f < block.end(); ++f) {
                visit(search, FaceId{f});
            }
        });
    }
}

// Marks the half-edges of a face whose edge may be in the graph as far as their side goes. Collinear vertices
// have no terrain, but edges between two ghosts.
void mark_face(const TriangleMesh& mesh, FaceId f, const HalfLuneSearch& search,
               std::vector<std::uint8_t>& marks) {
    if (!mesh.is_terrain(f)) {
        const bool is_row = mesh.is_ghost(f) && mesh.is_ghost(face_of(mesh.twin(half_edge(f, 0))));
        for (unsigned i = 0; i < 3; ++i) {
            marks[half_edge(f, i).value] =
                mesh.is_terrain(face_of(mesh.twin(half_edge(f, i)))) || (is_row && i == 0) ? 1 : 0;
        }
        return;
    }
    const unsigned occupied = search.find_occupied(f);
    for (unsigned i = 0; i < 3; ++i) {
        marks[half_edge(f, i).value] = i != occupied ? 1 : 0;
    }
}

// Leaves an edge of the face marked on both sides or on none; each edge is looked at from its lower
// half-edge.
void settle_face(const TriangleMesh& mesh, FaceId f, HalfLuneSearch& search,
                 std::vector<std::uint8_t>& marks) {
    for (unsigned i = 0; i < 3; ++i) {
        const HalfEdgeId h = half_edge(f, i);
        const HalfEdgeId twin = mesh.twin(h);
        if (twin < h) {
            continue;
        }
        const auto is_clear = [&](HalfEdgeId side) {
            return !mesh.is_terrain(face_of(side)) || search.is_empty(side);
        };
        const bool is_in_graph =
            marks[h.value] != 0 && marks[twin.value] != 0 && is_clear(h) && is_clear(twin);
        marks[h.value] = is_in_graph ? 1 : 0;
        marks[twin.value] = marks[h.value];
    }
}

std::vector<std::uint8_t> mark_edges(const TriangleMesh& mesh, std::span<const Key2> keys, LuneRim rim,
                                     const Progress& progress) {
    std::vector<std::uint8_t> marks(4 * mesh.slot_count());
    report_progress(progress, 0);
    for_each_slot(mesh, keys, rim, {},
                  [&](const HalfLuneSearch& search, FaceId f) { mark_face(mesh, f, search, marks); });
    for_each_slot(mesh, keys, rim, progress,
                  [&](HalfLuneSearch& search, FaceId f) { settle_face(mesh, f, search, marks); });
    report_progress(progress, 1);
    return marks;
}

// The edges with marks, ascending.
std::vector<GraphEdge> list_edges(const TriangleMesh& mesh, const std::vector<std::uint8_t>& marks) {
    std::vector<GraphEdge> edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (marks[h.value] != 0 && mesh.origin(h) < mesh.destination(h)) {
                edges.push_back({mesh.origin(h), mesh.destination(h)});
            }
        }
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    return edges;
}

// The edges of collinear vertices, ascending: those of the mesh, which has no faces but ghosts.
std::vector<GraphEdge> list_row(const TriangleMesh& mesh) {
    std::vector<std::uint8_t> marks(4 * mesh.slot_count());
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        marks[half_edge({f}, 0).value] = 1;
    }
    return list_edges(mesh, marks);
}

std::vector<GraphEdge> search_octants(const TriangleMesh& mesh, std::span<const Key2> keys, Norm norm,
                                      LuneRim rim, const Progress& progress) {
    const std::vector<HalfEdgeId> starts = find_starts(mesh);
    const std::size_t blocks = (keys.size() + kVerticesPerTask - 1) / kVerticesPerTask;
    std::vector<std::vector<GraphEdge>> found(blocks);
    for (std::size_t begin = 0; begin < blocks; begin += kTasksPerReport) {
        report_progress(progress, static_cast<double>(begin) / static_cast<double>(blocks));
        tbb::parallel_for(begin, std::min(begin + kTasksPerReport, blocks), [&](std::size_t block) {
            OctantSearch search(mesh, keys, norm, rim);
            const std::size_t end = std::min((block + 1) * kVerticesPerTask, keys.size());
            for (std::size_t v = block * kVerticesPerTask; v < end; ++v) {
                if (starts[v] != kNoHalfEdge) {
                    search.find({static_cast<std::uint32_t>(v)}, starts[v], found[block]);
                }
            }
        });
    }
    std::vector<GraphEdge> edges;
    for (const std::vector<GraphEdge>& of_block : found) {
        edges.insert(edges.end(), of_block.begin(), of_block.end());
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    report_progress(progress, 1);
    return edges;
}

}  // namespace

std::vector<std::uint8_t> mark_relative_neighbors(const TriangleMesh& mesh, std::span<const Key2> keys,
                                                  const Progress& progress) {
    return mark_edges(mesh, keys, LuneRim::Ordered, progress);
}

std::vector<GraphEdge> make_relative_neighborhood_graph(const TriangleMesh& mesh, std::span<const Key2> keys,
                                                        Norm norm, LuneRim rim, const Progress& progress) {
    if (norm.is_euclidean()) {
        return list_edges(mesh, mark_edges(mesh, keys, rim, progress));
    }
    bool is_row = true;
    for (std::uint32_t f = 0; f < mesh.slot_count() && is_row; ++f) {
        is_row = mesh.is_ghost({f});
    }
    return is_row ? list_row(mesh) : search_octants(mesh, keys, norm, rim, progress);
}

}  // namespace tinwright
