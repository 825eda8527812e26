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
    [[nodiscard]] Key2 nearest_point(Key2 from) const {
        const double along_x = b.x - a.x;
        const double along_y = b.y - a.y;
        const double part =
            ((from.x - a.x) * along_x + (from.y - a.y) * along_y) / (along_x * along_x + along_y * along_y);
        return part <= 0 ? a : part >= 1 ? b : Key2{a.x + part * along_x, a.y + part * along_y};
    }
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

    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        std::uint32_t edge = 0;
    };

    /// Over the edges whose boxes meet a box; of equally near ones the first.
    [[nodiscard]] Nearest nearest_within(const KeyBox& box, Key2 from) const {
        Nearest nearest;
        tree.visit_meeting(
            box, [](const KeyBox&) { return false; },
            [&](std::uint32_t item) {
                const double distance = edges[item].distance(from);
                if (distance < nearest.distance || (distance == nearest.distance && item < nearest.edge)) {
                    nearest = {distance, item};
                }
                return true;
            });
        return nearest;
    }

    /// In steps of the TIN's lattice.
    [[nodiscard]] Key2 place(Key2 at) const { return {at.x / lattice.scale(), at.y / lattice.scale()}; }

    /// There is an edge.
    [[nodiscard]] Nearest nearest_to(Key2 from) const {
        double reach = first_reach;
        Nearest nearest = nearest_within(box_around(from, reach), from);
        while (!(nearest.distance <= reach)) {
            // A box that met something may have left out what is nearer; one that reaches as far has not.
            reach = std::isfinite(nearest.distance) ? nearest.distance : 2 * reach;
            nearest = nearest_within(box_around(from, reach), from);
        }
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
    return is_empty() ? std::numeric_limits<double>::infinity()
                      : state_->nearest_to(state_->place(at)).distance / state_->steps_per_unit;
}

double BreaklineDistance::at(Key2 at, const GroundMeasures& ground) const {
    if (is_empty() || !ground.is_geodesic()) {
        return this->at(at);
    }
    const Key2 from = state_->place(at);
    const Key2 to = state_->edges[state_->nearest_to(from).edge].nearest_point(from);
    const double scale = state_->lattice.scale();
    return ground.length(state_->lattice.position(at),
                         state_->lattice.position({to.x * scale, to.y * scale}));
}

}  // namespace tinwright
