#include "tinwright/io/tin_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

namespace tinwright::io {
namespace {

constexpr const char* kBorderWord = "border";  // a constrained edge of the border that no line runs along

// The corner that a face is written from: that of the smallest vertex.
unsigned first_corner(const TriangleMesh::Face& face) {
    const auto& v = face.vertex;
    const unsigned smaller = v[1] < v[0] ? 1 : 0;
    return v[2] < v[smaller] ? 2 : smaller;
}

struct Incline {
    double slope_deg = 0;
    double aspect_deg = 0;  // of the fall line, clockwise from north; nothing when level
    bool is_level = false;
    double area = 0;
};

Incline incline_of(const Tin& tin, const std::array<VertexId, 3>& v, double z_factor) {
    constexpr double kDegrees = 180 / std::numbers::pi;
    const double quantum = tin.lattice.quantum();
    const Key2 a = tin.key(v[0]);
    const double ux = (tin.key(v[1]).x - a.x) * quantum;
    const double uy = (tin.key(v[1]).y - a.y) * quantum;
    const double uz = tin.z[v[1].value] - tin.z[v[0].value];
    const double wx = (tin.key(v[2]).x - a.x) * quantum;
    const double wy = (tin.key(v[2]).y - a.y) * quantum;
    const double wz = tin.z[v[2].value] - tin.z[v[0].value];
    const double twice_area = ux * wy - uy * wx;
    const double fall_x = -(uz * wy - wz * uy) / twice_area;
    const double fall_y = -(wz * ux - uz * wx) / twice_area;
    Incline incline;
    incline.area = twice_area / 2;
    incline.slope_deg = std::atan(z_factor * std::hypot(fall_x, fall_y)) * kDegrees;
    incline.is_level = fall_x == 0 && fall_y == 0;
    const double aspect = std::atan2(fall_x, fall_y) * kDegrees;
    incline.aspect_deg = aspect < 0 ? aspect + 360 : aspect;
    return incline;
}

std::array<Point2, 3> corners_in_plane(const Tin& tin, const std::array<VertexId, 3>& v) {
    std::array<Point2, 3> corners{};
    std::transform(v.begin(), v.end(), corners.begin(), [&](VertexId vertex) {
        const Point3 p = tin.position(vertex);
        return Point2{p.x, p.y};
    });
    return corners;
}

int as_int(VertexId v) { return static_cast<int>(v.value); }

// Which of two lines along an edge is told: one of water rather, for it is read from the file again; then by
// source and feature.
bool goes_first(const LineOrigin& a, const LineOrigin& b) {
    return std::tuple(!is_water_role(a.role), a.source, a.feature) <
           std::tuple(!is_water_role(b.role), b.source, b.feature);
}

// The first line along an edge.
std::optional<LineOrigin> find_line(const Tin& tin, std::span<const LineOrigin> lines, VertexId a,
                                    VertexId b) {
    const auto first =
        std::lower_bound(tin.traces.begin(), tin.traces.end(), std::pair(a, b),
                         [](const LineTrace& trace, const std::pair<VertexId, VertexId>& edge) {
                             return std::pair(trace.a, trace.b) < edge;
                         });
    std::optional<LineOrigin> found;
    for (auto trace = first; trace != tin.traces.end() && trace->a == a && trace->b == b; ++trace) {
        if (trace->line >= lines.size()) {
            continue;
        }
        const LineOrigin& line = lines[trace->line];
        if (!found || goes_first(line, *found)) {
            found = line;
        }
    }
    return found;
}

// The fields `role`, `source`, `feature` and `sharp` of an edge.
void set_line(TinLayer& edges, const std::optional<LineOrigin>& line, bool is_border) {
    for (const std::size_t field : {4U, 5U, 6U, 7U}) {
        edges.set_null(field);
    }
    if (!line) {
        if (is_border) {
            edges.set(4, std::string(kBorderWord));
        }
        return;
    }
    edges.set(4, std::string(role_name(line->role)));
    if (line->source > 0) {
        edges.set(5, line->source);
    }
    if (line->feature >= 0) {
        edges.set(6, line->feature);
    }
    edges.set(7, line->is_sharp ? 1 : 0);
}

// Calls visit(half-edge) once for each edge of a terrain face, by slots; from the face with the lower slot.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, const Visit& visit) {
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (!mesh.is_terrain({f})) {
            continue;
        }
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const FaceId other = face_of(mesh.twin(h));
            if (!mesh.is_terrain(other) || f < other.value) {
                visit(h);
            }
        }
    }
}

}  // namespace

