#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "tinwright/breaklines/domain.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

/// A polygon, by what it does and its number.
struct PolygonId {
    LineRole role;
    std::uint32_t number;
    friend auto operator<=>(const PolygonId&, const PolygonId&) = default;
};

constexpr std::uint32_t kTerrainRing = 0xFFFFFFFFU;  // as the number of a hole: everything outside the ring

using Polygons = std::vector<PolygonId>;  // ascending

/// `a` and `b` but for those in both.
Polygons symmetric_difference(const Polygons& a, const Polygons& b) {
    Polygons result;
    std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
    return result;
}

/// The half-edges of a mesh from which its parts (of faces that share edges) can be entered from outside, in
/// an order such that the first one of a part not yet entered leads in from beyond its outer border, not from
/// a void in it.
class PartEntries {
  public:
    explicit PartEntries(const Tin& tin) : tin_(tin) {
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            const HalfEdgeId inward = tin.mesh.twin(half_edge({f}, 0));
            if (tin.mesh.is_ghost({f}) && !tin.mesh.is_ghost(face_of(inward))) {
                entries_.push_back(inward);
            }
        }
        // A part's least vertex is on its outer border.
        std::sort(entries_.begin(), entries_.end(), [&](HalfEdgeId g, HalfEdgeId h) {
            const Key2 a = tin.key(tin.mesh.origin(g));
            const Key2 b = tin.key(tin.mesh.origin(h));
            return std::tie(a.x, a.y, g) < std::tie(b.x, b.y, h);
        });
    }

    /// `is_entered`: by face. Those asked about stay entered.
    std::optional<HalfEdgeId> next(const std::vector<bool>& is_entered) {
        while (at_ < entries_.size() && is_entered[face_of(entries_[at_]).value]) {
            ++at_;
        }
        if (at_ == entries_.size()) {
            return {};
        }
        // Several edges leave the vertex where a void or another part touches it: all to one side, and the
        // first of them, counter-clockwise, has only the outside before it.
        const VertexId from = tin_.mesh.origin(entries_[at_]);
        HalfEdgeId first = entries_[at_];
        for (std::size_t i = at_; i < entries_.size() && tin_.mesh.origin(entries_[i]) == from; ++i) {
            const VertexId to = tin_.mesh.destination(entries_[i]);
            if (!is_entered[face_of(entries_[i]).value] &&
                orient2d(tin_.key(from), tin_.key(tin_.mesh.destination(first)), tin_.key(to)) < 0) {
                first = entries_[i];
            }
        }
        return first;
    }

  private:
    const Tin& tin_;
    std::vector<HalfEdgeId> entries_;
    std::size_t at_ = 0;
};

/// Walks over all faces from outside, area by area, knowing which polygons each area is inside of.
class AreaWalk {
  public:
    /// Counts the polygons of the roles that are wanted.
    AreaWalk(const Tin& tin, std::span<const Breakline> lines, bool (*is_wanted)(LineRole),
             std::optional<std::uint32_t> terrain_ring = {})
        : tin_(tin), has_terrain_ring_(terrain_ring.has_value()), is_reached_(tin.mesh.slot_count()) {
        for (const LineTrace& trace : tin.traces) {
            const bool is_ring = trace.line == terrain_ring;
            if (trace.runs % 2 == 0 || (!is_ring && !is_wanted(lines[trace.line].role))) {
                continue;
            }
            const PolygonId polygon = is_ring ? PolygonId{LineRole::Hole, kTerrainRing}
                                              : PolygonId{lines[trace.line].role, lines[trace.line].polygon};
            if (sides_.empty() || sides_.back().a != trace.a || sides_.back().b != trace.b) {
                sides_.push_back({trace.a, trace.b, {}});
            }
            sides_.back().polygons = symmetric_difference(sides_.back().polygons, {polygon});
        }
    }

    /// Calls `visit` for each face of the areas whose polygons `is_sought` says yes to.
    template <class IsSought, class Visit>
    void run(const IsSought& is_sought, const Visit& visit) {
        PartEntries parts(tin_);
        while (const std::optional<HalfEdgeId> part = parts.next(is_reached_)) {
            entries_.emplace_back(face_of(*part), inside_of(*part));
            while (!entries_.empty()) {
                const auto [entry, polygons] = std::move(entries_.back());
                entries_.pop_back();
                if (is_reached_[entry.value]) {
                    continue;
                }
                find_area(entry, polygons);
                if (is_sought(polygons)) {
                    std::for_each(area_.begin(), area_.end(), visit);
                }
            }
        }
    }

