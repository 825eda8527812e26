#include "tinwright/water/flat_regions.hpp"

#include <algorithm>
#include <cmath>

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

std::pair<VertexId, VertexId> ends_of(const TriangleMesh& mesh, HalfEdgeId h) {
    return std::minmax(mesh.origin(h), mesh.destination(h));
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
    constexpr unsigned char kSloping = 0xFF;
    std::vector<unsigned char> pieces(tin_.vertex_count());  // of contours, as they seem, at each vertex
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        const bool is_level = is_dry({f}) && is_flat(tin_, {f});
        for (unsigned corner = 0; corner < 3; ++corner) {
            const VertexId v = mesh.vertex({f}, corner);
            if (v == kGhostVertex || pieces[v.value] == kSloping) {
                continue;
            }
            if (!is_level || is_on_line_[v.value]) {
                pieces[v.value] = kSloping;
                continue;
            }
            is_measured_[v.value] = true;
            const HalfEdgeId h = half_edge({f}, corner);
            if (is_dry(face_of(mesh.twin(h))) && pieces[v.value] < 3 && is_short_for_its_faces(tin_, h)) {
                ++pieces[v.value];
            }
        }
    }
    for (std::size_t v = 0; v < pieces.size(); ++v) {
        is_measured_[v] = is_measured_[v] && pieces[v] != kSloping && pieces[v] != 2;
    }
}

void FlatRegions::find_contour_pieces() {
    const TriangleMesh& mesh = tin_.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && is_treated({f}); ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            if (is_uncertain(h) && is_short_for_its_faces(tin_, h)) {
                contour_pieces_.push_back(ends_of(mesh, h));
            }
        }
    }
    sort_pieces();
    std::vector<Edge> pieces;
    std::vector<bool> is_seen(mesh.slot_count());
    std::vector<HalfEdgeId> rim;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (!is_seen[f] && is_treated({f})) {
            find_rim({f}, is_seen, rim);
            judge_rim(rim, pieces);
        }
    }
    contour_pieces_ = std::move(pieces);
    sort_pieces();
}

bool FlatRegions::is_uncertain(HalfEdgeId h) const {
    const TriangleMesh& mesh = tin_.mesh;
    return !mesh.is_constrained(h) && is_dry(face_of(mesh.twin(h))) &&
           !(is_on_line_[mesh.origin(h).value] && is_on_line_[mesh.destination(h).value]);
}

void FlatRegions::find_rim(FaceId first, std::vector<bool>& is_seen, std::vector<HalfEdgeId>& rim) const {
    rim.clear();
    std::vector<FaceId> region = {first};
    is_seen[first.value] = true;
    for (std::size_t i = 0; i < region.size(); ++i) {
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(region[i], corner);
            const FaceId across = face_of(tin_.mesh.twin(h));
            if (kind(h) != FlatEdge::Inner) {
                rim.push_back(h);
            } else if (!is_seen[across.value]) {
                is_seen[across.value] = true;
                region.push_back(across);
            }
        }
    }
    std::sort(rim.begin(), rim.end());
}

double FlatRegions::rise_beyond(HalfEdgeId h) const {
    const HalfEdgeId t = tin_.mesh.twin(h);
    const VertexId beyond = tin_.mesh.origin(previous(t));
    return is_dry(face_of(t)) ? tin_.z[beyond.value] - tin_.z[tin_.mesh.origin(h).value] : 0;
}

// What the terrain does behind the walls: what lies behind ways out does the opposite. A guess that says so
// of all edges is kept; otherwise the longer part of the rim, walls twice, is the walls.
FlatRegions::Beyond FlatRegions::look_beyond(const std::vector<HalfEdgeId>& rim) const {
    struct Lengths {
        double up = 0;
        double down = 0;
    };
    Lengths walls;
    Lengths openings;
    for (const HalfEdgeId h : rim) {
        const double rise = rise_beyond(h);
        const bool is_wall = kind(h) == FlatEdge::Wall;
        if (rise != 0 && (is_wall || is_uncertain(h))) {
            Lengths& lengths = is_wall ? walls : openings;
            const double squared =
                squared_distance(tin_.key(tin_.mesh.origin(h)), tin_.key(tin_.mesh.destination(h)));
            (rise > 0 ? lengths.up : lengths.down) += std::sqrt(squared);
        }
    }
    const bool is_consistent = walls.up + walls.down > 0 && ((walls.up == 0 && openings.down == 0) ||
                                                             (walls.down == 0 && openings.up == 0));
    const double by_walls = walls.up - walls.down;
    return {by_walls, is_consistent ? by_walls : 2 * by_walls + openings.up - openings.down};
}

void FlatRegions::judge_rim(const std::vector<HalfEdgeId>& rim, std::vector<Edge>& pieces) const {
    const Beyond beyond = look_beyond(rim);
    for (const HalfEdgeId h : rim) {
        if (tin_.mesh.is_constrained(h) || !is_dry(face_of(tin_.mesh.twin(h)))) {
            continue;
        }
        const double rise = rise_beyond(h);
        const double by = is_uncertain(h) ? beyond.of_all : beyond.of_walls;
        const bool is_told = by != 0 && rise != 0;
        if (is_told ? (rise > 0) == (by > 0) : kind(h) == FlatEdge::Wall) {
            pieces.push_back(ends_of(tin_.mesh, h));
        }
    }
}

void FlatRegions::sort_pieces() {
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
    if (std::binary_search(contour_pieces_.begin(), contour_pieces_.end(), ends_of(mesh, h))) {
        return FlatEdge::Wall;
    }
    if (!is_flat(tin_, across)) {
        return FlatEdge::Opening;
    }
    return is_treated(across) ? FlatEdge::Inner : FlatEdge::Wall;
}

}  // namespace tinwright::internal
