#include "support/constrained_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/oracles.hpp"

namespace tinwright_tests {

using namespace tinwright;

namespace {

using Edge = std::pair<VertexId, VertexId>;

std::string name_of(const Tin& tin, VertexId v) {
    return std::to_string(tin.key(v).x) + " " + std::to_string(tin.key(v).y);
}

std::set<Edge> constrained_edges(const TriangleMesh& mesh) {
    std::set<Edge> edges;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            if (mesh.is_constrained(h)) {
                edges.insert(std::minmax(mesh.origin(h), mesh.destination(h)));
            }
        }
    }
    return edges;
}

// Whether `key` lies within `allowed` steps of the segment, in x or in y along its shorter extent.
bool is_beside(Key2 a, Key2 b, Key2 key, double allowed) {
    const double x_low = std::min(a.x, b.x) - allowed;
    const double x_high = std::max(a.x, b.x) + allowed;
    const double y_low = std::min(a.y, b.y) - allowed;
    const double y_high = std::max(a.y, b.y) + allowed;
    if (key.x < x_low || key.x > x_high || key.y < y_low || key.y > y_high) {
        return false;
    }
    if (allowed == 0) {
        return oracle::orient2d(a, b, key) == 0;
    }
    // Distance along the shorter extent, in long doubles: an audit of a bound, not of a sign.
    const long double dx = static_cast<long double>(b.x) - a.x;
    const long double dy = static_cast<long double>(b.y) - a.y;
    const long double cross =
        std::abs(dx * (static_cast<long double>(key.y) - a.y) - dy * (static_cast<long double>(key.x) - a.x));
    // The square of side 2 * allowed around the key meets the line.
    return cross <= static_cast<long double>(allowed) * (std::abs(dx) + std::abs(dy)) * (1 + 1e-12L);
}

}  // namespace

std::string constrained_delaunay_defect(const Tin& tin) {
    const MeshCheckReport connectivity = check_mesh(tin.mesh);
    if (!connectivity.is_clean()) {
        return connectivity.violations[0].text;
    }
    const TinCheckReport geometry = check_tin(tin);
    if (!geometry.is_clean()) {
        return geometry.violations[0].text;
    }
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            const HalfEdgeId t = tin.mesh.twin(h);
            if (tin.mesh.is_ghost({f}) || tin.mesh.is_ghost(face_of(t)) || tin.mesh.is_constrained(h) ||
                t < h) {
                continue;
            }
            if (oracle::incircle_perturbed(tin.key(tin.mesh.origin(h)), tin.key(tin.mesh.destination(h)),
                                           tin.key(tin.mesh.origin(previous(h))),
                                           tin.key(tin.mesh.origin(previous(t)))) > 0) {
                return "the edge from " + name_of(tin, tin.mesh.origin(h)) + " to " +
                       name_of(tin, tin.mesh.destination(h)) + " is not Delaunay";
            }
        }
    }
    const std::set<Edge> constrained = constrained_edges(tin.mesh);
    for (std::size_t i = 0; i < tin.traces.size(); ++i) {
        const LineTrace& trace = tin.traces[i];
        if (!(trace.a < trace.b) || (i > 0 && !(tin.traces[i - 1] < trace))) {
            return "traces are not in order";
        }
        if (!constrained.contains({trace.a, trace.b})) {
            return "a trace's edge is not constrained: " + name_of(tin, trace.a);
        }
    }
    return {};
}

std::string empty_disk_defect(const Tin& tin) {
    Edge before{};
    for (const LineTrace& trace : tin.traces) {
        if (Edge{trace.a, trace.b} == before) {
            continue;
        }
        before = {trace.a, trace.b};
        const Key2 a = tin.key(trace.a);
        const Key2 b = tin.key(trace.b);
        // On each side the vertex that sees the edge under the largest angle; a circle fits between the two.
        std::optional<Key2> left;
        std::optional<Key2> right;
        for (const Key2 c : tin.keys) {
            const int side = oracle::orient2d(a, b, c);
            if (side > 0 && (!left || oracle::incircle(a, b, *left, c) > 0)) {
                left = c;
            } else if (side < 0 && (!right || oracle::incircle(b, a, *right, c) > 0)) {
                right = c;
            } else if (side == 0 && c != a && c != b && is_beside(a, b, c, 0)) {
                return "a vertex lies on the edge from " + name_of(tin, trace.a);
            }
        }
        if (left && right && oracle::incircle(a, b, *left, *right) > 0) {
            return "the edge from " + name_of(tin, trace.a) + " to " + name_of(tin, trace.b) +
                   " has no empty disk";
        }
    }
    return {};
}

std::string chain_defect(const Tin& tin, std::span<const Breakline> lines, double allowed) {
    std::map<std::uint32_t, std::map<VertexId, std::vector<VertexId>>> next;
    for (const LineTrace& trace : tin.traces) {
        next[trace.line][trace.a].push_back(trace.b);
        next[trace.line][trace.b].push_back(trace.a);
    }
    std::map<std::pair<double, double>, VertexId> vertex_at;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        vertex_at[{tin.keys[v].x, tin.keys[v].y}] = {v};
    }
    for (std::uint32_t line = 0; line < lines.size(); ++line) {
        const std::vector<Point3>& points = lines[line].points;
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Key2 a = tin.lattice.key({points[i].x, points[i].y});
            const Key2 b = tin.lattice.key({points[i + 1].x, points[i + 1].y});
            const auto from = vertex_at.find({a.x, a.y});
            const auto to = vertex_at.find({b.x, b.y});
            if (from == vertex_at.end() || to == vertex_at.end()) {
                return "a point of line " + std::to_string(line) + " is no vertex";
            }
            // The line's edges beside the segment lead from one end to the other.
            std::set<VertexId> reached = {from->second};
            std::deque<VertexId> open = {from->second};
            while (!open.empty()) {
                const VertexId v = open.front();
                open.pop_front();
                for (const VertexId w : next[line][v]) {
                    if (is_beside(a, b, tin.key(w), allowed) && reached.insert(w).second) {
                        open.push_back(w);
                    }
                }
            }
            if (!reached.contains(to->second)) {
                return "a segment of line " + std::to_string(line) + " from " + name_of(tin, from->second) +
                       " to " + name_of(tin, to->second) + " is no chain of edges";
            }
        }
    }
    return {};
}

}  // namespace tinwright_tests