  private:
    /// An edge of polygons' rings, and those polygons.
    struct Side {
        VertexId a;
        VertexId b;
        Polygons polygons;
    };

    [[nodiscard]] const Polygons* find_side(HalfEdgeId h) const {
        const TriangleMesh& mesh = tin_.mesh;
        if (!mesh.is_constrained(h)) {
            return nullptr;
        }
        const std::pair<VertexId, VertexId> edge = std::minmax(mesh.origin(h), mesh.destination(h));
        const auto found = std::lower_bound(
            sides_.begin(), sides_.end(), edge,
            [](const Side& side, const auto& sought) { return std::pair(side.a, side.b) < sought; });
        const bool is_side =
            found != sides_.end() && std::pair(found->a, found->b) == edge && !found->polygons.empty();
        return is_side ? &found->polygons : nullptr;
    }

    /// The polygons around the area behind an edge of the outer border.
    [[nodiscard]] Polygons inside_of(HalfEdgeId h) const {
        Polygons outside;
        if (has_terrain_ring_) {
            outside.push_back({LineRole::Hole, kTerrainRing});
        }
        const Polygons* const side = find_side(h);
        return side != nullptr ? symmetric_difference(outside, *side) : outside;
    }

    /// The faces from one on, up to rings, and the ways on behind these.
    void find_area(FaceId entry, const Polygons& polygons) {
        const TriangleMesh& mesh = tin_.mesh;
        is_reached_[entry.value] = true;
        area_.assign(1, entry);
        for (std::size_t i = 0; i < area_.size(); ++i) {
            for (unsigned corner = 0; corner < 3; ++corner) {
                const HalfEdgeId h = half_edge(area_[i], corner);
                const FaceId across = face_of(mesh.twin(h));
                if (mesh.is_ghost(across) || is_reached_[across.value]) {
                    continue;
                }
                if (const Polygons* const side = find_side(h)) {
                    entries_.emplace_back(across, symmetric_difference(polygons, *side));
                } else {
                    is_reached_[across.value] = true;
                    area_.push_back(across);
                }
            }
        }
    }

    const Tin& tin_;
    std::vector<Side> sides_;  // by a, b
    bool has_terrain_ring_;
    std::vector<bool> is_reached_;  // by face
    std::vector<std::pair<FaceId, Polygons>> entries_;
    std::vector<FaceId> area_;
};

bool is_domain_role(LineRole role) { return role == LineRole::Boundary || role == LineRole::Hole; }

bool has_role(const Polygons& polygons, LineRole role) {
    return std::any_of(polygons.begin(), polygons.end(),
                       [role](const PolygonId& polygon) { return polygon.role == role; });
}

}  // namespace

std::size_t apply_polygons(Tin& tin, std::span<const Breakline> lines,
                           std::optional<std::uint32_t> terrain_ring) {
    const auto has_line = [&](LineRole role) {
        return std::any_of(lines.begin(), lines.end(),
                           [role](const Breakline& line) { return line.role == role; });
    };
    const bool has_boundary = has_line(LineRole::Boundary);
    std::size_t marked = 0;
    if (has_boundary || has_line(LineRole::Hole) || terrain_ring) {
        AreaWalk(tin, lines, is_domain_role, terrain_ring)
            .run(
                [&](const Polygons& polygons) {
                    return has_role(polygons, LineRole::Hole) ||
                           (has_boundary && !has_role(polygons, LineRole::Boundary));
                },
                [&](FaceId face) {
                    if (tin.mesh.is_terrain(face)) {
                        tin.mesh.set_terrain(face, false);
                        ++marked;
                    }
                });
    }
    if (terrain_ring) {
        std::erase_if(tin.traces, [&](const LineTrace& trace) { return trace.line == *terrain_ring; });
    }
    return marked;
}

std::vector<bool> find_water_faces(const Tin& tin, std::span<const Breakline> lines) {
    if (std::none_of(lines.begin(), lines.end(),
                     [](const Breakline& line) { return is_cleared_role(line.role); })) {
        return {};
    }
    std::vector<bool> is_water(tin.mesh.slot_count());
    AreaWalk(tin, lines, is_cleared_role)
        .run([](const Polygons& polygons) { return !polygons.empty(); },
             [&](FaceId face) { is_water[face.value] = tin.mesh.is_terrain(face); });
    return is_water;
}

}  // namespace tinwright
