#include "tinwright/surface/cell_shares.hpp"

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

namespace {

using Polygon = std::vector<Point2>;

/// Keeps of a convex polygon the part with x * normal <= bound.
void clip(Polygon& polygon, Point2 normal, double bound, Polygon& scratch) {
    scratch.clear();
    const auto excess = [&](Point2 p) { return p.x * normal.x + p.y * normal.y - bound; };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 p = polygon[i];
        const Point2 q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const double at_p = excess(p);
        const double at_q = excess(q);
        if (at_p <= 0) {
            scratch.push_back(p);
        }
        if ((at_p <= 0) != (at_q <= 0)) {
            const double share = at_p / (at_p - at_q);
            scratch.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
        }
    }
    polygon.swap(scratch);
}

double area_of(const Polygon& polygon) {
    double area = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const Point2 a{polygon[i - 1].x - polygon[0].x, polygon[i - 1].y - polygon[0].y};
        const Point2 b{polygon[i].x - polygon[0].x, polygon[i].y - polygon[0].y};
        area += a.x * b.y - a.y * b.x;
    }
    return area / 2;
}

}  // namespace

std::vector<double> find_cell_shares(std::span<const VertexNeighbor> neighbors) {
    double farthest2 = 0;
    for (const VertexNeighbor& neighbor : neighbors) {
        farthest2 = std::max(farthest2, neighbor.distance2);
    }
    const double scale = 1 / std::sqrt(farthest2);
    std::vector<Point2> site;
    std::vector<double> length2;
    for (const VertexNeighbor& neighbor : neighbors) {
        site.push_back({neighbor.offset.x * scale, neighbor.offset.y * scale});
        length2.push_back(site.back().x * site.back().x + site.back().y * site.back().y);
    }
    constexpr double kReach = 64;
    Polygon cell{{-kReach, -kReach}, {kReach, -kReach}, {kReach, kReach}, {-kReach, kReach}};
    Polygon scratch;
    for (std::size_t i = 0; i < site.size(); ++i) {  // points nearer to the vertex than to the site
        clip(cell, site[i], length2[i] / 2, scratch);
    }
    std::vector<double> share(site.size());
    double total = 0;
    for (std::size_t i = 0; i < site.size(); ++i) {
        Polygon part = cell;
        for (std::size_t j = 0; j < site.size() && !part.empty(); ++j) {
            if (j != i) {
                clip(part, {site[j].x - site[i].x, site[j].y - site[i].y}, (length2[j] - length2[i]) / 2,
                     scratch);
            }
        }
        share[i] = area_of(part);
        total += share[i];
    }
    for (double& each : share) {
        each /= total;
    }
    return share;
}

}  // namespace tinwright