bool has_water(const WriteTinOptions& options) {
    return std::find(options.is_water_face.begin(), options.is_water_face.end(), true) !=
           options.is_water_face.end();
}

std::size_t write_faces(TinDataset& dataset, const std::string& layer, const Tin& tin,
                        const WriteTinOptions& options, const Tick& tick) {
    constexpr std::array<TinField, 9> kFields = {{{"id", OFTInteger},
                                                  {"a", OFTInteger},
                                                  {"b", OFTInteger},
                                                  {"c", OFTInteger},
                                                  {"constr", OFTInteger},
                                                  {"slope", OFTReal},
                                                  {"aspect", OFTReal},
                                                  {"area", OFTReal},
                                                  {"water", OFTInteger}}};
    const bool has_field_water = has_water(options);
    const std::span<const TinField> used = std::span(kFields).first(has_field_water ? 9 : 8);
    TinLayer faces = dataset.add_layer(layer, wkbPolygon25D, used, tin);
    auto& polygon = faces.geometry<OGRPolygon>();
    polygon.addRingDirectly(new OGRLinearRing);
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        unsigned corner = first_corner(tin.mesh.face({f}));
        std::array<VertexId, 3> v{};
        std::array<Point3, 3> p;
        int constrained = 0;
        for (unsigned i = 0; i < 3; ++i, corner = next_corner(corner)) {
            v[i] = tin.mesh.vertex({f}, corner);
            p[i] = written_position(tin, options, v[i]);
            faces.set(1 + i, as_int(v[i]));
            constrained |= static_cast<int>(tin.mesh.is_constrained(half_edge({f}, corner))) << i;
        }
        // The object may have moved: the layer takes it back from the feature after each write.
        OGRLinearRing& ring = *faces.geometry<OGRPolygon>().getExteriorRing();
        ring.setNumPoints(4, FALSE);
        for (int i = 0; i < 4; ++i) {
            const Point3& q = p[static_cast<unsigned>(i % 3)];
            ring.setPoint(i, q.x, q.y, q.z);
        }
        const Incline incline = incline_of(tin, v, options.z_factor);
        faces.set(0, static_cast<int>(faces.written()));
        faces.set(4, constrained);
        faces.set(5, incline.slope_deg);
        if (incline.is_level) {
            faces.set_null(6);
        } else {
            faces.set(6, incline.aspect_deg);
        }
        faces.set(
            7, options.ground.area_function ? options.ground.area(corners_in_plane(tin, v)) : incline.area);
        if (has_field_water) {
            faces.set(8, options.is_water_face[f] ? 1 : 0);
        }
        faces.write();
        tick();
    }
    return faces.written();
}

std::size_t write_surface(TinDataset& dataset, const std::string& layer, const Tin& tin,
                          const WriteTinOptions& options, const Tick& tick) {
    constexpr std::array<TinField, 2> kFields = {{{"id", OFTInteger}, {"faces", OFTInteger}}};
    TinLayer surfaces = dataset.add_layer(layer, wkbTINZ, kFields, tin);
    auto& surface = surfaces.geometry<OGRTriangulatedSurface>();
    int count = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        unsigned corner = first_corner(tin.mesh.face({f}));
        std::array<OGRPoint, 3> p;
        for (OGRPoint& point : p) {
            const Point3 q = written_position(tin, options, tin.mesh.vertex({f}, corner));
            point = OGRPoint(q.x, q.y, q.z);
            corner = next_corner(corner);
        }
        surface.addGeometryDirectly(new OGRTriangle(p[0], p[1], p[2]));
        ++count;
        tick();
    }
    surfaces.set(0, 0);
    surfaces.set(1, count);
    surfaces.write();
    return surfaces.written();
}

