#include "support/length_oracle.hpp"

#include <array>
#include <map>
#include <utility>

#include <boost/multiprecision/cpp_int.hpp>

#include "support/triangulation_sweep.hpp"

namespace tinwright_tests::oracle {

using namespace tinwright;

namespace {

using Integer = boost::multiprecision::cpp_int;

/// A number that grows with the length.
Integer power_of_length(Norm norm, Key2 a, Key2 b) {
    const Integer x = boost::multiprecision::abs(Integer(static_cast<std::int64_t>(a.x - b.x)));
    const Integer y = boost::multiprecision::abs(Integer(static_cast<std::int64_t>(a.y - b.y)));
    if (norm.is_maximum()) {
        return x < y ? y : x;
    }
    const auto power = static_cast<unsigned>(norm.power());
    return boost::multiprecision::pow(x, power) + boost::multiprecision::pow(y, power);
}

Triple ascending(Triple face) {
    std::sort(face.begin(), face.end());
    return face;
}

Edge ascending(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// What a sweep adds up: the greatest rank of a terrain face's longest edge.
class GreatestRank {
  public:
    using Value = std::uint32_t;

    GreatestRank(const FaceTable& table, const Terrain& terrain, const LengthRanks& ranks)
        : table_(table), terrain_(terrain), ranks_(ranks) {}

    [[nodiscard]] Value with_face(Value value, std::size_t a, std::size_t b, std::size_t c) const {
        const Triple face{table_.site(a), table_.site(b), table_.site(c)};
        return terrain_.voids.contains(ascending(face)) ? value : std::max(value, ranks_.longest(face));
    }

  private:
    const FaceTable& table_;
    const Terrain& terrain_;
    const LengthRanks& ranks_;
};

/// For each pair whether the segment between them is in the terrain and meets no constraint and no point.
std::vector<bool> find_sights(const Terrain& terrain) {
    const std::vector<Key2>& keys = terrain.sites.keys;
    const std::size_t n = keys.size();
    std::vector<bool> is_seen(n * n, false);
    for (std::uint32_t a = 0; a < n; ++a) {
        for (std::uint32_t b = a + 1; b < n; ++b) {
            const auto is_on_it = [&](Key2 p) { return is_inside_segment(p, keys[a], keys[b]); };
            const auto crosses = [&](const Edge& edge) {
                return do_cross(keys[a], keys[b], keys[edge[0]], keys[edge[1]]);
            };
            const bool is_free =
                !terrain.hidden.contains({a, b}) && std::none_of(keys.begin(), keys.end(), is_on_it) &&
                std::none_of(terrain.sites.constraints.begin(), terrain.sites.constraints.end(), crosses);
            is_seen[a * n + b] = is_free;
            is_seen[b * n + a] = is_free;
        }
    }
    return is_seen;
}

/// Walks around the regions of a TIN.
class Tracer {
  public:
    Tracer(const Tin& tin, const std::set<Edge>& walls) : mesh_(tin.mesh), walls_(walls) {}

    [[nodiscard]] bool is_wall(HalfEdgeId h) const {
        return mesh_.is_constrained(h) || mesh_.is_border(h) ||
               walls_.contains(ascending(mesh_.origin(h).value, mesh_.destination(h).value));
    }

    /// The region to the left of a wall.
    Region trace(HalfEdgeId first) {
        Region region;
        HalfEdgeId side = first;
        do {
            region.ring.push_back(mesh_.origin(side).value);
            is_done_.insert(side);
            side = next(side);
            while (!is_wall(side)) {
                side = next(mesh_.twin(side));
            }
        } while (side != first);
        std::set<FaceId> faces{face_of(first)};
        std::vector<FaceId> waiting{face_of(first)};
        while (!waiting.empty()) {
            const FaceId f = waiting.back();
            waiting.pop_back();
            const auto& v = mesh_.face(f).vertex;
            region.faces.push_back(ascending(Triple{v[0].value, v[1].value, v[2].value}));
            for (unsigned i = 0; i < 3; ++i) {
                const HalfEdgeId h = half_edge(f, i);
                if (!is_wall(h) && faces.insert(face_of(mesh_.twin(h))).second) {
                    waiting.push_back(face_of(mesh_.twin(h)));
                }
            }
        }
        std::sort(region.faces.begin(), region.faces.end());
        return region;
    }

    [[nodiscard]] bool is_done(HalfEdgeId side) const { return is_done_.contains(side); }

  private:
    const TriangleMesh& mesh_;
    const std::set<Edge>& walls_;
    std::set<HalfEdgeId> is_done_;
};

}  // namespace

LengthRanks::LengthRanks(Norm norm, std::span<const Key2> keys)
    : size_(keys.size()), rank_(size_ * size_, 0), place_(size_ * size_, 0) {
    using Pair = std::pair<std::array<Integer, 2>, Edge>;
    std::vector<Pair> pairs;
    for (std::uint32_t a = 0; a < size_; ++a) {
        for (std::uint32_t b = a + 1; b < size_; ++b) {
            pairs.push_back(
                {{power_of_length(norm, keys[a], keys[b]), power_of_length({}, keys[a], keys[b])}, {a, b}});
        }
    }
    std::sort(pairs.begin(), pairs.end());
    std::uint32_t place = 0;
    std::uint32_t rank = 0;
    for (const auto& [powers, edge] : pairs) {
        if (place == 0 || powers[0] != pairs[place - 1].first[0]) {
            ++rank;
        }
        ++place;
        for (const std::size_t i : {edge[0] * size_ + edge[1], edge[1] * size_ + edge[0]}) {
            rank_[i] = rank;
            place_[i] = place;
        }
    }
}

Terrain terrain_sites(const Tin& tin) {
    Terrain terrain;
    terrain.sites.keys.assign(tin.keys.begin(), tin.keys.end());
    terrain.sites.z.assign(tin.z.begin(), tin.z.end());
    std::set<Edge> constraints;
    const TriangleMesh& mesh = tin.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (mesh.is_ghost({f})) {
            continue;
        }
        const auto& v = mesh.face({f}).vertex;
        if (!mesh.is_terrain({f})) {
            terrain.voids.insert(ascending(Triple{v[0].value, v[1].value, v[2].value}));
        }
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const Edge edge = ascending(mesh.origin(h).value, mesh.destination(h).value);
            if (mesh.is_constrained(h) || mesh.is_border(h) || !mesh.is_terrain({f})) {
                constraints.insert(edge);
            }
            if (!mesh.is_terrain({f}) && !mesh.is_terrain(face_of(mesh.twin(h)))) {
                terrain.hidden.insert(edge);
            }
        }
    }
    terrain.sites.constraints.assign(constraints.begin(), constraints.end());
    return terrain;
}

