#ifndef TINWRIGHT_WATER_WATER_ROWS_HPP
#define TINWRIGHT_WATER_WATER_ROWS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/water/water_mesh.hpp"

namespace tinwright {

/// Faces of open water one after the other, from a junction (a face with three open neighbours), or an end (a
/// face with one), to the next, or round an island. The edges between them all lead from one bank to the
/// other.
struct WaterRow {
    static constexpr std::uint32_t kEnd = 0xFFFFFFFFU;
    std::size_t first = 0;      ///< of its edges in `WaterRows::edges`
    std::size_t last = 0;       ///< past them
    std::uint32_t from = kEnd;  ///< junctions; kEnd where the water ends
    std::uint32_t to = kEnd;
    bool is_closed = false;  ///< goes round: the last edge is the first once more
};

struct WaterRows {
    /// Half-edges of the faces that one goes on into: their origin is on the left bank.
    std::vector<HalfEdgeId> edges;
    std::vector<WaterRow> rows;
    std::vector<FaceId> junctions;
    std::vector<FaceId> lonely;  ///< faces without an open neighbour

    [[nodiscard]] std::span<const HalfEdgeId> edges_of(const WaterRow& row) const {
        return std::span(edges).subspan(row.first, row.last - row.first);
    }
};

/// Closed rows begin at their shortest edge. `is_open`: by face slot. O(slots).
WaterRows find_water_rows(const WaterMesh& water, const std::vector<bool>& is_open);

/// Whether an edge leads from open water to open water.
inline bool is_open_edge(const WaterMesh& water, const std::vector<bool>& is_open, HalfEdgeId h) {
    return !water.mesh.is_constrained(h) && is_open[face_of(h).value] &&
           is_open[face_of(water.mesh.twin(h)).value];
}

}  // namespace tinwright

#endif
