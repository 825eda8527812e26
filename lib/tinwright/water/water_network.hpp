#ifndef TINWRIGHT_WATER_WATER_NETWORK_HPP
#define TINWRIGHT_WATER_WATER_NETWORK_HPP

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/delaunay/water_areas.hpp"
#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/water/banks.hpp"
#include "tinwright/water/water_finding.hpp"

/// How lakes, rivers and banks hang together. Private to the room of water.
namespace tinwright {

inline constexpr std::uint32_t kNoNode = std::numeric_limits<std::uint32_t>::max();

/// A polygon of water: lake or banks.
struct WaterPolygon {
    LineRole role = LineRole::Lake;
    std::uint32_t number = 0;          ///< `Breakline::polygon`
    std::vector<std::uint32_t> rings;  ///< numbers of noded lines
};

/// A polygon of running water with its sections.
struct BankWater {
    WaterPolygon polygon;
    BankNetwork network;
    std::uint32_t first_node = 0;  ///< of its sections
    /// For each ring the noded vertices, as in `network.places`.
    std::vector<std::vector<std::uint32_t>> rings;
};

/// A stretch of water between two nodes that more or less than two stretches meet in, or where it changes
/// from river to banks or to a lake.
struct WaterRun {
    std::uint32_t line = 0;  ///< number of the noded line; of banks the first ring
    bool is_between_banks = false;
    std::uint32_t bank = 0;            ///< index in `banks`, where it is between them
    std::vector<std::uint32_t> stops;  ///< of rivers noded vertices, of banks nodes; two at least
    double chainage = 0;     ///< of rivers: of the first stop along the line as it was drawn, on the ground
    std::uint32_t from = 0;  ///< nodes of the first and the last stop
    std::uint32_t to = 0;
    std::vector<std::vector<Point2>> paths;  ///< of banks: the middle of the water between stops, in keys
};

/// A vertex of banks between the sections of which it has its level, as nodes.
struct BankStand {
    std::uint32_t a = kNoNode;
    std::uint32_t b = kNoNode;
    double part = 0;
    [[nodiscard]] std::uint32_t nearest() const { return part < 0.5 ? a : b; }
};

/// Lines of water cut where they meet. Nodes, the places that have a level, are: first the lakes, one each,
/// those that touch together; then the sections of banks; then the vertices of rivers that are in neither.
struct WaterNetwork {
    Lattice lattice;
    GroundMeasures ground;             ///< of lengths that are told
    std::vector<std::uint32_t> lines;  ///< index of each noded line in what came in
    std::vector<Breakline> prepared;   ///< the lines that were noded, stations and all
    NodedLines noded;
    std::vector<WaterPolygon> lakes;
    std::vector<std::uint32_t> lake_node;  ///< of each lake
    std::vector<BankWater> banks;
    std::vector<WaterRun> runs;

    std::size_t node_count = 0;
    std::uint32_t first_section = 0;        ///< nodes below are lakes
    std::uint32_t first_vertex = 0;         ///< nodes from here on are vertices of rivers
    std::vector<std::uint32_t> node_of;     ///< of each vertex; kNoNode: banks decide, see `stand_of`
    std::vector<std::uint32_t> vertex_of;   ///< of each node from `first_vertex` on
    std::vector<BankStand> stand_of;        ///< of each vertex on a ring of banks
    std::vector<bool> is_between_banks;     ///< of each vertex: strictly inside
    std::vector<bool> is_in_lake;           ///< of each vertex: strictly inside
    std::vector<std::uint32_t> piece_bank;  ///< of each piece of a river: the banks it is between, or kNoNode
    /// Vertices of a ring in two banks, or whose lake has a level of its own: these nodes have one level.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> equal;

    [[nodiscard]] std::span<const std::uint32_t> chain(std::uint32_t line) const {
        return std::span(noded.chains)
            .subspan(noded.chain_start[line], noded.chain_start[line + 1] - noded.chain_start[line]);
    }
    [[nodiscard]] Key2 key(std::uint32_t vertex) const { return noded.keys[vertex]; }
    [[nodiscard]] double distance(std::uint32_t a, std::uint32_t b) const;       ///< of vertices, CRS units
    [[nodiscard]] double told_distance(std::uint32_t a, std::uint32_t b) const;  ///< on the ground
    [[nodiscard]] double told_length(std::span<const Point2> path) const;  ///< of a path in keys, likewise
    /// Index of the banks that the piece of a river between two vertices is between, or kNoNode.
    [[nodiscard]] std::uint32_t bank_around(std::uint32_t line, std::uint32_t a, std::uint32_t b) const;
    /// The node at a vertex; on banks the nearest section.
    [[nodiscard]] std::uint32_t nearest_node(std::uint32_t vertex) const {
        return node_of[vertex] != kNoNode ? node_of[vertex] : stand_of[vertex].nearest();
    }
};

/// A finding at a vertex; `line`: number of a noded line.
WaterFinding make_finding(WaterFinding::Kind kind, const WaterNetwork& network, std::uint32_t line,
                          std::uint32_t vertex);

/// A vertex at each node: of a lake or section one on a ring; kNoNode where there is none. O(n).
std::vector<std::uint32_t> find_node_vertices(const WaterNetwork& network);
/// The first noded line through each node, or kNoNode. O(n).
std::vector<std::uint32_t> find_node_lines(const WaterNetwork& network);

struct NetworkOptions {
    double river_spacing = 0;            ///< of stations on rivers without z, CRS units
    std::optional<double> bank_spacing;  ///< of stations on banks; empty: half their mean width
    GroundMeasures ground{};             ///< of lengths that are told
};

/// Nodes lines of water, divides banks by sections, numbers the nodes and finds the runs. `lines`: all that
/// came in, `lattice`: one that they and the samples are on. Throws InputError where rings of banks meet
/// themselves or each other.
WaterNetwork make_water_network(std::span<const Breakline> lines, const Lattice& lattice,
                                const NetworkOptions& options);

}  // namespace tinwright

#endif
