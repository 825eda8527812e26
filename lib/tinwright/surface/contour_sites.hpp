#ifndef TINWRIGHT_SURFACE_CONTOUR_SITES_HPP
#define TINWRIGHT_SURFACE_CONTOUR_SITES_HPP

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/tin.hpp"

/// Private to contours: the vertices as levels see them.
namespace tinwright {

/// A vertex: where it is, and between which levels.
struct ContourSite {
    double x;
    double y;
    double z;
    std::uint32_t below;    ///< number of levels below z: the vertex is above level i if i < below
    std::uint32_t reached;  ///< number of levels at z or below
};

/// All vertices and levels. A level is meant infinitesimally above its value: what lies at it is below it.
class ContourSites {
  public:
    /// `levels`: ascending, distinct, fewer than 2^32 - 1; must outlive this. O(n log levels), parallel
    /// inside the caller's task arena; 36 bytes a vertex.
    ContourSites(const Tin& tin, std::span<const double> levels);
    ContourSites(std::span<const Point3> vertices, std::span<const double> levels);

    [[nodiscard]] const ContourSite& operator[](VertexId v) const { return sites_[v.value]; }
    [[nodiscard]] std::span<const double> levels() const { return levels_; }
    /// `ContourSite::below`, apart: it is asked for more often than all the rest.
    [[nodiscard]] std::uint32_t below(VertexId v) const { return below_[v.value]; }
    [[nodiscard]] bool is_above(VertexId v, std::uint32_t level) const { return below_[v.value] > level; }
    [[nodiscard]] bool is_at(VertexId v, std::uint32_t level) const {
        return sites_[v.value].below == level && sites_[v.value].reached == level + 1;
    }

    /// Where the edge between two vertices, one of them above the level and one not, meets it.
    ///
    /// Both faces of an edge, and the bands on both sides of a line, get the same bits: the expression knows
    /// the edge, not the side. Along an edge the points of ascending levels never go back: rounding keeps the
    /// order of c - z_a (a: the end with the smaller id), of its quotient by a constant, of the product with
    /// a constant, of the sum with one, and so does clamping between the ends' coordinates. As points of one
    /// edge keep their order along it, lines of different levels cross in no face.
    [[nodiscard]] Point2 crossing(VertexId u, VertexId v, std::uint32_t level) const {
        const double c = levels_[level];
        const ContourSite& a = sites_[std::min(u, v).value];
        const ContourSite& b = sites_[std::max(u, v).value];
        if (a.z == c) {
            return {a.x, a.y};
        }
        if (b.z == c) {
            return {b.x, b.y};
        }
        const double t = share(a.z, b.z, c);
        const auto along = [t](double from, double to) {
            const double place = from + t * (to - from);
            return std::min(std::max(place, std::min(from, to)), std::max(from, to));
        };
        return {along(a.x, b.x), along(a.y, b.y)};
    }

  private:
    static double share(double from, double to, double c) {
        const double rise = to - from;
        constexpr double kHuge = 0x1p1000;
        // Elevations near the greatest double have a rise beyond it.
        return rise < kHuge && rise > -kHuge ? (c - from) / rise : (c / 4 - from / 4) / (to / 4 - from / 4);
    }
    template <class PointOf>
    void fill(const PointOf& point_of);

    LargeVector<ContourSite> sites_;
    LargeVector<std::uint32_t> below_;
    std::span<const double> levels_;
};

/// From the first to below the last of something numbered by levels.
struct LevelRange {
    std::uint32_t first;
    std::uint32_t last;
};

/// Items (faces, half-edges) sorted by the levels they have part in; ascending within a level.
struct LevelLists {
    std::vector<std::size_t> begin;  // one more than levels
    LargeVector<std::uint32_t> items;

    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t level) const {
        return std::span(items).subspan(begin[level], begin[level + 1] - begin[level]);
    }
};

/// Throws UsageError for more crossings of faces and levels than memory holds sensibly.
void require_few_crossings(std::size_t count);

/// Item i has part in the levels `ranges[i]`. Throws as `require_few_crossings` does. O(items + entries),
/// parallel inside the caller's task arena.
LevelLists list_by_level(std::span<const LevelRange> ranges, std::size_t levels);

/// The levels that cross each face; none for slots that are not terrain.
LargeVector<LevelRange> crossed_levels(const TriangleMesh& mesh, const ContourSites& sites);

}  // namespace tinwright

#endif
