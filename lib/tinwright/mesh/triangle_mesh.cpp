#include "tinwright/mesh/triangle_mesh.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "tinwright/geometry/error.hpp"

namespace tinwright {
namespace {

using Face = TriangleMesh::Face;

constexpr HalfEdgeId kNoHalfEdge{0xFFFFFFFFU};
/// Half-edge ids are 32 bits wide and four a slot.
constexpr std::size_t kSlotLimit = std::size_t{1} << 30U;

[[noreturn]] void refuse(const std::string& text, std::size_t face) {
    throw InputError("face " + std::to_string(face) + ": " + text);
}

TriangleMesh::Faces make_unlinked_faces(std::size_t vertex_count, std::span<const VertexId> corners) {
    if (corners.size() % 3 != 0) {
        throw InputError("the number of corners, " + std::to_string(corners.size()) +
                         ", is not a multiple of three");
    }
    if (corners.size() / 3 >= kSlotLimit || vertex_count >= kGhostVertex.value) {
        throw InputError("too many faces or vertices for one mesh: " + std::to_string(corners.size() / 3) +
                         " faces, " + std::to_string(vertex_count) + " vertices");
    }
    TriangleMesh::Faces faces(corners.size() / 3, Face{});
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexId v = corners[3 * f + i];
            if (v.value >= vertex_count) {
                refuse("corner " + std::to_string(v.value) + " is not one of the " +
                           std::to_string(vertex_count) + " vertices",
                       f);
            }
            faces[f].vertex[i] = v;
        }
        const auto& v = faces[f].vertex;
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
            refuse("two corners are the same vertex", f);
        }
        faces[f].twin.fill(kNoHalfEdge);
    }
    return faces;
}

/// A half-edge as seen from the lesser end of its edge.
struct EdgeUse {
    std::uint32_t greater_end = 0;
    HalfEdgeId half_edge{};
};

VertexId origin_of(const TriangleMesh::Faces& faces, HalfEdgeId h) {
    return faces[face_of(h).value].vertex[corner_of(h)];
}
HalfEdgeId& twin_of(TriangleMesh::Faces& faces, HalfEdgeId h) {
    return faces[face_of(h).value].twin[corner_of(h)];
}

/// Pairs the uses of the edges that share their lesser end.
void link_uses(TriangleMesh::Faces& faces, std::span<EdgeUse> uses) {
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return a.greater_end != b.greater_end ? a.greater_end < b.greater_end : a.half_edge < b.half_edge;
    });
    for (std::size_t i = 1; i < uses.size(); ++i) {
        const HalfEdgeId h = uses[i].half_edge;
        if (uses[i].greater_end != uses[i - 1].greater_end) {
            continue;
        }
        const HalfEdgeId partner = uses[i - 1].half_edge;
        const bool is_third = twin_of(faces, partner) != kNoHalfEdge;
        if (is_third || origin_of(faces, h) == origin_of(faces, partner)) {
            refuse("the edge between vertices " + std::to_string(origin_of(faces, h).value) + " and " +
                       std::to_string(origin_of(faces, next(h)).value) + " is used " +
                       (is_third ? "by more than two faces" : "in the same direction") + ", also by face " +
                       std::to_string(face_of(partner).value),
                   face_of(h).value);
        }
        twin_of(faces, h) = partner;
        twin_of(faces, partner) = h;
    }
}

/// Finds twins by sorting the half-edges on their edge: first by the lesser end, counting, then within.
void link_faces(TriangleMesh::Faces& faces, std::size_t vertex_count) {
    std::vector<std::uint32_t> first(vertex_count + 1, 0);
    const auto lesser_end = [](const Face& face, unsigned i) {
        return std::min(face.vertex[i], face.vertex[next_corner(i)]).value;
    };
    for (const Face& face : faces) {
        for (unsigned i = 0; i < 3; ++i) {
            ++first[lesser_end(face, i) + 1];
        }
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
        first[v + 1] += first[v];
    }
    std::vector<EdgeUse> uses(3 * faces.size());
    std::vector<std::uint32_t> free = first;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const VertexId greater = std::max(faces[f].vertex[i], faces[f].vertex[next_corner(i)]);
            uses[free[lesser_end(faces[f], i)]++] = {greater.value, half_edge({f}, i)};
        }
    }
    const std::span<EdgeUse> all(uses);
    for (std::size_t v = 0; v < vertex_count; ++v) {
        link_uses(faces, all.subspan(first[v], first[v + 1] - first[v]));
    }
}

/// Puts a ghost face behind every border edge and links ghosts around the border.
///
/// At a vertex that several border loops touch, each fan of faces closes with its own two ghosts: the turn
/// is found by walking the fan from the border edge that leaves the vertex to the one that arrives.
void add_ghosts(TriangleMesh::Faces& faces) {
    const auto real = static_cast<std::uint32_t>(faces.size());
    for (std::uint32_t f = 0; f < real; ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            if (faces[f].twin[i] != kNoHalfEdge) {
                continue;
            }
            const HalfEdgeId h = half_edge({f}, i);
            const FaceId ghost{static_cast<std::uint32_t>(faces.size())};
            if (ghost.value >= kSlotLimit) {
                throw InputError("too many faces for one mesh");
            }
            Face record{};
            record.vertex = {origin_of(faces, next(h)), origin_of(faces, h), kGhostVertex};
            record.twin = {h, kNoHalfEdge, kNoHalfEdge};
            twin_of(faces, h) = half_edge(ghost, 0);
            faces.push_back(record);
        }
    }
    for (std::uint32_t g = real; g < faces.size(); ++g) {
        HalfEdgeId arriving = previous(faces[g].twin[0]);
        while (face_of(twin_of(faces, arriving)).value < real) {
            arriving = previous(twin_of(faces, arriving));
        }
        const HalfEdgeId leaving_ghost = half_edge({g}, 1);
        const HalfEdgeId arriving_ghost = previous(twin_of(faces, arriving));
        twin_of(faces, leaving_ghost) = arriving_ghost;
        twin_of(faces, arriving_ghost) = leaving_ghost;
    }
}

}  // namespace

void TriangleMesh::set_constrained(HalfEdgeId h, bool constrained) {
    for (const HalfEdgeId side : {h, twin(h)}) {
        std::uint32_t& marks = faces_[face_of(side).value].marks;
        const std::uint32_t bit = 1U << corner_of(side);
        marks = constrained ? marks | bit : marks & ~bit;
    }
}

void TriangleMesh::set_terrain(FaceId f, bool terrain) {
    std::uint32_t& marks = faces_[f.value].marks;
    marks = terrain ? marks & ~kOutsideMark : marks | kOutsideMark;
}

std::size_t TriangleMesh::count_terrain() const {
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        count += is_terrain({f}) ? 1 : 0;
    }
    return count;
}

TriangleMesh make_mesh(std::size_t vertex_count, std::span<const VertexId> corners) {
    TriangleMesh::Faces faces = make_unlinked_faces(vertex_count, corners);
    link_faces(faces, vertex_count);
    add_ghosts(faces);
    return {vertex_count, std::move(faces)};
}

}  // namespace tinwright
