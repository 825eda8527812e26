#include "tinwright/water/water_network.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/water/stations.hpp"
#include "tinwright/water/water_runs.hpp"

namespace tinwright {

namespace {

/// Mean width of a ring's water, had it no islands: twice the area by the perimeter.
double mean_width(const Breakline& ring) {
    double area = 0;
    double length = 0;
    const Point3& origin = ring.points.front();
    for (std::size_t i = 1; i < ring.points.size(); ++i) {
        const Point3& p = ring.points[i - 1];
        const Point3& q = ring.points[i];
        area += (p.x - origin.x) * (q.y - origin.y) - (q.x - origin.x) * (p.y - origin.y);
        length += std::hypot(q.x - p.x, q.y - p.y);
    }
    return length > 0 ? std::abs(area) / length : 0;
}

bool has_own_z(const Breakline& line) {
    return std::any_of(line.points.begin(), line.points.end(),
                       [](const Point3& p) { return std::isfinite(p.z); });
}

class NetworkMaker {
  public:
    NetworkMaker(std::span<const Breakline> lines, const NetworkOptions& options, WaterNetwork& network)
        : lines_(lines), options_(options), out_(network) {}

    void make() {
        prepare();
        NodingOptions noding;
        noding.crossing_z = CrossingPolicy::Min;
        noding.keep_chains = true;
        out_.noded = node_lines(out_.prepared, out_.lattice, noding);
        const std::size_t count = out_.noded.keys.size();
        out_.node_of.assign(count, kNoNode);
        out_.stand_of.resize(count);
        out_.is_between_banks.assign(count, false);
        out_.is_in_lake.assign(count, false);
        gather_polygons();
        locate_vertices();
        make_lake_nodes();
        make_sections();
        make_river_nodes();
        find_runs(out_, is_piece_in_water_);
    }

  private:
    void prepare() {
        std::map<std::uint32_t, double> spacing_of;  // of banks, by polygon
        for (const Breakline& line : lines_) {
            if (line.role == LineRole::Bank) {
                double& spacing = spacing_of[line.polygon];
                spacing = std::max(spacing, mean_width(line) / 2);
            }
        }
        for (std::uint32_t i = 0; i < lines_.size(); ++i) {
            const Breakline& line = lines_[i];
            if (!is_water_role(line.role) || line.role == LineRole::Section) {
                continue;
            }
            Breakline prepared = line;
            if (line.role == LineRole::Lake) {
                for (Point3& point : prepared.points) {
                    point.z = kDraped;  // the level is decided for the whole lake
                }
            } else if (line.role == LineRole::Bank) {
                const double spacing = options_.bank_spacing.value_or(spacing_of[line.polygon]);
                if (spacing > 0) {
                    prepared.points = add_stations(line.points, spacing, out_.lattice);
                }
            } else if (!has_own_z(line) && options_.river_spacing > 0) {
                prepared.points = add_stations(line.points, options_.river_spacing, out_.lattice);
            }
            out_.lines.push_back(i);
            out_.prepared.push_back(std::move(prepared));
        }
    }

    void gather_polygons() {
        std::map<std::pair<LineRole, std::uint32_t>, std::size_t> place;
        std::vector<WaterPolygon> polygons;
        for (std::uint32_t line = 0; line < out_.prepared.size(); ++line) {
            const Breakline& ring = out_.prepared[line];
            if (!is_cleared_role(ring.role)) {
                continue;
            }
            const auto [entry, is_new] = place.try_emplace({ring.role, ring.polygon}, polygons.size());
            if (is_new) {
                polygons.push_back({ring.role, ring.polygon, {}});
            }
            polygons[entry->second].rings.push_back(line);
        }
        // By where they are, so that nothing depends on the order of polygons.
        const auto first_vertex = [this](const WaterPolygon& polygon) {
            std::uint32_t first = kNoNode;
            for (const std::uint32_t ring : polygon.rings) {
                const auto chain = out_.chain(ring);
                first = std::min(first, *std::min_element(chain.begin(), chain.end()));
            }
            return first;
        };
        std::stable_sort(polygons.begin(), polygons.end(), [&](const WaterPolygon& a, const WaterPolygon& b) {
            return first_vertex(a) < first_vertex(b);
        });
        for (WaterPolygon& polygon : polygons) {
            if (polygon.role == LineRole::Lake) {
                lake_by_number_[polygon.number] = static_cast<std::uint32_t>(out_.lakes.size());
                out_.lakes.push_back(std::move(polygon));
            } else {
                bank_by_number_[polygon.number] = static_cast<std::uint32_t>(out_.banks.size());
                out_.banks.push_back({std::move(polygon), {}, 0, {}});
            }
        }
    }

