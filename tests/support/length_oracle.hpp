#ifndef TINWRIGHT_TESTS_SUPPORT_LENGTH_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_LENGTH_ORACLE_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "tinwright/geometry/norm.hpp"
#include "tinwright/mesh/tin.hpp"

#include "support/triangulation_oracle.hpp"

/// How short the longest edge of a triangulation can be, found without proximity graphs and lunes; and these
/// by their definitions. Shares no code with the library but its types.
namespace tinwright_tests::oracle {

/// Places of all pairs of a few points in a row, shortest first. O(n^2 log n), also in memory.
class LengthRanks {
  public:
    LengthRanks(tinwright::Norm norm, std::span<const tinwright::Key2> keys);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Of the length: 0 for a point and itself, else from 1; equal for equal lengths.
    [[nodiscard]] std::uint32_t rank(std::uint32_t a, std::uint32_t b) const { return rank_[a * size_ + b]; }
    /// Of the pair: none have equal places. Equal lengths by Euclidean length, then by numbers of points.
    [[nodiscard]] std::uint32_t place(std::uint32_t a, std::uint32_t b) const {
        return place_[a * size_ + b];
    }
    /// The rank of a triangle's longest edge.
    [[nodiscard]] std::uint32_t longest(const Triple& face) const {
        return std::max({rank(face[0], face[1]), rank(face[1], face[2]), rank(face[2], face[0])});
    }
    /// Whether x is nearer to both p and q, by place, than these are to each other.
    [[nodiscard]] bool is_in_lune(std::uint32_t x, std::uint32_t p, std::uint32_t q) const {
        return x != p && x != q && place(p, x) < place(p, q) && place(q, x) < place(p, q);
    }

  private:
    std::size_t size_;
    std::vector<std::uint32_t> rank_;
    std::vector<std::uint32_t> place_;
};

/// What is to be triangulated of a TIN: its vertices, with constraints around what is not terrain, and the
/// faces that are none, which are in every triangulation (corners ascending).
struct Terrain {
    Sites sites;
    std::set<Triple> voids;
    std::set<Edge> hidden;  ///< edges that no terrain face has
};
Terrain terrain_sites(const tinwright::Tin& tin);

/// The rank of the longest edge of the TIN's terrain faces.
std::uint32_t longest_edge(const tinwright::Tin& tin, const LengthRanks& ranks);

/// The least that rank can be over all triangulations of the terrain. By a list of them all, for about nine
/// vertices; by tabulated sweeps, for up to 16.
std::uint32_t least_longest_edge_listed(const Terrain& terrain, const LengthRanks& ranks);
std::uint32_t least_longest_edge(const Terrain& terrain, const LengthRanks& ranks);

/// The same for a polygon, its vertices counter-clockwise, by dynamic programming; it may touch itself. Empty
/// if it cannot be triangulated. O(n^3).
std::optional<std::uint32_t> least_longest_edge(std::span<const tinwright::Key2> keys,
                                                std::span<const std::uint32_t> ring,
                                                const LengthRanks& ranks);

/// The pairs that see each other within the terrain and have no vertex, seen by both, in their lune. O(n^3).
std::set<Edge> relative_neighbors(const tinwright::Tin& tin, const LengthRanks& ranks);

/// A part of the terrain that no edge divides but those of its own triangulation.
struct Region {
    std::vector<std::uint32_t> ring;  ///< counter-clockwise, with repetitions where it touches itself
    std::vector<Triple> faces;        ///< corners ascending, sorted
};
/// The regions that constrained edges, the border and `walls` leave, which must be edges of the TIN, by their
/// sorted rings; each ring begins with its first edge.
std::vector<Region> regions_of(const tinwright::Tin& tin, const std::set<Edge>& walls);

/// The rank of the longest edge of a region's faces.
std::uint32_t longest_edge(const Region& region, const LengthRanks& ranks);

/// The sides of a region whose inner half-lune holds a vertex of the region that is seen from both ends.
std::vector<Edge> long_sides(const Region& region, std::span<const tinwright::Key2> keys,
                             const LengthRanks& ranks);

}  // namespace tinwright_tests::oracle

#endif
