#include "tinwright/water/level_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace tinwright {

namespace {

double distance(Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::uint32_t find_root(std::vector<std::uint32_t>& parents, std::uint32_t i) {
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

}  // namespace

LevelPlaces::LevelPlaces(const WaterMesh& water, const WaterRows& rows)
    : water_(&water), rows_(&rows), place_of_vertex_(water.keys.size(), kNone) {
    group();
    find_middles();
    find_ways();
}

void LevelPlaces::group() {
    const TriangleMesh& mesh = water_->mesh;
    std::vector<std::uint32_t> parents(water_->keys.size());
    std::iota(parents.begin(), parents.end(), 0U);
    std::vector<bool> is_corner(parents.size(), false);
    for (const FaceId f : rows_->junctions) {
        for (const VertexId v : mesh.face(f).vertex) {
            is_corner[v.value] = true;
            const std::uint32_t a = find_root(parents, mesh.vertex(f, 0).value);
            const std::uint32_t b = find_root(parents, v.value);
            parents[std::max(a, b)] = std::min(a, b);
        }
    }
    for (VertexId v{0}; v.value < parents.size(); ++v.value) {
        if (!is_corner[v.value]) {
            continue;
        }
        const std::uint32_t root = find_root(parents, v.value);
        if (root == v.value) {
            place_of_vertex_[v.value] = static_cast<std::uint32_t>(places_.size());
            places_.emplace_back();
        } else {
            place_of_vertex_[v.value] = place_of_vertex_[root];
        }
        places_[place_of_vertex_[v.value]].vertices.push_back(v);
    }
}

Point2 LevelPlaces::center(std::uint32_t junction) const {
    const auto& corner = water_->mesh.face(rows_->junctions[junction]).vertex;
    const Key2 a = water_->key(corner[0]);
    const Key2 b = water_->key(corner[1]);
    const Key2 c = water_->key(corner[2]);
    return {(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
}

void LevelPlaces::find_middles() {
    struct Sum {
        double x = 0;
        double y = 0;
        double count = 0;
    };
    const auto count = static_cast<std::uint32_t>(rows_->junctions.size());
    std::vector<Sum> sums(places_.size());
    for (std::uint32_t j = 0; j < count; ++j) {
        const std::uint32_t p = place_of_junction(j);
        const Point2 at = center(j);
        sums[p].x += at.x;
        sums[p].y += at.y;
        sums[p].count += 1;
        for (unsigned corner = 0; corner < 3; ++corner) {
            places_[p].width =
                std::max(places_[p].width, water_->length(half_edge(rows_->junctions[j], corner)));
        }
    }
    middle_junction_.assign(places_.size(), kNone);
    std::vector<double> nearest(places_.size(), std::numeric_limits<double>::infinity());
    for (std::uint32_t j = 0; j < count; ++j) {
        const std::uint32_t p = place_of_junction(j);
        const double away = distance(center(j), {sums[p].x / sums[p].count, sums[p].y / sums[p].count});
        if (away < nearest[p]) {
            nearest[p] = away;
            middle_junction_[p] = j;
            places_[p].middle = center(j);
        }
    }
}

// From all middles at once; a row that joins two junctions of a place is part of it.
void LevelPlaces::find_ways() {
    struct Step {
        std::uint32_t to;
        std::uint32_t row;
        double length;
    };
    std::vector<std::vector<Step>> steps(rows_->junctions.size());
    for (std::uint32_t r = 0; r < rows_->rows.size(); ++r) {
        const WaterRow& row = rows_->rows[r];
        if (row.from == WaterRow::kEnd || row.to == WaterRow::kEnd ||
            place_of_junction(row.from) != place_of_junction(row.to)) {
            continue;
        }
        double length = 0;
        Point2 at = center(row.from);
        for (const HalfEdgeId h : rows_->edges_of(row)) {
            length += distance(at, water_->middle(h));
            at = water_->middle(h);
        }
        length += distance(at, center(row.to));
        steps[row.from].push_back({row.to, r, length});
        steps[row.to].push_back({row.from, r, length});
    }
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    std::vector<double> ways(rows_->junctions.size(), std::numeric_limits<double>::infinity());
    row_before_.assign(rows_->junctions.size(), kNone);
    for (const std::uint32_t j : middle_junction_) {
        ways[j] = 0;
        queue.push({0, j});
    }
    while (!queue.empty()) {
        const auto [way, j] = queue.top();
        queue.pop();
        if (way > ways[j]) {
            continue;
        }
        for (const Step& step : steps[j]) {
            if (way + step.length < ways[step.to]) {
                ways[step.to] = way + step.length;
                row_before_[step.to] = step.row;
                queue.push({ways[step.to], step.to});
            }
        }
    }
}

void LevelPlaces::append_way(std::uint32_t junction, std::vector<Point2>& way) const {
    const auto begin = static_cast<std::ptrdiff_t>(way.size());
    const std::uint32_t p = place_of_junction(junction);
    while (junction != middle_junction_[p]) {
        const WaterRow& row = rows_->rows[row_before_[junction]];
        const auto edges = rows_->edges_of(row);
        if (row.to == junction) {
            std::for_each(edges.rbegin(), edges.rend(),
                          [&](HalfEdgeId h) { way.push_back(water_->middle(h)); });
            junction = row.from;
        } else {
            std::for_each(edges.begin(), edges.end(),
                          [&](HalfEdgeId h) { way.push_back(water_->middle(h)); });
            junction = row.to;
        }
    }
    way.push_back(places_[p].middle);
    std::reverse(way.begin() + begin, way.end());
}

}  // namespace tinwright
