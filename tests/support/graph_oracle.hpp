#ifndef TINWRIGHT_TESTS_SUPPORT_GRAPH_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_GRAPH_ORACLE_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/norm.hpp"
#include "tinwright/mesh/tin.hpp"

#include "support/triangulation_oracle.hpp"

/// Who sees whom, and who is whose neighbour, by definition: every pair and every third vertex is looked at.
/// Shares no code with the library but its types; integers of any length.
namespace tinwright_tests::oracle {

/// Vertices and what is in the way between them.
struct Scene {
    std::vector<tinwright::Key2> keys;
    std::vector<Edge> walls;  ///< seen themselves; they cross neither each other nor a vertex
    std::vector<std::array<tinwright::Key2, 3>> voids;  ///< with walls between them and the rest
};

/// The TIN's vertices, without walls.
Scene open_scene(const tinwright::Tin& tin);
/// The TIN's vertices, its constrained edges and border as walls, its voids.
Scene scene_of(const tinwright::Tin& tin);

/// A relation of any two vertices.
class PairTable {
  public:
    explicit PairTable(std::size_t count) : count_(count), value_(count * count) {}
    [[nodiscard]] int operator()(std::uint32_t a, std::uint32_t b) const { return value_[a * count_ + b]; }
    void set(std::uint32_t a, std::uint32_t b, int value) {
        value_[a * count_ + b] = value;
        value_[b * count_ + a] = value;
    }

  private:
    std::size_t count_;
    std::vector<int> value_;
};

/// 1 where the open segment between two vertices meets neither vertex nor wall nor void, or is a wall.
/// O(n^3).
PairTable sights(const Scene& scene);

/// Numbers that compare as the lengths do. `Outside`: equal lengths have equal numbers. `Ordered`: they are
/// told apart by the Euclidean length, then by the lesser and the greater vertex.
enum class Ties { Equal, Ordered };
PairTable ranks(std::span<const tinwright::Key2> keys, tinwright::Norm norm, Ties ties);

/// The pairs that see each other, without a vertex seen from both that is nearer to both. Nothing is seen
/// over a void's side from outside. Ascending. O(n^3).
std::vector<Edge> relative_neighbors(const Scene& scene, tinwright::Norm norm, Ties ties);
/// The pairs whose closed diametral disk holds no third vertex. Ascending. O(n^3).
std::vector<Edge> gabriel_neighbors(std::span<const tinwright::Key2> keys);
/// The one minimum spanning tree of the order of `Ties::Ordered`, by Prim's method. Ascending.
std::vector<Edge> minimum_spanning_tree(std::span<const tinwright::Key2> keys, tinwright::Norm norm);

/// Whether no two of the edges cross.
bool is_plane(std::span<const tinwright::Key2> keys, std::span<const Edge> edges);
/// How many parts the vertices fall into.
std::size_t count_components(std::size_t vertex_count, std::span<const Edge> edges);

}  // namespace tinwright_tests::oracle

#endif
