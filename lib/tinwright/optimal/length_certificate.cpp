#include "tinwright/optimal/length_certificate.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/mesh/border.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/optimal/polygon_dp.hpp"

// Every triangulation has an edge as long as the longest wall: a constrained edge, one of the border, or one
// between relative neighbours (Length Lemma [tan1993, Sec. 5.2, 5.9]). Some optimum contains all walls, so
// the least longest edge is that wall or what some polygon between walls cannot do without. Of a polygon, the
// constrained Delaunay triangulation tells a length that it can do with. Polygons are looked at from the one
// with the greatest such length on, until the rest can do with less than is needed anyway.

namespace tinwright {

namespace {

using VertexPair = std::array<VertexId, 2>;

/// What the walls leave open.
struct Polygon {
    FaceId face{};  ///< one of its faces
    std::size_t faces = 0;
    VertexPair longest{};  ///< edge of its faces
};

/// The terrain of a TIN, constrained Delaunay within its walls, from scratch. Vertices that no terrain face
/// has are left out.
class Subdivision {
  public:
    Subdivision(const Tin& tin, const LengthCertificateOptions& options);

    /// Sign of the length of one pair less that of the other.
    [[nodiscard]] int compare(VertexPair x, VertexPair y) const {
        return compare_lengths(norm_, keys_[x[0].value], keys_[x[1].value], keys_[y[0].value],
                               keys_[y[1].value]);
    }
    [[nodiscard]] VertexPair longest_wall() const;
    [[nodiscard]] std::vector<Polygon> find_polygons() const;
    /// The vertices around a polygon, counter-clockwise; as often as it touches itself there.
    [[nodiscard]] std::vector<VertexId> trace(const Polygon& polygon) const;

    [[nodiscard]] std::span<const Key2> keys() const { return keys_; }
    [[nodiscard]] VertexPair pair_of(std::span<const VertexId> old_ids) const {
        return {new_ids_[old_ids[0].value], new_ids_[old_ids[1].value]};
    }

  private:
    [[nodiscard]] VertexPair ends(HalfEdgeId h) const { return {mesh_.origin(h), mesh_.destination(h)}; }
    [[nodiscard]] bool is_wall(HalfEdgeId h) const { return mesh_.is_constrained(h) || mesh_.is_border(h); }
    void number_vertices(const Tin& tin);
    [[nodiscard]] std::vector<Segment> find_segments(const Tin& tin) const;
    void mark_terrain(const Tin& tin);

    Norm norm_;
    std::vector<VertexId> new_ids_;  // by vertex of the TIN
    std::vector<Key2> keys_;
    TriangleMesh mesh_;
};

Subdivision::Subdivision(const Tin& tin, const LengthCertificateOptions& options) : norm_(options.norm) {
    number_vertices(tin);
    mesh_ = make_delaunay(keys_);
    report_progress(options.progress, 0);
    insert_segments(mesh_, keys_, find_segments(tin));
    mark_terrain(tin);
    report_progress(options.progress, 0);
    std::vector<Segment> walls;
    for (const GraphEdge& edge :
         make_relative_neighborhood_graph(mesh_, keys_, norm_, LuneRim::Ordered, options.progress)) {
        walls.push_back({edge.a, edge.b});
    }
    insert_segments(mesh_, keys_, walls);
}

/// In the order of the TIN, which is the curve's.
void Subdivision::number_vertices(const Tin& tin) {
    std::vector<std::uint8_t> is_used(tin.vertex_count(), 0);
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            is_used[tin.mesh.vertex({f}, i).value] = 1;
        }
    }
    new_ids_.assign(tin.vertex_count(), kGhostVertex);
    for (std::uint32_t v = 0; v < is_used.size(); ++v) {
        if (is_used[v] != 0) {
            new_ids_[v] = {static_cast<std::uint32_t>(keys_.size())};
            keys_.push_back(tin.keys[v]);
        }
    }
}

/// The constrained edges of the terrain and its border.
std::vector<Segment> Subdivision::find_segments(const Tin& tin) const {
    std::vector<Segment> segments;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const VertexPair edge = pair_of(std::array{tin.mesh.origin(h), tin.mesh.destination(h)});
            if (tin.mesh.is_border(h) || (tin.mesh.is_constrained(h) && edge[0] < edge[1])) {
                segments.push_back({edge[0], edge[1]});
            }
        }
    }
    return segments;
}

