#include "tinwright/delaunay/propagation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/delaunay/blocking_disks.hpp"
#include "tinwright/delaunay/circle_points.hpp"
#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/lines_in_disks.hpp"
#include "tinwright/delaunay/proximity_graphs.hpp"
#include "tinwright/delaunay/tree_of_regions.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

BlockingDisks make_disks(std::span<const Key2> keys) {
    return {keys, make_minimum_spanning_tree(make_delaunay(keys), keys)};
}

// For each edge of a line whether it is on the hull.
std::vector<bool> find_hull_edges(const SteinerInserter& inserter) {
    const TriangleMesh& mesh = inserter.tin().mesh;
    std::vector<bool> is_on_hull;
    for (const auto& [p, q] : inserter.line_edges()) {
        const HalfEdgeId h = *inserter.find_half_edge(p, q);
        is_on_hull.push_back(mesh.is_ghost(face_of(h)) || mesh.is_ghost(face_of(mesh.twin(h))));
    }
    return is_on_hull;
}

class Propagation {
  public:
    Propagation(SteinerInserter& inserter, std::size_t max_steiner, const Progress& progress)
        : inserter_(inserter),
          tin_(inserter.tin()),
          max_steiner_(max_steiner),
          progress_(progress),
          disks_(make_disks(tin_.keys)),
          lines_(find_lines_in_disks(disks_, tin_.keys, inserter.line_edges(), find_hull_edges(inserter))),
          points_(disks_, tin_.keys, lines_),
          is_cut_(lines_.edges.size()),
          chains_(lines_.unprotected.size()),
          is_stale_(2 * lines_.unprotected.size(), true) {
        report_.disks = disks_.disks().size();
    }

