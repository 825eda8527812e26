#include "tinwright/optimal/incomplete_polygon.hpp"

#include <algorithm>

namespace tinwright::internal {

bool IncompletePolygon::triangulate(std::uint32_t i, std::uint32_t j, CavityFace::Across across,
                                    std::vector<CavityFace>& faces, const Poll& poll) {
    bases_.assign(1, {i, j, across});
    while (!bases_.empty()) {
        const Base base = bases_.back();
        bases_.pop_back();
        std::uint32_t k = 0;
        if (!poll() || !find_apex(base, k)) {
            return false;
        }
        const auto face = static_cast<std::uint32_t>(faces.size());
        faces.push_back({{polygon_.vertex(base.i), polygon_.vertex(k), polygon_.vertex(base.j)}, {}});
        faces.back().across[2] = base.across;
        if (base.across.is_known() && !base.across.is_rim()) {
            faces[base.across.face()].across[base.across.edge()] = CavityFace::Across::inner(face, 2);
        }
        add_base(base.i, k, face, 0, faces);
        add_base(k, base.j, face, 1, faces);
    }
    return true;
}

/// What lies beyond the edge from i to j of a new face: a side, or another part.
void IncompletePolygon::add_base(std::uint32_t i, std::uint32_t j, std::uint32_t face, unsigned edge,
                                 std::vector<CavityFace>& faces) {
    if (polygon_.after(i) == j) {
        faces[face].across[edge] = CavityFace::Across::rim(polygon_.side(i));
    } else {
        bases_.push_back({i, j, CavityFace::Across::inner(face, edge)});
    }
}

bool IncompletePolygon::find_apex(const Base& base, std::uint32_t& apex) {
    const std::uint32_t n = polygon_.size();
    const auto way = [&](std::uint32_t position) { return (position + n - base.i) % n; };
    const VertexId p = polygon_.vertex(base.i);
    const VertexId q = polygon_.vertex(base.j);
    const auto from_i = polygon_.look(base.i, {p, q}, space_i_);
    const auto from_j = polygon_.look(base.j, {p, q}, space_j_);
    // Both lists run along the ring: the one through the part first, the other through it last.
    auto of_j = std::find_if(from_j.begin(), from_j.end(), [&](const auto& sight) {
        return way(sight.position) < way(base.j) && sight.position != base.i;
    });
    const LengthOrder& order = polygon_.order();
    bool is_found = false;
    VertexId best{};
    for (const WallPolygon::Sight& of_i : from_i) {
        if (way(of_i.position) >= way(base.j)) {
            break;
        }
        while (of_j != from_j.end() && way(of_j->position) < way(of_i.position)) {
            ++of_j;
        }
        const VertexId x = of_i.vertex;
        if (of_j == from_j.end() || of_j->position != of_i.position || !of_i.is_left_empty ||
            !of_j->is_right_empty || !order.is_in_lune(x, p, q)) {
            continue;
        }
        const auto longer = [&](VertexId v) { return order.is_shorter(p, v, q, v) ? q : p; };
        if (!is_found || order.is_shorter(longer(x), x, longer(best), best)) {
            is_found = true;
            best = x;
            apex = of_i.position;
        }
    }
    return is_found;
}

}  // namespace tinwright::internal
