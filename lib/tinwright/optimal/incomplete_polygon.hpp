#ifndef TINWRIGHT_OPTIMAL_INCOMPLETE_POLYGON_HPP
#define TINWRIGHT_OPTIMAL_INCOMPLETE_POLYGON_HPP

#include <cstdint>
#include <functional>
#include <vector>

#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/wall_polygon.hpp"

namespace tinwright::internal {

/// Asked between the steps of long work; false: stop.
using Poll = std::function<bool()>;

/// Triangulates parts of a polygon, each beyond a base that its own vertices make long [tan1993, Sec. 5.4].
class IncompletePolygon {
  public:
    explicit IncompletePolygon(WallPolygon& polygon) : polygon_(polygon) {}

    /// The faces of the corners at positions i, i + 1, ... j, around the end of the ring if need be, appended
    /// to `faces`. The base, from j back to i, is a side of the polygon or a diagonal whose ends see a vertex
    /// of the part in their lune; of a diagonal the first face is taken so that it lies beneath its other
    /// edges, and `across` is what lies beyond the base.
    ///
    /// A vertex x is cut off with the base p q that both see in their lune, p x being empty towards q and q x
    /// towards p: then p x, if it is no side, is such a base again. There is one always: that with the least
    /// sum of distances [tan1993, Sec. 5.4]. Of those there are the one is taken whose longer distance is
    /// least. All new edges are shorter than the base. False if stopped, or if there is none after all.
    bool triangulate(std::uint32_t i, std::uint32_t j, CavityFace::Across across,
                     std::vector<CavityFace>& faces, const Poll& poll);

  private:
    struct Base {
        std::uint32_t i;
        std::uint32_t j;
        CavityFace::Across across;
    };

    [[nodiscard]] bool find_apex(const Base& base, std::uint32_t& apex);
    void add_base(std::uint32_t i, std::uint32_t j, std::uint32_t face, unsigned edge,
                  std::vector<CavityFace>& faces);

    WallPolygon& polygon_;
    std::vector<Base> bases_;  // stack
    std::vector<WallPolygon::Sight> space_i_;
    std::vector<WallPolygon::Sight> space_j_;
};

}  // namespace tinwright::internal

#endif
