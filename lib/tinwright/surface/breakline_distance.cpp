#include "tinwright/surface/breakline_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {

namespace {

/// In keys of the TIN.
struct Edge {
    Key2 a;
    Key2 b;

    [[nodiscard]] KeyBox box() const { return KeyBox::of(std::array{a, b}); }
    /// Offsets of keys from a place of the query lattice are exact.
    [[nodiscard]] double distance(Key2 from) const {
        const double along_x = b.x - a.x;
        const double along_y = b.y - a.y;
        const double to_x = from.x - a.x;
        const double to_y = from.y - a.y;
        const double square = along_x * along_x + along_y * along_y;
        const double part = (to_x * along_x + to_y * along_y) / square;
        if (part <= 0) {
            return std::hypot(to_x, to_y);
        }
        if (part >= 1) {
            return std::hypot(from.x - b.x, from.y - b.y);
        }
        return std::abs(to_x * along_y - to_y * along_x) / std::sqrt(square);
    }
};

bool is_breakline_edge(const Tin& tin, const std::vector<bool>& is_breakline, HalfEdgeId h) {
    const VertexId a = std::min(tin.mesh.origin(h), tin.mesh.destination(h));
    const VertexId b = std::max(tin.mesh.origin(h), tin.mesh.destination(h));
    bool has_lines = false;
    const LineTrace edge{a, b, 0, 0};
    for (auto trace = std::lower_bound(tin.traces.begin(), tin.traces.end(), edge);
         trace != tin.traces.end() && trace->a == a && trace->b == b; ++trace) {
        has_lines = true;
        if (trace->line >= is_breakline.size() || is_breakline[trace->line]) {
            return true;
        }
    }
    return !has_lines && !tin.mesh.is_border(h);
}

std::vector<Edge> find_edges(const Tin& tin, const std::vector<bool>& is_breakline) {
    const TriangleMesh& mesh = tin.mesh;
    std::vector<Edge> edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            const bool is_seen_before = mesh.is_terrain(face_of(mesh.twin(h))) && mesh.twin(h) < h;
            if (mesh.is_constrained(h) && !is_seen_before && is_breakline_edge(tin, is_breakline, h)) {
                edges.push_back({tin.key(mesh.origin(h)), tin.key(mesh.destination(h))});
            }
        }
    }
    return edges;
}

BoxTree make_tree(const std::vector<Edge>& edges) {
    std::vector<KeyBox> boxes;
    boxes.reserve(edges.size());
    for (const Edge& edge : edges) {
        boxes.push_back(edge.box());
    }
    return BoxTree(boxes);
}

KeyBox box_around(Key2 middle, double reach) {
    return {{middle.x - reach, middle.y - reach}, {middle.x + reach, middle.y + reach}};
}

}  // namespace

struct BreaklineDistance::State {
    State(const Tin& tin, const std::vector<bool>& is_breakline)
        : lattice(tin),
          steps_per_unit(tin.lattice.steps_per_unit()),
          edges(find_edges(tin, is_breakline)),
          tree(make_tree(edges)) {
        if (!edges.empty()) {
            KeyBox all = edges.front().box();
            for (const Edge& edge : edges) {
                all.add(edge.box());
            }
            // About the reach that has one edge in it, were they spread evenly.
            first_reach = std::max(1.0, std::max(all.high.x - all.low.x, all.high.y - all.low.y) /
                                            std::sqrt(static_cast<double>(edges.size())));
        }
    }

    /// Over the edges whose boxes meet a box.
    [[nodiscard]] double nearest_within(const KeyBox& box, Key2 from) const {
        double nearest = std::numeric_limits<double>::infinity();
        tree.visit_meeting(
            box, [](const KeyBox&) { return false; },
            [&](std::uint32_t item) {
                nearest = std::min(nearest, edges[item].distance(from));
                return true;
            });
        return nearest;
    }

    QueryLattice lattice;
    double steps_per_unit;
    std::vector<Edge> edges;
    BoxTree tree;
    double first_reach = 1;
};

BreaklineDistance::BreaklineDistance(const Tin& tin, const std::vector<bool>& is_breakline)
    : state_(std::make_unique<State>(tin, is_breakline)) {}
BreaklineDistance::~BreaklineDistance() = default;

bool BreaklineDistance::is_empty() const { return state_->edges.empty(); }

double BreaklineDistance::at(Key2 at) const {
    if (is_empty()) {
        return std::numeric_limits<double>::infinity();
    }
    const Key2 from{at.x / state_->lattice.scale(), at.y / state_->lattice.scale()};
    double reach = state_->first_reach;
    double nearest = state_->nearest_within(box_around(from, reach), from);
    while (!(nearest <= reach)) {
        // A box that met something may have left out what is nearer; one that reaches as far has not.
        reach = std::isfinite(nearest) ? nearest : 2 * reach;
        nearest = state_->nearest_within(box_around(from, reach), from);
    }
    return nearest / state_->steps_per_unit;
}

}  // namespace tinwright
