#include "tinwright/water/polygon_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace tinwright {

namespace {

/// Where a segment crosses a height; its lower end belongs to it.
std::optional<double> crossing(Point2 a, Point2 b, double y) {
    if ((a.y <= y) == (b.y <= y)) {
        return {};
    }
    return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

/// What is in runs of both lists; runs of a list ascend and are apart.
template <class Run>
std::vector<Run> in_both(const std::vector<Run>& a, const std::vector<Run>& b) {
    std::vector<Run> both;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const Run run{std::max(a[i].first, b[j].first), std::min(a[i].second, b[j].second)};
        if (run.first < run.second) {
            both.push_back(run);
        }
        ++(a[i].second < b[j].second ? i : j);
    }
    return both;
}

}  // namespace

std::int64_t PolygonRows::row_of(double y) const {
    const double row = std::floor((grid_.y_max - y) / grid_.cell_height);
    return static_cast<std::int64_t>(std::clamp(row, -1.0, static_cast<double>(grid_.rows)));
}

void PolygonRows::add(const Polygon& polygon, std::uint32_t line, std::span<const Point3> ring) {
    const auto [place, is_new] =
        number_of_.try_emplace(polygon, static_cast<std::uint32_t>(polygons_.size()));
    if (is_new) {
        polygons_.emplace_back(polygon, line);
    }
    for (std::size_t i = 1; i < ring.size(); ++i) {
        edges_.push_back({place->second, {ring[i - 1].x, ring[i - 1].y}, {ring[i].x, ring[i].y}});
    }
}

void PolygonRows::finish() {
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const Edge& a, const Edge& b) { return a.polygon < b.polygon; });
    // A row more on either side: places near the row's edge are asked about.
    const auto rows_of = [this](const Edge& edge) {
        return std::pair(std::max<std::int64_t>(row_of(std::max(edge.a.y, edge.b.y)) - 1, 0),
                         std::min(row_of(std::min(edge.a.y, edge.b.y)) + 2, grid_.rows));
    };
    row_begin_.assign(static_cast<std::size_t>(grid_.rows) + 1, 0);
    for (const Edge& edge : edges_) {
        const auto [first, end] = rows_of(edge);
        for (std::int64_t row = first; row < end; ++row) {
            ++row_begin_[static_cast<std::size_t>(row) + 1];
        }
    }
    std::partial_sum(row_begin_.begin(), row_begin_.end(), row_begin_.begin());
    in_row_.resize(row_begin_.back());
    std::vector<std::size_t> at(row_begin_.begin(), row_begin_.end() - 1);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        const auto [first, end] = rows_of(edges_[e]);
        for (std::int64_t row = first; row < end; ++row) {
            in_row_[at[static_cast<std::size_t>(row)]++] = e;
        }
    }
}

bool PolygonRows::hold(Point2 at) const {
    const std::int64_t row = row_of(at.y);
    if (row < 0 || row >= grid_.rows) {
        return false;
    }
    const auto i = static_cast<std::size_t>(row);
    bool is_inside = false;
    for (std::size_t k = row_begin_[i]; k < row_begin_[i + 1]; ++k) {
        const Edge& edge = edges_[in_row_[k]];
        const std::optional<double> x = crossing(edge.a, edge.b, at.y);
        is_inside = is_inside != (x && *x < at.x);
        const bool is_last = k + 1 == row_begin_[i + 1] || edges_[in_row_[k + 1]].polygon != edge.polygon;
        if (is_last && is_inside) {
            return true;
        }
    }
    return false;
}

std::vector<PolygonRows::Run> PolygonRows::columns_inside(std::span<const std::uint32_t> edges, double y,
                                                          double distance) const {
    std::vector<double> crossings;
    for (const std::uint32_t e : edges) {
        if (const std::optional<double> x = crossing(edges_[e].a, edges_[e].b, y)) {
            crossings.push_back(*x);
        }
    }
    std::sort(crossings.begin(), crossings.end());
    std::vector<Run> runs;
    const auto column_at = [this](double x) {
        const double column = (x - grid_.x_min) / grid_.cell_width - 0.5;
        return std::clamp(column, -1.0, static_cast<double>(grid_.columns));
    };
    for (std::size_t i = 1; i < crossings.size(); i += 2) {
        const auto first = static_cast<std::int64_t>(std::floor(column_at(crossings[i - 1] + distance))) + 1;
        const auto end = static_cast<std::int64_t>(std::ceil(column_at(crossings[i] - distance)));
        if (first < std::min(end, grid_.columns)) {
            runs.emplace_back(first, std::min(end, grid_.columns));
        }
    }
    return runs;
}

void PolygonRows::visit_inside(
    std::size_t polygon, double margin,
    const std::function<void(std::int64_t, std::int64_t, std::int64_t)>& visit) const {
    const auto precedes = [this](std::uint32_t e, std::size_t sought) { return edges_[e].polygon < sought; };
    const auto first_of = std::partition_point(edges_.begin(), edges_.end(),
                                               [=](const Edge& edge) { return edge.polygon < polygon; });
    const auto end_of = std::partition_point(first_of, edges_.end(),
                                             [=](const Edge& edge) { return edge.polygon == polygon; });
    std::int64_t first_row = grid_.rows;
    std::int64_t last_row = -1;
    for (auto edge = first_of; edge != end_of; ++edge) {
        first_row = std::min(first_row, row_of(std::max(edge->a.y, edge->b.y)));
        last_row = std::max(last_row, row_of(std::min(edge->a.y, edge->b.y)));
    }
    for (std::int64_t row = std::max<std::int64_t>(first_row, 0); row <= std::min(last_row, grid_.rows - 1);
         ++row) {
        const auto begin =
            in_row_.begin() + static_cast<std::ptrdiff_t>(row_begin_[static_cast<std::size_t>(row)]);
        const auto end =
            in_row_.begin() + static_cast<std::ptrdiff_t>(row_begin_[static_cast<std::size_t>(row) + 1]);
        const auto from = std::lower_bound(begin, end, polygon, precedes);
        const auto to = std::lower_bound(from, end, polygon + 1, precedes);
        const std::span<const std::uint32_t> edges(from, to);
        const double y = grid_.centre(0, row).y;
        const double above = margin * grid_.cell_height;
        std::vector<Run> runs = columns_inside(edges, y, margin * grid_.cell_width);
        runs = in_both(runs, columns_inside(edges, y + above, 0));
        runs = in_both(runs, columns_inside(edges, y - above, 0));
        for (const auto& [first, last] : runs) {
            visit(row, first, last);
        }
    }
}

}  // namespace tinwright