/// From the border inwards.
void Subdivision::mark_terrain(const Tin& tin) {
    std::vector<std::uint8_t> is_border(4 * mesh_.slot_count(), 0);
    std::vector<std::uint8_t> is_inside(mesh_.slot_count(), 0);
    std::vector<FaceId> waiting;
    const auto enter = [&](FaceId face) {
        if (is_inside[face.value] == 0) {
            is_inside[face.value] = 1;
            waiting.push_back(face);
        }
    };
    const std::vector<HalfEdgeId> starts = find_starts(mesh_);
    for (const HalfEdgeId old : find_border(tin.mesh)) {
        const VertexPair edge = pair_of(std::array{tin.mesh.origin(old), tin.mesh.destination(old)});
        if (const auto h = find_half_edge(mesh_, starts[edge[0].value], edge[1])) {
            is_border[h->value] = 1;
            is_border[mesh_.twin(*h).value] = 1;
            enter(face_of(*h));
        }
    }
    while (!waiting.empty()) {
        const FaceId face = waiting.back();
        waiting.pop_back();
        for (unsigned i = 0; i < 3; ++i) {
            if (is_border[half_edge(face, i).value] == 0) {
                enter(face_of(mesh_.twin(half_edge(face, i))));
            }
        }
    }
    for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
        mesh_.set_terrain({f}, is_inside[f] != 0);
    }
}

VertexPair Subdivision::longest_wall() const {
    VertexPair longest{};
    for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && mesh_.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (is_wall(h) && compare(ends(h), longest) > 0) {
                longest = ends(h);
            }
        }
    }
    return longest;
}

std::vector<Polygon> Subdivision::find_polygons() const {
    std::vector<Polygon> polygons;
    std::vector<std::uint8_t> is_known(mesh_.slot_count(), 0);
    std::vector<FaceId> waiting;
    const auto enter = [&](FaceId face) {
        if (is_known[face.value] == 0) {
            is_known[face.value] = 1;
            waiting.push_back(face);
        }
    };
    for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
        if (!mesh_.is_terrain({f}) || is_known[f] != 0) {
            continue;
        }
        Polygon polygon{{f}, 0, ends(half_edge({f}, 0))};
        enter({f});
        while (!waiting.empty()) {
            const FaceId face = waiting.back();
            waiting.pop_back();
            ++polygon.faces;
            for (unsigned i = 0; i < 3; ++i) {
                const HalfEdgeId h = half_edge(face, i);
                if (compare(ends(h), polygon.longest) > 0) {
                    polygon.longest = ends(h);
                }
                if (!is_wall(h)) {
                    enter(face_of(mesh_.twin(h)));
                }
            }
        }
        polygons.push_back(polygon);
    }
    return polygons;
}

std::vector<VertexId> Subdivision::trace(const Polygon& polygon) const {
    // Around the tree of faces from any of them: each edge that is no wall is passed in both directions.
    std::vector<VertexId> ring;
    const HalfEdgeId first = half_edge(polygon.face, 0);
    HalfEdgeId h = first;
    do {
        if (is_wall(h)) {
            ring.push_back(mesh_.origin(h));
            h = next(h);
        } else {
            h = next(mesh_.twin(h));
        }
    } while (h != first);
    return ring;
}

/// The ring of a polygon with the lengths that matter in it.
class RankedRing {
  public:
    /// Lengths up to `enough` are all alike; none exceeds `most`.
    RankedRing(const Subdivision& subdivision, std::vector<VertexId> ring, VertexPair enough,
               VertexPair most);

    /// The longest edge, in rank, of the best triangulation; empty if nothing longer than `enough` is needed.
    [[nodiscard]] std::optional<VertexPair> least_longest(const Progress& progress) const;

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();

    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const { return i * ring_.size() + j; }

    std::span<const Key2> keys_;
    std::vector<VertexId> ring_;
    std::vector<VertexPair> pairs_;  // between both lengths, shorter first
    std::vector<double> ranks_;      // of positions i < j: minus infinity, a place in `pairs_`, or infinity
};