std::uint32_t longest_edge(const Tin& tin, const LengthRanks& ranks) {
    std::uint32_t longest = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            const auto& v = tin.mesh.face({f}).vertex;
            longest = std::max(longest, ranks.longest({v[0].value, v[1].value, v[2].value}));
        }
    }
    return longest;
}

std::uint32_t least_longest_edge_listed(const Terrain& terrain, const LengthRanks& ranks) {
    std::uint32_t least = UINT32_MAX;
    for_each_triangulation(terrain.sites, [&](const std::vector<Triple>& faces) {
        std::uint32_t longest = 0;
        for (const Triple& face : faces) {
            if (!terrain.voids.contains(ascending(face))) {
                longest = std::max(longest, ranks.longest(face));
            }
        }
        least = std::min(least, longest);
    });
    return least;
}

std::uint32_t least_longest_edge(const Terrain& terrain, const LengthRanks& ranks) {
    const FaceTable table(terrain.sites);
    const GreatestRank greatest(table, terrain, ranks);
    return Sweep(table, greatest).best();
}

/// If all triangles that are chosen are counter-clockwise, they cover what the ring winds around, once.
std::optional<std::uint32_t> least_longest_edge(std::span<const Key2> keys,
                                                std::span<const std::uint32_t> ring,
                                                const LengthRanks& ranks) {
    const std::size_t n = ring.size();
    constexpr std::uint32_t kImpossible = UINT32_MAX;
    std::vector<std::uint32_t> least(n * n, kImpossible);
    for (std::size_t span = 1; span < n; ++span) {
        for (std::size_t i = 0; i + span < n; ++i) {
            const std::size_t j = i + span;
            std::uint32_t best = span == 1 ? 0 : kImpossible;
            for (std::size_t k = i + 1; k < j; ++k) {
                if (turn(keys[ring[i]], keys[ring[k]], keys[ring[j]]) > 0) {
                    best = std::min(best, std::max({least[i * n + k], least[k * n + j],
                                                    ranks.longest({ring[i], ring[k], ring[j]})}));
                }
            }
            least[i * n + j] = best;
        }
    }
    const std::uint32_t whole = n < 3 ? kImpossible : least[n - 1];
    return whole == kImpossible ? std::nullopt : std::optional(whole);
}

