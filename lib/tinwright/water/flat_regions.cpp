#include "tinwright/water/flat_regions.hpp"

#include <algorithm>

#include "tinwright/geometry/constructions.hpp"

namespace tinwright::internal {

namespace {

/// Whether the angles opposite to an edge are together less than a right angle, by their cosines and sines
/// but for positive factors.
bool is_short_for_its_faces(const Tin& tin, HalfEdgeId h) {
    const TriangleMesh& mesh = tin.mesh;
    const Key2 a = tin.key(mesh.origin(h));
    const Key2 b = tin.key(mesh.destination(h));
    const Key2 c = tin.key(mesh.origin(previous(h)));
    const Key2 d = tin.key(mesh.origin(previous(mesh.twin(h))));
    const double cos_c = inner_product(a, c, b);
    const double cos_d = inner_product(a, d, b);
    return cos_c > 0 && cos_d > 0 && cos_c * cos_d > doubled_area(a, b, c) * doubled_area(b, a, d);
}

}  // namespace

bool is_flat(const Tin& tin, FaceId f) {
    const auto& [a, b, c] = tin.mesh.face(f).vertex;
    return tin.z[a.value] == tin.z[b.value] && tin.z[a.value] == tin.z[c.value];
}

FlatRegions::FlatRegions(const Tin& tin, const std::vector<bool>& is_water)
    : tin_(tin), is_water_(is_water), is_on_line_(tin.vertex_count()), is_measured_(tin.vertex_count()) {
    for (const LineTrace& trace : tin.traces) {
        is_on_line_[trace.a.value] = true;
        is_on_line_[trace.b.value] = true;
    }
    find_measured();
    find_contour_pieces();
}

void FlatRegions::find_measured() {
    const TriangleMesh& mesh = tin_.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (is_dry({f}) && is_flat(tin_, {f})) {
            for (const VertexId v : mesh.face({f}).vertex) {
                is_measured_[v.value] = !is_on_line_[v.value];
            }
        }
    }
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (!is_dry({f}) || !is_flat(tin_, {f})) {
            for (const VertexId v : mesh.face({f}).vertex) {
                if (v != kGhostVertex) {
                    is_measured_[v.value] = false;
                }
            }
        }
    }
}

void FlatRegions::find_contour_pieces() {
    const TriangleMesh& mesh = tin_.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && is_treated({f}); ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            const VertexId a = mesh.origin(h);
            const VertexId b = mesh.destination(h);
            const bool is_between_lines = is_on_line_[a.value] && is_on_line_[b.value];
            if (!mesh.is_constrained(h) && !is_between_lines && is_dry(face_of(mesh.twin(h))) &&
                is_short_for_its_faces(tin_, h)) {
                contour_pieces_.emplace_back(std::min(a, b), std::max(a, b));
            }
        }
    }
    std::sort(contour_pieces_.begin(), contour_pieces_.end());
    contour_pieces_.erase(std::unique(contour_pieces_.begin(), contour_pieces_.end()), contour_pieces_.end());
}

bool FlatRegions::is_treated(FaceId f) const {
    if (!is_dry(f) || !is_flat(tin_, f)) {
        return false;
    }
    const auto& corners = tin_.mesh.face(f).vertex;
    return std::none_of(corners.begin(), corners.end(), [this](VertexId v) {
        return v.value < is_measured_.size() && is_measured_[v.value];
    });
}

FlatEdge FlatRegions::kind(HalfEdgeId h) const {
    const TriangleMesh& mesh = tin_.mesh;
    const FaceId across = face_of(mesh.twin(h));
    if (mesh.is_constrained(h) || !is_dry(across)) {
        return FlatEdge::Wall;
    }
    const std::pair<VertexId, VertexId> edge = std::minmax(mesh.origin(h), mesh.destination(h));
    if (std::binary_search(contour_pieces_.begin(), contour_pieces_.end(), edge)) {
        return FlatEdge::Wall;
    }
    if (!is_flat(tin_, across)) {
        return FlatEdge::Opening;
    }
    return is_treated(across) ? FlatEdge::Inner : FlatEdge::Wall;
}

}  // namespace tinwright::internal
