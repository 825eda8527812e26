#ifndef TINWRIGHT_SURFACE_SHARP_EDGES_HPP
#define TINWRIGHT_SURFACE_SHARP_EDGES_HPP

#include <cstdint>
#include <vector>

#include "tinwright/mesh/tin.hpp"

namespace tinwright {

/// The edges along which the surface of a TIN may have a crease, for interpolators that are smooth elsewhere.
///
/// An edge is sharp if one line or more along it is (`Breakline::is_sharp`), or if it is constrained and no
/// line says why. Edges of the border are not: the surface ends there.
class SharpEdges {
  public:
    /// None.
    SharpEdges() = default;
    /// `is_line_sharp`: for each line that `Tin::traces` number; lines beyond its end are sharp. O(slots).
    SharpEdges(const Tin& tin, const std::vector<bool>& is_line_sharp);

    [[nodiscard]] bool is_empty() const { return edges_.empty(); }
    /// For half-edges of terrain faces and their twins.
    [[nodiscard]] bool is_sharp(HalfEdgeId h) const {
        return !edges_.empty() && (edges_[face_of(h).value] >> corner_of(h) & 1U) != 0;
    }
    /// Whether a sharp edge ends at the vertex.
    [[nodiscard]] bool is_sharp(VertexId v) const { return !vertices_.empty() && vertices_[v.value]; }

  private:
    std::vector<std::uint8_t> edges_;  // by face: bit i for half-edge i; empty without sharp edges
    std::vector<bool> vertices_;       // by vertex; empty without sharp edges
};

}  // namespace tinwright

#endif