RankedRing::RankedRing(const Subdivision& subdivision, std::vector<VertexId> ring, VertexPair enough,
                       VertexPair most)
    : keys_(subdivision.keys()), ring_(std::move(ring)), ranks_(ring_.size() * ring_.size(), kInfinity) {
    const auto size = static_cast<std::uint32_t>(ring_.size());
    std::vector<std::array<std::uint32_t, 2>> between;
    const auto pair_at = [this](std::array<std::uint32_t, 2> positions) {
        return VertexPair{ring_[positions[0]], ring_[positions[1]]};
    };
    for (std::uint32_t i = 0; i < size; ++i) {
        for (std::uint32_t j = i + 1; j < size; ++j) {
            const VertexPair pair{ring_[i], ring_[j]};
            if (subdivision.compare(pair, enough) <= 0) {
                ranks_[index(i, j)] = -kInfinity;
            } else if (subdivision.compare(pair, most) <= 0) {
                between.push_back({i, j});
            }
        }
    }
    std::sort(between.begin(), between.end(), [&](const auto& x, const auto& y) {
        const int order = subdivision.compare(pair_at(x), pair_at(y));
        return order != 0 ? order < 0 : x < y;
    });
    for (const auto& positions : between) {
        if (pairs_.empty() || subdivision.compare(pairs_.back(), pair_at(positions)) < 0) {
            pairs_.push_back(pair_at(positions));
        }
        ranks_[index(positions[0], positions[1])] = static_cast<double>(pairs_.size() - 1);
    }
}

std::optional<VertexPair> RankedRing::least_longest(const Progress& progress) const {
    std::vector<Key2> places;
    for (const VertexId vertex : ring_) {
        places.push_back(keys_[vertex.value]);
    }
    const auto best = triangulate_polygon(
        places,
        [this](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
            return std::max({ranks_[index(i, k)], ranks_[index(k, j)], ranks_[index(i, j)]});
        },
        PolygonCost::Maximum, progress);
    if (!best || best->cost == -kInfinity) {
        return std::nullopt;
    }
    return pairs_[static_cast<std::size_t>(best->cost)];
}

/// The longest edge of the terrain; of equal ones the first, by numbers.
VertexPair find_longest(const Tin& tin, Norm norm) {
    VertexPair longest{};
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            VertexPair edge{tin.mesh.vertex({f}, i), tin.mesh.vertex({f}, next_corner(i))};
            std::sort(edge.begin(), edge.end());
            const int order = compare_lengths(norm, tin.key(edge[0]), tin.key(edge[1]), tin.key(longest[0]),
                                              tin.key(longest[1]));
            if (order > 0 || (order == 0 && edge < longest)) {
                longest = edge;
            }
        }
    }
    return longest;
}

}  // namespace

LengthCertificate certify_length(const Tin& tin, const LengthCertificateOptions& options) {
    LengthCertificate certificate;
    certificate.edge = find_longest(tin, options.norm);
    const Subdivision subdivision(tin, options);
    const auto is_longer = [&](VertexPair x, VertexPair y) { return subdivision.compare(x, y) > 0; };
    const auto length_of = [&](VertexPair pair) {
        return tin.lattice.quantum() *
               length(options.norm, subdivision.keys()[pair[0].value], subdivision.keys()[pair[1].value]);
    };
    const VertexPair longest = subdivision.pair_of(certificate.edge);
    certificate.longest = length_of(longest);

    VertexPair needed = subdivision.longest_wall();
    std::vector<Polygon> polygons = subdivision.find_polygons();
    std::sort(polygons.begin(), polygons.end(), [&](const Polygon& x, const Polygon& y) {
        const int order = subdivision.compare(x.longest, y.longest);
        return order != 0 ? order > 0 : x.face < y.face;
    });
    std::vector<Polygon> left_out;
    for (const Polygon& polygon : polygons) {
        if (!is_longer(longest, needed) || !is_longer(polygon.longest, needed)) {
            break;
        }
        if (polygon.faces + 2 > options.largest_polygon.value_or(std::numeric_limits<std::size_t>::max())) {
            left_out.push_back(polygon);
            continue;
        }
        const RankedRing ring(subdivision, subdivision.trace(polygon), needed, polygon.longest);
        needed = ring.least_longest(options.progress).value_or(needed);
        ++certificate.polygons;
    }
    certificate.is_optimal = !is_longer(longest, needed);
    if (certificate.is_optimal) {
        return certificate;
    }
    std::erase_if(left_out, [&](const Polygon& polygon) { return !is_longer(polygon.longest, needed); });
    certificate.left_out = left_out.size();
    const VertexPair attainable = left_out.empty() ? needed : left_out.front().longest;
    if (is_longer(longest, attainable)) {
        certificate.attainable = length_of(attainable);
    }
    return certificate;
}

}  // namespace tinwright