std::set<Edge> relative_neighbors(const Tin& tin, const LengthRanks& ranks) {
    const Terrain terrain = terrain_sites(tin);
    const std::vector<bool> is_seen = find_sights(terrain);
    const auto n = static_cast<std::uint32_t>(ranks.size());
    std::set<Edge> graph;
    for (std::uint32_t p = 0; p < n; ++p) {
        for (std::uint32_t q = p + 1; q < n; ++q) {
            bool is_neighbor = is_seen[p * n + q];
            for (std::uint32_t x = 0; x < n && is_neighbor; ++x) {
                is_neighbor = !(is_seen[p * n + x] && is_seen[q * n + x] && ranks.is_in_lune(x, p, q));
            }
            if (is_neighbor) {
                graph.insert({p, q});
            }
        }
    }
    return graph;
}

std::vector<Region> regions_of(const Tin& tin, const std::set<Edge>& walls) {
    const TriangleMesh& mesh = tin.mesh;
    std::map<Edge, HalfEdgeId> sides;
    Tracer tracer(tin, walls);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; mesh.is_terrain({f}) && i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (tracer.is_wall(h)) {
                sides[{mesh.origin(h).value, mesh.destination(h).value}] = h;
            }
        }
    }
    std::vector<Region> regions;
    for (const auto& [ends, side] : sides) {
        if (!tracer.is_done(side)) {
            regions.push_back(tracer.trace(side));
        }
    }
    return regions;
}

std::uint32_t longest_edge(const Region& region, const LengthRanks& ranks) {
    std::uint32_t longest = 0;
    for (const Triple& face : region.faces) {
        longest = std::max(longest, ranks.longest(face));
    }
    return longest;
}

std::vector<Edge> long_sides(const Region& region, std::span<const Key2> keys, const LengthRanks& ranks) {
    const std::vector<std::uint32_t>& ring = region.ring;
    const std::size_t n = ring.size();
    const auto is_free = [&](std::uint32_t a, std::uint32_t b) {
        for (std::size_t i = 0; i < n; ++i) {
            if (do_cross(keys[a], keys[b], keys[ring[i]], keys[ring[(i + 1) % n]]) ||
                is_inside_segment(keys[ring[i]], keys[a], keys[b])) {
                return false;
            }
        }
        return true;
    };
    std::vector<Edge> sides;
    for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t a = ring[i];
        const std::uint32_t b = ring[(i + 1) % n];
        const auto blocks = [&](std::uint32_t x) {
            return ranks.is_in_lune(x, a, b) && turn(keys[a], keys[b], keys[x]) > 0 && is_free(a, x) &&
                   is_free(b, x);
        };
        if (std::any_of(ring.begin(), ring.end(), blocks)) {
            sides.push_back({a, b});
        }
    }
    return sides;
}

}  // namespace tinwright_tests::oracle