    /// Which vertices are inside lakes and banks.
    void locate_vertices() {
        const WaterAreas areas(out_.noded, out_.prepared);
        lake_around_.assign(out_.noded.keys.size(), kNoNode);
        for (std::uint32_t v = 0; v < out_.noded.keys.size(); ++v) {
            if (const auto area = areas.around(out_.key(v))) {
                const auto [role, number] = areas.polygon(*area);
                if (role == LineRole::Lake) {
                    lake_around_[v] = lake_by_number_.at(number);
                    out_.is_in_lake[v] = true;
                } else {
                    out_.is_between_banks[v] = true;
                }
            }
        }
        for (const NodedPiece& piece : out_.noded.pieces) {
            const bool is_river = out_.prepared[piece.line].role == LineRole::River;
            const auto area = is_river ? areas.around(piece) : std::nullopt;
            const bool is_in_bank = area && areas.polygon(*area).first == LineRole::Bank;
            is_piece_in_water_.push_back(area.has_value());
            out_.piece_bank.push_back(is_in_bank ? bank_by_number_.at(areas.polygon(*area).second) : kNoNode);
        }
    }

    /// Lakes that share a vertex, or one of which reaches into the other, are one node.
    void make_lake_nodes() {
        std::vector<std::uint32_t> parent(out_.lakes.size());
        std::iota(parent.begin(), parent.end(), 0U);
        const auto find = [&parent](std::uint32_t lake) {
            while (parent[lake] != lake) {
                lake = parent[lake] = parent[parent[lake]];
            }
            return lake;
        };
        const auto join = [&](std::uint32_t a, std::uint32_t b) {
            const std::uint32_t first = find(a);
            const std::uint32_t second = find(b);
            parent[std::max(first, second)] = std::min(first, second);
        };
        std::vector<std::uint32_t> lake_at(lake_around_);
        for (std::uint32_t lake = 0; lake < out_.lakes.size(); ++lake) {
            for (const std::uint32_t ring : out_.lakes[lake].rings) {
                for (const std::uint32_t v : out_.chain(ring)) {
                    if (lake_at[v] != kNoNode) {
                        join(lake, lake_at[v]);
                    } else {
                        lake_at[v] = lake;
                    }
                }
            }
        }
        out_.lake_node.resize(out_.lakes.size());
        for (std::uint32_t lake = 0; lake < out_.lakes.size(); ++lake) {
            const std::uint32_t first = find(lake);
            out_.lake_node[lake] =
                first == lake ? static_cast<std::uint32_t>(out_.node_count++) : out_.lake_node[first];
        }
        for (std::uint32_t v = 0; v < lake_at.size(); ++v) {
            if (lake_at[v] != kNoNode) {
                out_.node_of[v] = out_.lake_node[lake_at[v]];
            }
        }
        out_.first_section = static_cast<std::uint32_t>(out_.node_count);
    }

    /// The vertices of a ring, each once.
    std::vector<std::uint32_t> open_ring(std::uint32_t line) const {
        const auto chain = out_.chain(line);
        std::vector<std::uint32_t> ring(chain.begin(), chain.end());
        if (ring.size() > 1 && ring.front() == ring.back()) {
            ring.pop_back();
        }
        return ring;
    }

    void make_sections() {
        for (BankWater& bank : out_.banks) {
            std::vector<std::vector<Key2>> keys;
            for (const std::uint32_t line : bank.polygon.rings) {
                bank.rings.push_back(open_ring(line));
                keys.emplace_back();
                for (const std::uint32_t v : bank.rings.back()) {
                    keys.back().push_back(out_.key(v));
                }
            }
            require_simple(bank);
            bank.network = make_bank_network(keys);
            bank.first_node = static_cast<std::uint32_t>(out_.node_count);
            out_.node_count += bank.network.sections.size();
            for (std::size_t r = 0; r < bank.rings.size(); ++r) {
                for (std::size_t i = 0; i < bank.rings[r].size(); ++i) {
                    const BankPlace& place = bank.network.places[r][i];
                    stand(bank.rings[r][i],
                          {bank.first_node + place.a, bank.first_node + place.b, place.part});
                }
            }
        }
        out_.first_vertex = static_cast<std::uint32_t>(out_.node_count);
    }

    void require_simple(const BankWater& bank) const {
        std::vector<std::uint32_t> all;
        for (const std::vector<std::uint32_t>& ring : bank.rings) {
            if (ring.size() < 3) {
                const std::uint32_t line =
                    bank.polygon.rings[static_cast<std::size_t>(&ring - bank.rings.data())];
                throw BreaklineError("a ring of banks has no area, at " +
                                         location_text(out_.lattice.position(out_.key(ring.front()))) +
                                         "; remove it",
                                     {out_.lines[line]});
            }
            all.insert(all.end(), ring.begin(), ring.end());
        }
        std::sort(all.begin(), all.end());
        const auto twice = std::adjacent_find(all.begin(), all.end());
        if (twice != all.end()) {
            throw BreaklineError(
                "banks touch or cross themselves at " +
                    location_text(out_.lattice.position(out_.key(*twice))) +
                    "; move the rings apart there, or make an island that touches part of the bank",
                {out_.lines[bank.polygon.rings.front()]});
        }
    }