std::size_t write_edges(TinDataset& dataset, const std::string& layer, const Tin& tin,
                        const WriteTinOptions& options, bool constrained_only, const Tick& tick) {
    constexpr std::array<TinField, 9> kFields = {{{"id", OFTInteger},
                                                  {"a", OFTInteger},
                                                  {"b", OFTInteger},
                                                  {"border", OFTInteger},
                                                  {"role", OFTString},
                                                  {"source", OFTInteger},
                                                  {"feature", OFTInteger64},
                                                  {"sharp", OFTInteger},
                                                  {"constr", OFTInteger}}};
    const std::span<const TinField> used = std::span(kFields).first(constrained_only ? 8 : 9);
    TinLayer edges = dataset.add_layer(layer, wkbLineString25D, used, tin);
    edges.geometry<OGRLineString>().setNumPoints(2);
    for_each_edge(tin.mesh, [&](HalfEdgeId h) {
        const bool constrained = tin.mesh.is_constrained(h);
        if (constrained_only && !constrained) {
            return;
        }
        const VertexId a = std::min(tin.mesh.origin(h), tin.mesh.destination(h));
        const VertexId b = std::max(tin.mesh.origin(h), tin.mesh.destination(h));
        const Point3 p = written_position(tin, options, a);
        const Point3 q = written_position(tin, options, b);
        auto& line = edges.geometry<OGRLineString>();
        line.setPoint(0, p.x, p.y, p.z);
        line.setPoint(1, q.x, q.y, q.z);
        edges.set(0, static_cast<int>(edges.written()));
        edges.set(1, as_int(a));
        edges.set(2, as_int(b));
        edges.set(3, tin.mesh.is_border(h) ? 1 : 0);
        set_line(edges, constrained ? find_line(tin, options.lines, a, b) : std::nullopt,
                 constrained && tin.mesh.is_border(h));
        if (!constrained_only) {
            edges.set(8, constrained ? 1 : 0);
        }
        edges.write();
        tick();
    });
    return edges.written();
}

std::size_t write_vertices(TinDataset& dataset, const std::string& layer, const Tin& tin,
                           const WriteTinOptions& options, const Tick& tick) {
    const VertexOrigins& origins = options.origins;
    constexpr std::array<TinField, 6> kFields = {{{"id", OFTInteger},
                                                  {"steiner", OFTInteger},
                                                  {"source", OFTInteger},
                                                  {"feature", OFTInteger64},
                                                  {"crossing", OFTInteger},
                                                  {"inserted", OFTInteger}}};
    TinLayer vertices = dataset.add_layer(layer, wkbPoint25D, kFields, tin);
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const Point3 p = written_position(tin, options, {v});
        auto& point = vertices.geometry<OGRPoint>();
        point.setX(p.x);
        point.setY(p.y);
        point.setZ(p.z);
        vertices.set(0, static_cast<int>(v));
        vertices.set(1, tin.sample[v] == Tin::kNoSample ? 1 : 0);
        if (v < origins.source.size() && origins.source[v] > 0) {
            vertices.set(2, origins.source[v]);
        } else {
            vertices.set_null(2);
        }
        if (v < origins.feature.size() && origins.feature[v] >= 0) {
            vertices.set(3, origins.feature[v]);
        } else {
            vertices.set_null(3);
        }
        vertices.set(4, tin.sample[v] == Tin::kCrossing ? 1 : 0);
        vertices.set(5, tin.sample[v] == Tin::kInserted ? 1 : 0);
        vertices.write();
        tick();
    }
    return vertices.written();
}

EdgeCounts count_edges(const TriangleMesh& mesh) {
    EdgeCounts counts;
    for_each_edge(mesh, [&](HalfEdgeId h) {
        ++counts.all;
        counts.constrained += mesh.is_constrained(h) ? 1U : 0U;
    });
    return counts;
}

}  // namespace tinwright::io
