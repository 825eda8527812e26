#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "tinwright/breaklines/domain.hpp"

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

/// Walks over all faces from outside, area by area, knowing which polygons each area is inside of.
class AreaWalk {
  public:
    AreaWalk(Tin& tin, std::span<const Breakline> lines, std::optional<std::uint32_t> terrain_ring)
        : mesh_(tin.mesh) {
        for (const LineTrace& trace : tin.traces) {
            const bool is_ring = trace.line == terrain_ring;
            if (trace.runs % 2 == 0 || (!is_ring && !is_polygon_role(lines[trace.line].role))) {
                continue;
            }
            const PolygonId polygon = is_ring ? PolygonId{LineRole::Hole, kTerrainRing}
                                              : PolygonId{lines[trace.line].role, lines[trace.line].polygon};
            if (sides_.empty() || sides_.back().a != trace.a || sides_.back().b != trace.b) {
                sides_.push_back({trace.a, trace.b, {}});
            }
            sides_.back().polygons = symmetric_difference(sides_.back().polygons, {polygon});
        }
        has_boundary_ = std::any_of(lines.begin(), lines.end(),
                                    [](const Breakline& line) { return line.role == LineRole::Boundary; });
        has_terrain_ring_ = terrain_ring.has_value();
    }

    std::size_t run() {
        std::vector<bool> is_reached(mesh_.slot_count());
        std::uint32_t ghost = 0;
        while (!mesh_.is_ghost({ghost})) {
            ++ghost;
        }
        Polygons around;
        if (has_terrain_ring_) {
            around.push_back({LineRole::Hole, kTerrainRing});
        }
        std::vector<std::pair<FaceId, Polygons>> entries = {{FaceId{ghost}, around}};
        std::size_t marked = 0;
        std::vector<FaceId> area;
        while (!entries.empty()) {
            const auto [entry, polygons] = std::move(entries.back());
            entries.pop_back();
            if (is_reached[entry.value]) {
                continue;
            }
            const bool is_cut = is_cut_off(polygons);
            is_reached[entry.value] = true;
            area.assign(1, entry);
            while (!area.empty()) {
                const FaceId face = area.back();
                area.pop_back();
                if (is_cut && mesh_.is_terrain(face)) {
                    mesh_.set_terrain(face, false);
                    ++marked;
                }
                for (unsigned corner = 0; corner < 3; ++corner) {
                    const HalfEdgeId h = half_edge(face, corner);
                    const FaceId across = face_of(mesh_.twin(h));
                    if (is_reached[across.value]) {
                        continue;
                    }
                    if (const Polygons* const side = find_side(h)) {
                        entries.emplace_back(across, symmetric_difference(polygons, *side));
                    } else {
                        is_reached[across.value] = true;
                        area.push_back(across);
                    }
                }
            }
        }
        return marked;
    }

  private:
    /// An edge of polygons' rings, and those polygons.
    struct Side {
        VertexId a;
        VertexId b;
        Polygons polygons;
    };

    [[nodiscard]] const Polygons* find_side(HalfEdgeId h) const {
        if (!mesh_.is_constrained(h)) {
            return nullptr;
        }
        const std::pair<VertexId, VertexId> edge = std::minmax(mesh_.origin(h), mesh_.destination(h));
        const auto found = std::lower_bound(
            sides_.begin(), sides_.end(), edge,
            [](const Side& side, const auto& sought) { return std::pair(side.a, side.b) < sought; });
        const bool is_side =
            found != sides_.end() && std::pair(found->a, found->b) == edge && !found->polygons.empty();
        return is_side ? &found->polygons : nullptr;
    }

    [[nodiscard]] bool is_cut_off(const Polygons& polygons) const {
        const auto has = [&](LineRole role) {
            return std::any_of(polygons.begin(), polygons.end(),
                               [role](const PolygonId& polygon) { return polygon.role == role; });
        };
        return has(LineRole::Hole) || (has_boundary_ && !has(LineRole::Boundary));
    }

    TriangleMesh& mesh_;
    std::vector<Side> sides_;  // by a, b
    bool has_boundary_ = false;
    bool has_terrain_ring_ = false;
};

}  // namespace

std::size_t apply_polygons(Tin& tin, std::span<const Breakline> lines,
                           std::optional<std::uint32_t> terrain_ring) {
    const bool has_polygons = std::any_of(lines.begin(), lines.end(), [](const Breakline& line) {
        return line.role == LineRole::Boundary || line.role == LineRole::Hole;
    });
    std::size_t marked = 0;
    if (has_polygons || terrain_ring) {
        marked = AreaWalk(tin, lines, terrain_ring).run();
    }
    if (terrain_ring) {
        std::erase_if(tin.traces, [&](const LineTrace& trace) { return trace.line == *terrain_ring; });
    }
    return marked;
}

}  // namespace tinwright
