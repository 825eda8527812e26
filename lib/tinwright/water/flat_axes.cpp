#include "tinwright/water/flat_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright::internal {

namespace {

double distance(double x, double y, Key2 to) {
    return std::sqrt((to.x - x) * (to.x - x) + (to.y - y) * (to.y - y));
}

double distance_to_segment(double x, double y, Key2 a, Key2 b) {
    const double length = squared_distance(a, b);
    const double share = ((x - a.x) * (b.x - a.x) + (y - a.y) * (b.y - a.y)) / length;
    const double t = std::clamp(share, 0.0, 1.0);
    const double dx = a.x + t * (b.x - a.x) - x;
    const double dy = a.y + t * (b.y - a.y) - y;
    return std::sqrt(dx * dx + dy * dy);
}

class AxisFinder {
  public:
    AxisFinder(const Tin& tin, const FlatRegions& regions) : tin_(tin), regions_(regions) {}

    FlatAxes find() {
        for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
            if (regions_.is_treated({f})) {
                faces_.push_back({{f}, {}});
            }
        }
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            make_nodes(i);
        }
        for (const Face& face : faces_) {
            link(face);
        }
        std::sort(axes_.links.begin(), axes_.links.end(), [](const AxisLink& p, const AxisLink& q) {
            return p.from != q.from ? p.from < q.from : p.to < q.to;
        });
        return std::move(axes_);
    }

  private:
    struct Face {
        FaceId face;
        std::array<std::uint32_t, 3> node;  // of each edge
    };

    [[nodiscard]] Key2 key(VertexId v) const { return tin_.key(v); }

    void make_nodes(std::size_t i) {
        Face& face = faces_[i];
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(face.face, corner);
            const HalfEdgeId t = tin_.mesh.twin(h);
            const FlatEdge kind = regions_.kind(h);
            face.node[corner] = AxisNode::kNone;
            if (kind == FlatEdge::Wall) {
                continue;
            }
            if (kind == FlatEdge::Inner && face_of(t) < face.face) {
                const auto other =
                    std::lower_bound(faces_.begin(), faces_.end(), face_of(t),
                                     [](const Face& seen, FaceId sought) { return seen.face < sought; });
                face.node[corner] = other->node[corner_of(t)];
                continue;
            }
            AxisNode node;
            node.a = std::min(tin_.mesh.origin(h), tin_.mesh.destination(h));
            node.b = std::max(tin_.mesh.origin(h), tin_.mesh.destination(h));
            node.face = face.face;
            node.x = (key(node.a).x + key(node.b).x) / 2;
            node.y = (key(node.a).y + key(node.b).y) / 2;
            node.half_width = distance(node.x, node.y, key(node.a));
            if (kind == FlatEdge::Opening) {
                node.outlet = tin_.mesh.origin(previous(t));
            }
            face.node[corner] = add(node);
        }
    }

    std::uint32_t add(const AxisNode& node) {
        axes_.nodes.push_back(node);
        return static_cast<std::uint32_t>(axes_.nodes.size() - 1);
    }

    std::uint32_t add_center(FaceId f) {
        const auto& [a, b, c] = tin_.mesh.face(f).vertex;
        AxisNode node;
        node.a = a;
        node.b = b;
        node.c = c;
        node.face = f;
        node.x = (key(a).x + key(b).x + key(c).x) / 3;
        node.y = (key(a).y + key(b).y + key(c).y) / 3;
        node.half_width = std::min({distance(node.x, node.y, key(a)), distance(node.x, node.y, key(b)),
                                    distance(node.x, node.y, key(c))});
        return add(node);
    }

    void link(const Face& face) {
        std::array<std::uint32_t, 3> passages{};
        std::size_t count = 0;
        for (const std::uint32_t node : face.node) {
            if (node != AxisNode::kNone) {
                passages[count++] = node;
            }
        }
        const std::uint32_t center = count == 0 || count == 3 ? add_center(face.face) : AxisNode::kNone;
        if (count == 1) {
            AxisNode& node = axes_.nodes[passages[0]];
            node.is_single = node.outlet != kGhostVertex && can_be_swapped(node);
            for (const VertexId v : tin_.mesh.face(face.face).vertex) {
                if (v != node.a && v != node.b) {
                    node.end = std::max(node.end, distance(node.x, node.y, key(v)));
                }
            }
        } else if (count == 2) {
            connect(passages[0], passages[1]);
        }
        for (std::size_t i = 0; i < count && center != AxisNode::kNone; ++i) {
            connect(center, passages[i]);
        }
        look_at_walls(face, count == 0 ? center : passages[0]);
    }

    /// Whether the quadrilateral of a node's edge is strictly convex.
    [[nodiscard]] bool can_be_swapped(const AxisNode& node) const {
        const auto& corners = tin_.mesh.face(node.face).vertex;
        const VertexId c = *std::find_if(corners.begin(), corners.end(),
                                         [&](VertexId v) { return v != node.a && v != node.b; });
        const Key2 from = key(c);
        const Key2 to = key(node.outlet);
        return orient2d(from, to, key(node.a)) * orient2d(from, to, key(node.b)) < 0;
    }

    void connect(std::uint32_t p, std::uint32_t q) {
        const AxisNode& from = axes_.nodes[p];
        const AxisNode& to = axes_.nodes[q];
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        axes_.links.push_back({p, q, length});
        axes_.links.push_back({q, p, length});
    }

    /// `first`: the node that takes what is seen of the terrain behind.
    void look_at_walls(const Face& face, std::uint32_t first) {
        const TriangleMesh& mesh = tin_.mesh;
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(face.face, corner);
            const Key2 a = key(mesh.origin(h));
            const Key2 b = key(mesh.destination(h));
            const Key2 opposite = key(mesh.origin(previous(h)));
            for (const std::uint32_t n : face.node) {
                if (n == AxisNode::kNone) {
                    continue;
                }
                AxisNode& node = axes_.nodes[n];
                node.half_width = std::min(node.half_width, distance(node.x, node.y, opposite));
                if (face.node[corner] == AxisNode::kNone) {
                    node.half_width = std::min(node.half_width, distance_to_segment(node.x, node.y, a, b));
                }
            }
            if (face.node[corner] == AxisNode::kNone) {
                AxisNode& node = axes_.nodes[first];
                if (!node.is_on_edge()) {
                    node.half_width = std::min(node.half_width, distance_to_segment(node.x, node.y, a, b));
                }
                look_behind(mesh.twin(h), node);
            }
        }
    }

    void look_behind(HalfEdgeId wall, AxisNode& node) const {
        const TriangleMesh& mesh = tin_.mesh;
        const FaceId behind = face_of(wall);
        if (!regions_.is_dry(behind) || is_flat(tin_, behind)) {
            return;
        }
        const VertexId a = mesh.origin(wall);
        const VertexId b = mesh.destination(wall);
        const VertexId c = mesh.origin(previous(wall));
        const double length = std::sqrt(squared_distance(key(a), key(b)));
        const double fall = tin_.z[a.value] - tin_.z[c.value];
        node.fall += length * fall;
        node.steepness += length * std::abs(fall);
        node.area += doubled_area(key(a), key(b), key(c));
        node.wall_length += length;
    }

    const Tin& tin_;
    const FlatRegions& regions_;
    std::vector<Face> faces_;  // by slot
    FlatAxes axes_;
};

}  // namespace

void leave_out_single_faces(const FlatAxes& axes, std::vector<double>& z) {
    for (std::size_t n = 0; n < z.size(); ++n) {
        if (axes.nodes[n].is_single) {
            z[n] = std::numeric_limits<double>::quiet_NaN();
        }
    }
}

FlatAxes find_flat_axes(const Tin& tin, const FlatRegions& regions) {
    return AxisFinder(tin, regions).find();
}

}  // namespace tinwright::internal
