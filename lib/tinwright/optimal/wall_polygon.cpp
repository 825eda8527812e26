#include "tinwright/optimal/wall_polygon.hpp"

#include <algorithm>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright::internal {

void WallPolygon::trace(HalfEdgeId wall) {
    sides_.clear();
    faces_.clear();
    kept_before_.reset();
    HalfEdgeId side = wall;
    do {
        sides_.push_back(side);
        const std::uint32_t position = size();
        // Around the corner at the side's end, to the next wall.
        HalfEdgeId spoke = next(side);
        for (;;) {
            walls_->position[spoke.value] = position;
            if ((spoke.value & 3U) == 0) {
                faces_.push_back(face_of(spoke));
            }
            if (walls_->is_wall[spoke.value] != 0) {
                break;
            }
            spoke = next(mesh_->twin(spoke));
        }
        side = spoke;
    } while (side != wall);
    // The corner where the ring begins got its number last, as one beyond the others.
    for (HalfEdgeId spoke = next(sides_.back());; spoke = next(mesh_->twin(spoke))) {
        walls_->position[spoke.value] = 0;
        if (walls_->is_wall[spoke.value] != 0) {
            break;
        }
    }
}

void WallPolygon::keep_sights(VertexPair before) {
    kept_before_ = before;
    is_kept_.assign(size(), false);
    if (kept_.size() < size()) {
        kept_.resize(size());
    }
}

std::span<const WallPolygon::Sight> WallPolygon::look(std::uint32_t position, VertexPair before,
                                                      std::vector<Sight>& space) {
    if (!kept_before_) {
        find_sights(position, before, space);
        return space;
    }
    if (!is_kept_[position]) {
        is_kept_[position] = true;
        find_sights(position, *kept_before_, kept_[position]);
    }
    return kept_[position];
}

void WallPolygon::find_sights(std::uint32_t position, VertexPair before, std::vector<Sight>& sights) {
    const auto [a, b] = before;
    const HalfEdgeId first = sides_[position];
    const VertexId eye = mesh_->origin(first);
    const Key2 at = order_->keys()[eye.value];
    // No norm is less than the greater of the two distances; rounding is far below the excess.
    const double reach =
        length(order_->norm(), order_->keys()[a.value], order_->keys()[b.value]) * (1 + 1e-9);
    const auto is_worth = [&](HalfEdgeId h) {
        const Key2 p = order_->keys()[mesh_->origin(h).value];
        const Key2 q = order_->keys()[mesh_->destination(h).value];
        return std::min(p.x, q.x) - at.x <= reach && at.x - std::max(p.x, q.x) <= reach &&
               std::min(p.y, q.y) - at.y <= reach && at.y - std::max(p.y, q.y) <= reach;
    };
    view_.look(
        first, [this](HalfEdgeId h) { return walls_->is_wall[h.value] != 0; }, is_worth);
    sights.clear();
    for (const CornerView::Seen& seen : view_.seen()) {
        if (order_->is_shorter(eye, seen.vertex, a, b)) {
            sights.push_back({walls_->position[seen.at.value], seen.vertex});
        }
    }
    find_empty_sides(eye, sights);
}

void WallPolygon::find_empty_sides(VertexId eye, std::vector<Sight>& sights) {
    scan(eye, sights.begin(), sights.end(), 1, &Sight::is_left_empty);
    scan(eye, sights.rbegin(), sights.rend(), -1, &Sight::is_right_empty);
}

/// Of the lines that are still empty, those in whose lunes a vertex lies are the last ones.
template <class Iterator>
void WallPolygon::scan(VertexId eye, Iterator begin, Iterator end, int turn, bool Sight::*is_empty) {
    const std::span<const Key2> keys = order_->keys();
    const auto is_in_half_lune = [&](VertexId x, VertexId q) {
        return order_->is_shorter(eye, x, eye, q) && order_->is_shorter(x, q, eye, q) &&
               orient2d(keys[eye.value], keys[q.value], keys[x.value]) == turn;
    };
    pending_.clear();
    for (Iterator sight = begin; sight != end; ++sight) {
        while (!pending_.empty() && is_in_half_lune(sight->vertex, pending_.back()->vertex)) {
            (*pending_.back()).*is_empty = false;
            pending_.pop_back();
        }
        pending_.push_back(&*sight);
    }
}

}  // namespace tinwright::internal
