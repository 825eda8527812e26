#ifndef TINWRIGHT_DELAUNAY_WATER_AREAS_HPP
#define TINWRIGHT_DELAUNAY_WATER_AREAS_HPP

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_segments.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/delaunay/drape.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {

/// The insides of lakes and of banks, where only water counts.
class WaterAreas {
  public:
    /// `noded`: of `lines`, and perhaps of more lines behind them that are no water. O(n log n).
    WaterAreas(const NodedLines& noded, std::span<const Breakline> lines);
    ~WaterAreas() = default;
    WaterAreas(const WaterAreas&) = delete;
    WaterAreas& operator=(const WaterAreas&) = delete;

    [[nodiscard]] bool is_empty() const { return polygons_.empty(); }
    /// Role and number (`Breakline::polygon`) of a polygon.
    [[nodiscard]] std::pair<LineRole, std::uint32_t> polygon(std::uint32_t index) const {
        return polygons_[index];
    }
    /// A polygon that has the key strictly inside: of several the first, as a number for `level`; keys on a
    /// polygon's ring are not inside it. Exact. O(sqrt n + k) in practice for k ring segments to the right of
    /// it, in the boxes of polygons whose box it is in.
    [[nodiscard]] std::optional<std::uint32_t> around(Key2 key) const { return find(twice(key)); }
    /// The same for the middle of a piece.
    [[nodiscard]] std::optional<std::uint32_t> around(const NodedPiece& piece) const;
    /// Elevation of the water at a key inside a polygon: on the Delaunay TIN of its rings' vertices, so that
    /// of a lake exactly its level. O(n log n) the first time for a polygon.
    [[nodiscard]] double level(std::uint32_t polygon, Key2 key);

  private:
    /// Keys are doubled, so that the middle of a piece has one.
    static Key2 twice(Key2 key) { return {2 * key.x, 2 * key.y}; }
    [[nodiscard]] std::optional<std::uint32_t> find(Key2 key) const;

    /// The vertices of a polygon's rings, and the surface over them.
    struct Surface {
        std::vector<Key2> keys;
        std::vector<double> z;
        std::optional<Drape> drape;
    };

    const NodedLines& noded_;
    std::vector<std::pair<LineRole, std::uint32_t>> polygons_;  // ascending
    std::vector<CleanLine> sides_;
    std::vector<std::uint32_t> polygon_of_;                      // each side: index of its polygon
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_;  // of each side: vertices
    std::optional<LineSegments> segments_;
    std::vector<KeyBox> boxes_;  // one a polygon
    std::optional<BoxTree> tree_of_boxes_;
    std::map<std::uint32_t, std::unique_ptr<Surface>> surfaces_;
};

/// What of samples and lines water takes the place of.
struct ClearedAreas {
    std::vector<char> samples;  ///< one a sample: whether it is left out
    std::size_t sample_count = 0;
    std::vector<char> vertices;  ///< one a noded vertex: likewise
    std::size_t piece_count = 0;
    std::vector<std::uint32_t> borders;  ///< noded vertices of borders that have the elevation of the water
};

/// Finds what is strictly inside lakes and banks, and takes the pieces of breaklines and rivers there out of
/// `noded`. `samples`: keys on the lattice of `noded`. O((n + k) log n) in practice, parallel inside the
/// caller's task arena.
ClearedAreas clear_areas(const WaterAreas& areas, std::span<const Breakline> lines,
                         std::span<const Key2> samples, NodedLines& noded);

}  // namespace tinwright

#endif
