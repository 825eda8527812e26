#ifndef TINWRIGHT_OPTIMAL_POLYGON_DP_HPP
#define TINWRIGHT_OPTIMAL_POLYGON_DP_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/progress.hpp"

/// The best triangulation of a polygon by dynamic programming [gilbert1979; klincsek1980; tan1993, Sec. 2.2].
/// Slow and plain: for checkers, and for polygons that no faster method knows.
namespace tinwright {

/// What is made small over the faces of a polygon.
enum class PolygonCost : std::uint8_t { Maximum, Sum };

/// The measure of the face with its corners at these positions of the ring, ascending, which is
/// counter-clockwise. Infinity or NaN forbids the face. For lengths and criteria: `ring_measures.hpp`.
///
/// A function object, so that the algorithm is compiled once and stays out of the header: next to a measure
/// and a predicate the indirect call is small, and most faces are ruled out before they are measured.
using RingMeasure = std::function<double(std::uint32_t, std::uint32_t, std::uint32_t)>;

struct PolygonTriangulation {
    double cost = 0;  ///< the greatest measure of a face, or the sum of all
    /// Positions in the ring, ascending; n - 2 of them.
    std::vector<std::array<std::uint32_t, 3>> faces;
};

/// The table of the dynamic program, for a ring that grows and shrinks at its end: of a polygon with one
/// vertex more only what that vertex is a corner of is worked out anew. Entries are found when they are asked
/// for.
///
/// Time to fill it O(n^3) for n vertices; memory 8 n^2 bytes.
class PolygonTable {
  public:
    explicit PolygonTable(RingMeasure measure, PolygonCost cost = PolygonCost::Maximum)
        : measure_(std::move(measure)), is_sum_(cost == PolygonCost::Sum) {}

    [[nodiscard]] std::size_t size() const { return ring_.size(); }
    void push_back(Key2 vertex);
    /// Keeps the first `size` vertices and what is known of them.
    void truncate(std::size_t size);

    /// The least cost of the polygon of the vertices from i to j > i + 1; infinity if it has no
    /// triangulation. Of a maximum that is minus infinity the first found is taken: nothing can be less. A
    /// measure with no value but the two infinities thus asks, much faster, whether there is any
    /// triangulation. `progress` may throw Cancelled.
    double cost(std::uint32_t i, std::uint32_t j, const Progress& progress = {});
    /// The faces of that polygon, once its cost is known and finite or minus infinity.
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> faces(std::uint32_t i, std::uint32_t j) const;

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
    static constexpr std::uint32_t kUnknown = 0xFFFFFFFFU;
    struct Part {
        double cost = kInfinity;
        std::uint32_t middle = kUnknown;
    };
    /// A part that is being worked out, its face at the line from j to i having its third corner at k.
    struct Search {
        std::uint32_t i = 0;
        std::uint32_t j = 0;
        std::uint32_t k = 0;
        Part best;
        double measure = 0;
        bool is_measured = false;
    };

    [[nodiscard]] static std::size_t index(std::uint32_t i, std::uint32_t j) {
        return std::size_t{j} * (j - 1) / 2 + i;
    }
    [[nodiscard]] double measure(std::uint32_t i, std::uint32_t k, std::uint32_t j) const;
    [[nodiscard]] bool is_hopeless(double cost, const Part& best) const;
    void begin(std::uint32_t i, std::uint32_t j);
    bool go_on(Search& search);

    RingMeasure measure_;
    bool is_sum_;
    std::vector<Key2> ring_;
    std::vector<Part> parts_;       // by j, then i < j
    std::vector<Search> searches_;  // stack
};

/// Triangulates a polygon so that the cost is least. Empty if there is no triangulation: fewer than three
/// vertices, no area, a clockwise ring, or too many faces forbidden.
///
/// `ring`: the n vertices in counter-clockwise order, the polygon's interior being simply connected.
/// Consecutive vertices may be collinear, and the ring may touch itself: a vertex may come several times, an
/// edge once in each direction (a crack, [tan1993, Fig. 3.1]). All faces have positive area, decided exactly.
/// Of equal costs the triangulation is taken whose middle corners come first, so the result is unique.
///
/// The minimum-weight triangulation is the one of least sum when a face measures half its perimeter
/// (`half_perimeter`): an inner edge is counted half by each of its two faces, and the ring's own edges half
/// whatever the faces.
///
/// Time O(n^3), less where many faces are forbidden; memory 8 n^2 bytes, none if the edge from the last
/// vertex to the first has no face that is allowed. `progress` may throw Cancelled.
std::optional<PolygonTriangulation> triangulate_polygon(std::span<const Key2> ring,
                                                        const RingMeasure& measure,
                                                        PolygonCost cost = PolygonCost::Maximum,
                                                        const Progress& progress = {});

}  // namespace tinwright

#endif