    BlockingReport run() {
        const std::vector<Export> order = order_exports(disks_, tin_.keys, lines_);
        std::size_t before = 0;
        double round = 0;
        do {
            before = steiner_count();
            for (std::size_t i = 0; i < order.size() && report_.is_within_budget; ++i) {
                if (i % 1024 == 0) {
                    const double share = static_cast<double>(i) / static_cast<double>(order.size());
                    report_progress(progress_, 1 - std::exp2(-(round + share)));
                }
                export_onto(order[i]);
            }
            ++round;
        } while (steiner_count() > before && report_.is_within_budget);
        return std::move(report_);
    }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return tin_.key(v); }
    [[nodiscard]] std::size_t steiner_count() const {
        return tin_.vertex_count() - inserter_.old_vertex_count();
    }
    // Asked when one more vertex is needed.
    bool has_budget() {
        report_.is_within_budget = steiner_count() < max_steiner_;
        return report_.is_within_budget;
    }

    // Projects what lies in the disks of the parts of an unprotected edge, as seen from one side, onto it.
    void export_onto(const Export& exported) {
        const std::size_t side = 2 * std::size_t{exported.edge} + (exported.is_from_left ? 0U : 1U);
        if (!is_stale_[side]) {
            return;
        }
        is_stale_[side] = false;
        const std::uint32_t line_edge = lines_.unprotected[exported.edge].line_edge;
        if (!is_cut_[line_edge]) {
            const LineInDisks& edge = lines_.edges[line_edge];
            const HalfEdgeId h = *inserter_.find_half_edge(edge.p, edge.q);
            if (!is_disturbed(h) && !is_disturbed(tin_.mesh.twin(h))) {
                return;
            }
            cut(line_edge);
        }
        std::vector<VertexId>& chain = chains_[exported.edge];
        if (chain.empty()) {
            return;
        }
        // What is still to be looked at, the next vertex last.
        std::vector<VertexId> rest(chain.rbegin(), chain.rend());
        chain.assign(1, rest.back());
        rest.pop_back();
        while (!rest.empty()) {
            const VertexId a = chain.back();
            const VertexId b = rest.back();
            const std::optional<VertexId> made = exported.is_from_left ? project(a, b) : project(b, a);
            if (made) {
                rest.push_back(*made);
            } else {
                chain.push_back(b);
                rest.pop_back();
            }
        }
    }

    [[nodiscard]] double share_at(const LineInDisks& edge, VertexId v) const {
        return inner_product(key(v), key(edge.p), key(edge.q)) /
               inner_product(key(edge.q), key(edge.p), key(edge.q));
    }

    // What has other faces beside it than before has to be looked at again.
    void mark_touched() {
        for (const HalfEdgeId h : inserter_.touched()) {
            if (!tin_.mesh.is_constrained(h)) {
                continue;
            }
            const VertexId a = tin_.mesh.origin(h);
            const VertexId b = tin_.mesh.destination(h);
            const std::uint32_t line_edge = inserter_.line_edge_of(a, b);
            const LineInDisks& edge = lines_.edges[line_edge];
            const auto begin = lines_.unprotected.begin();
            auto found = begin + edge.first;
            if (is_cut_[line_edge]) {
                const double middle = 0.5 * (share_at(edge, a) + share_at(edge, b));
                found = std::partition_point(found, begin + edge.last, [middle](const UnprotectedEdge& part) {
                    return part.to < middle;
                });
            }
            if (found != begin + edge.last) {
                std::fill_n(is_stale_.begin() + 2 * (found - begin), 2, true);
            }
        }
    }

    // Whether the apex of the half-edge's face lies in the disk that the edge is a diameter of.
    [[nodiscard]] bool is_disturbed(HalfEdgeId h) const {
        const TriangleMesh& mesh = tin_.mesh;
        const VertexId c = mesh.origin(previous(h));
        return c != kGhostVertex && angle_sign(key(mesh.origin(h)), key(c), key(mesh.destination(h))) < 0;
    }

    // A vertex on an edge of a line, and what share of the way to it is done there.
    struct Place {
        VertexId vertex;
        double share;
    };

    // Puts in the points where circles meet an edge of a line.
    void cut(std::uint32_t line_edge) {
        is_cut_[line_edge] = true;
        const LineInDisks& edge = lines_.edges[line_edge];
        std::fill(is_stale_.begin() + 2 * std::ptrdiff_t{edge.first},
                  is_stale_.begin() + 2 * std::ptrdiff_t{edge.last}, true);
        // What is closer than a step to the place before, or to q, is that.
        std::vector<double> shares{0};
        const auto add = [&](double share) {
            share = (1 - share) * edge.length < 1 ? 1 : share;
            if ((share - shares.back()) * edge.length >= 1) {
                shares.push_back(share);
            }
            return shares.size() - 1;
        };
        std::vector<std::size_t> ends;  // of the gaps between chords, by twos
        ends.push_back(0);
        for (const Chord& chord : edge.chords) {
            ends.push_back(add(chord.from));
            ends.push_back(add(chord.to));
        }
        ends.push_back(add(1));
        std::vector<VertexId> vertices(shares.size(), edge.p);
        vertices[ends.back()] = edge.q;
        if (shares.size() > 2) {
            put_between(edge, shares, vertices, 1, shares.size() - 1, {edge.p, 0}, {edge.q, 1});
        }
        for (std::uint32_t u = edge.first; u < edge.last; ++u) {
            const std::size_t gap = 2 * std::size_t{lines_.unprotected[u].gap};
            const VertexId begin = vertices[ends[gap]];
            const VertexId end = vertices[ends[gap + 1]];
            if (begin != end) {
                chains_[u] = {begin, end};
            }
        }
    }

    // Puts vertices at shares[begin] to before shares[end] on the edge from a to b, the middle one first: one
    // after the other, each would take over all faces along the rest of the edge. Where there cannot be one,
    // the one before takes its place. Returns the last one before b.
    Place put_between(const LineInDisks& edge, std::span<const double> shares, std::span<VertexId> vertices,
                      std::size_t begin, std::size_t end, Place a, Place b) {
        if (begin == end) {
            return a;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        const double share = (shares[middle] - a.share) / (b.share - a.share);
        std::optional<VertexId> made;
        if (share > 0 && share < 1 && has_budget()) {
            made = inserter_.split(*inserter_.find_half_edge(a.vertex, b.vertex), share);
        }
        Place place = a;
        if (made) {
            mark_touched();
            place = {*made, share_at(edge, *made)};
            put_between(edge, shares, vertices, begin, middle, a, place);
            ++report_.circle_vertices;
        } else {
            place = put_between(edge, shares, vertices, begin, middle, a, b);
        }
        vertices[middle] = place.vertex;
        return put_between(edge, shares, vertices, middle + 1, end, place, b);
    }

    // Projects the apex of the face left of the edge from a to b onto it if it lies in the disk that has the
    // edge as a diameter. Points of circles that would have been projected instead become vertices first.
    std::optional<VertexId> project(VertexId a, VertexId b) {
        for (;;) {
            const HalfEdgeId h = *inserter_.find_half_edge(a, b);
            const VertexId c = tin_.mesh.origin(previous(h));
            if (!is_disturbed(h) || comes_from(c, a, b) || !has_budget()) {
                return std::nullopt;
            }
            if (const std::optional<std::uint32_t> point = find_circle_point(h)) {
                put_in(points_[*point], a);
                continue;
            }
            const double square = inner_product(key(b), key(a), key(b));
            const double share = inner_product(key(c), key(a), key(b)) / square;
            const std::optional<VertexId> made =
                inserter_.split(h, share + shift(c, a, b) / std::sqrt(square));
            if (made) {
                mark_touched();
                ++report_.propagated_vertices;
                report_.projections.emplace_back(*made, c);
                sources_.resize(steiner_count(), kGhostVertex);
                sources_.back() = c;
            }
            return made;
        }
    }

    // Whether c is a projection from the side of its own edge where a and b are. Then it disturbs the edge
    // between them by rounding only, for a right angle [tan1993, Lemma 6.3]: to go on would lead back and
    // forth.
    [[nodiscard]] bool comes_from(VertexId c, VertexId a, VertexId b) const {
        const std::size_t index = c.value - inserter_.old_vertex_count();
        if (c.value < inserter_.old_vertex_count() || index >= sources_.size() ||
            sources_[index] == kGhostVertex) {
            return false;
        }
        const auto& [p, q] = inserter_.line_edges()[inserter_.line_edge_of(c, c)];
        const int side = orient2d(key(p), key(q), key(sources_[index]));
        return side == orient2d(key(p), key(q), key(a)) || side == orient2d(key(p), key(q), key(b));
    }

    // What to add to the way from a to b where c is projected onto it: some steps away from the vertex where
    // its line's edge meets that of c, if it does. Projections of c onto all edges at that vertex lie on one
    // circle through it and c, and after rounding each might come to lie inside.
    [[nodiscard]] double shift(VertexId c, VertexId a, VertexId b) const {
        constexpr double kSteps = 4;  // `split` may go 3 steps from where it is told to
        const LineInDisks& edge = lines_.edges[inserter_.line_edge_of(a, b)];
        for (const VertexId v : {edge.p, edge.q}) {
            if (is_on_edge_at(c, v)) {
                return inner_product(key(v), key(a), key(b)) > 0 ? -kSteps : kSteps;
            }
        }
        return 0;
    }

    // Whether c is on an edge of a line that ends at v, which is no Steiner point.
    [[nodiscard]] bool is_on_edge_at(VertexId c, VertexId v) const {
        const auto& edges = inserter_.line_edges();
        if (c.value < inserter_.old_vertex_count()) {
            return std::binary_search(edges.begin(), edges.end(), std::pair(std::min(c, v), std::max(c, v)));
        }
        const std::uint32_t line_edge = inserter_.line_edge_of(c, c);
        return line_edge < edges.size() && (edges[line_edge].first == v || edges[line_edge].second == v);
    }

    // If a wall passes between an edge and the apex c that disturbs it, the wall has an end in the circle
    // through both: else the wall's disk would hold c or an end of the edge, and it holds no vertex. So when
    // there is no such end, the projection of c passes no wall, as in Lemma 6.6.
    [[nodiscard]] std::optional<std::uint32_t> find_circle_point(HalfEdgeId h) const {
        const TriangleMesh& mesh = tin_.mesh;
        const VertexId a = mesh.origin(h);
        const VertexId b = mesh.destination(h);
        const VertexId c = mesh.origin(previous(h));
        return points_.find_in_cap(key(a), key(b), key(c), [&](const CirclePoint& point) {
            return !is_behind(next(h), point) && !is_behind(previous(h), point);
        });
    }

    // Whether a line runs along the half-edge and hides the point.
    [[nodiscard]] bool is_behind(HalfEdgeId h, const CirclePoint& point) const {
        const TriangleMesh& mesh = tin_.mesh;
        const VertexId a = mesh.origin(h);
        const VertexId b = mesh.destination(h);
        return mesh.is_constrained(h) && orient2d(key(a), key(b), point.key) < 0 &&
               inserter_.line_edge_of(a, b) != point.line_edge;
    }

    void put_in(CirclePoint& point, VertexId near) {
        point.is_done = true;
        if (point.line_edge == CirclePoint::kNone) {
            if (inserter_.insert(point.key, near)) {
                mark_touched();
                ++report_.touching_vertices;
            }
        } else if (!is_cut_[point.line_edge]) {
            cut(point.line_edge);
        }
    }

    SteinerInserter& inserter_;
    const Tin& tin_;
    std::size_t max_steiner_;
    const Progress& progress_;
    BlockingDisks disks_;
    LinesInDisks lines_;
    CirclePoints points_;
    std::vector<bool> is_cut_;                   // of each edge of a line
    std::vector<std::vector<VertexId>> chains_;  // of each unprotected edge, once it is cut out
    std::vector<bool> is_stale_;     // of each side of each unprotected edge: faces there have changed
    std::vector<VertexId> sources_;  // of each Steiner point that is a projection; the ghost vertex: of none
    BlockingReport report_;
};

}  // namespace

BlockingReport block_and_propagate(SteinerInserter& inserter, std::size_t max_steiner,
                                   const Progress& progress) {
    return Propagation(inserter, max_steiner, progress).run();
}

}  // namespace tinwright
