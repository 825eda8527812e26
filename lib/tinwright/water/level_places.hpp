#ifndef TINWRIGHT_WATER_LEVEL_PLACES_HPP
#define TINWRIGHT_WATER_LEVEL_PLACES_HPP

#include <cstdint>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/water/water_mesh.hpp"
#include "tinwright/water/water_rows.hpp"

namespace tinwright {

/// Junctions that share vertices, taken together.
class LevelPlaces {
  public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

    struct Place {
        std::vector<VertexId> vertices;  ///< corners of the junctions, ascending
        Point2 middle{};                 ///< of the junction that is most in the middle
        double width = 0;                ///< the longest side of a junction
    };

    LevelPlaces(const WaterMesh& water, const WaterRows& rows);

    /// Numbered by their smallest vertex.
    [[nodiscard]] const std::vector<Place>& places() const { return places_; }
    [[nodiscard]] std::uint32_t place_at(VertexId v) const { return place_of_vertex_[v.value]; }
    /// Appends the shortest way, by the middles of edges, from the middle of the place to its junction: from
    /// the place's middle, included, to the last edge before the junction.
    void append_way(std::uint32_t junction, std::vector<Point2>& way) const;

  private:
    void group();
    void find_middles();
    void find_ways();
    [[nodiscard]] std::uint32_t place_of_junction(std::uint32_t junction) const {
        return place_at(water_->mesh.vertex(rows_->junctions[junction], 0));
    }
    [[nodiscard]] Point2 center(std::uint32_t junction) const;

    const WaterMesh* water_;
    const WaterRows* rows_;
    std::vector<Place> places_;
    std::vector<std::uint32_t> place_of_vertex_;
    std::vector<std::uint32_t> middle_junction_;  // of each place
    std::vector<std::uint32_t> row_before_;       // of each junction, on the way from the middle
};

}  // namespace tinwright

#endif