    /// A vertex that is on other banks already, or on a lake, ties the levels there together.
    void stand(std::uint32_t v, const BankStand& stand) {
        const auto tie = [&](std::uint32_t p, std::uint32_t q) {
            if (p != q) {
                out_.equal.emplace_back(p, q);
            }
        };
        BankStand& there = out_.stand_of[v];
        if (out_.node_of[v] != kNoNode) {
            tie(out_.node_of[v], stand.nearest());
        }
        if (there.a == kNoNode) {
            there = stand;
        } else {
            tie(there.nearest(), stand.nearest());
        }
    }

    /// Numbered by place, so that ties that go by number do not depend on the order of the lines.
    void make_river_nodes() {
        std::vector<bool> is_of_river(out_.noded.keys.size());
        for (std::uint32_t line = 0; line < out_.prepared.size(); ++line) {
            for (const std::uint32_t v : out_.chain(line)) {
                is_of_river[v] = is_of_river[v] || out_.prepared[line].role == LineRole::River;
            }
        }
        for (std::uint32_t v = 0; v < is_of_river.size(); ++v) {
            if (is_of_river[v] && out_.node_of[v] == kNoNode && out_.stand_of[v].a == kNoNode &&
                !out_.is_between_banks[v]) {
                out_.node_of[v] = static_cast<std::uint32_t>(out_.node_count++);
                out_.vertex_of.push_back(v);
            }
        }
    }

    std::span<const Breakline> lines_;
    const NetworkOptions& options_;
    WaterNetwork& out_;
    std::map<std::uint32_t, std::uint32_t> lake_by_number_;
    std::map<std::uint32_t, std::uint32_t> bank_by_number_;
    std::vector<std::uint32_t> lake_around_;  // of each vertex: a lake that it is strictly inside of
    std::vector<bool> is_piece_in_water_;     // of each piece: of a river inside a lake or between banks
};

}  // namespace

double WaterNetwork::distance(std::uint32_t a, std::uint32_t b) const {
    return std::sqrt(squared_distance(key(a), key(b))) * lattice.quantum();
}

double WaterNetwork::told_distance(std::uint32_t a, std::uint32_t b) const {
    return ground.is_geodesic() ? ground.length(lattice.position(key(a)), lattice.position(key(b)))
                                : distance(a, b);
}

double WaterNetwork::told_length(std::span<const Point2> path) const {
    double length = 0;
    if (!ground.is_geodesic()) {
        for (std::size_t k = 1; k < path.size(); ++k) {
            length += std::hypot(path[k].x - path[k - 1].x, path[k].y - path[k - 1].y);
        }
        return length * lattice.quantum();
    }
    // Paths lead over places between the lattice's.
    const Point2 origin = lattice.position({0, 0});
    const auto place = [&](Point2 p) {
        return Point2{origin.x + p.x * lattice.quantum(), origin.y + p.y * lattice.quantum()};
    };
    for (std::size_t k = 1; k < path.size(); ++k) {
        length += ground.length(place(path[k - 1]), place(path[k]));
    }
    return length;
}

std::uint32_t WaterNetwork::bank_around(std::uint32_t line, std::uint32_t a, std::uint32_t b) const {
    const NodedPiece sought{std::min(a, b), std::max(a, b), line, 0};
    const auto place = std::lower_bound(noded.pieces.begin(), noded.pieces.end(), sought);
    return piece_bank[static_cast<std::size_t>(place - noded.pieces.begin())];
}

WaterFinding make_finding(WaterFinding::Kind kind, const WaterNetwork& network, std::uint32_t line,
                          std::uint32_t vertex) {
    WaterFinding finding;
    finding.kind = kind;
    finding.line = network.lines[line];
    finding.location = network.lattice.position(network.key(vertex));
    return finding;
}

std::vector<std::uint32_t> find_node_vertices(const WaterNetwork& network) {
    std::vector<std::uint32_t> vertex(network.node_count, kNoNode);
    for (std::uint32_t v = 0; v < network.noded.keys.size(); ++v) {
        const std::uint32_t node = network.node_of[v] != kNoNode      ? network.node_of[v]
                                   : network.stand_of[v].a != kNoNode ? network.stand_of[v].nearest()
                                                                      : kNoNode;
        if (node != kNoNode && vertex[node] == kNoNode) {
            vertex[node] = v;
        }
    }
    return vertex;
}

std::vector<std::uint32_t> find_node_lines(const WaterNetwork& network) {
    std::vector<std::uint32_t> line(network.node_count, kNoNode);
    const auto set = [&line](std::uint32_t node, std::uint32_t number) {
        line[node] = std::min(line[node], number);
    };
    for (std::uint32_t l = 0; l < network.prepared.size(); ++l) {
        for (const std::uint32_t v : network.chain(l)) {
            if (network.node_of[v] != kNoNode) {
                set(network.node_of[v], l);
            } else if (network.stand_of[v].a != kNoNode) {
                set(network.stand_of[v].nearest(), l);
            }
        }
    }
    return line;
}

WaterNetwork make_water_network(std::span<const Breakline> lines, const Lattice& lattice,
                                const NetworkOptions& options) {
    WaterNetwork network;
    network.lattice = lattice;
    network.ground = options.ground;
    NetworkMaker(lines, options, network).make();
    return network;
}

}  // namespace tinwright
