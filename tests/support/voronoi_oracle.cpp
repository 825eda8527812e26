#include "support/voronoi_oracle.hpp"

#include <algorithm>
#include <cmath>

namespace tinwright_tests::oracle {

namespace {

using tinwright::Key2;

constexpr std::size_t kNoSite = static_cast<std::size_t>(-1);

struct Vector {
    long double x = 0;
    long double y = 0;
};

long double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
Vector minus(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }

struct Corner {
    Vector at;
    std::size_t site = kNoSite;  // whose cell is beyond the side from this corner to the next
};

using Polygon = std::vector<Corner>;

/// What is left where normal x <= limit; the new side has `site` beyond.
Polygon cut(const Polygon& polygon, Vector normal, long double limit, std::size_t site) {
    Polygon left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner& a = polygon[i];
        const Corner& b = polygon[(i + 1) % polygon.size()];
        const long double at_a = dot(normal, a.at) - limit;
        const long double at_b = dot(normal, b.at) - limit;
        if (at_a <= 0) {
            left.push_back(a);
        }
        if ((at_a <= 0) != (at_b <= 0)) {
            const long double way = at_a / (at_a - at_b);
            const Vector side = minus(b.at, a.at);
            left.push_back({{a.at.x + way * side.x, a.at.y + way * side.y}, at_a <= 0 ? site : a.site});
        }
    }
    return left;
}

/// What is left of a polygon where `own` is nearer than `other`.
Polygon cut_bisector(const Polygon& polygon, Vector own, Vector other, std::size_t site) {
    const Vector normal = minus(other, own);
    return cut(polygon, normal, (dot(other, other) - dot(own, own)) / 2, site);
}

long double area(const Polygon& polygon) {
    long double doubled = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector a = minus(polygon[i].at, polygon[0].at);
        const Vector b = minus(polygon[(i + 1) % polygon.size()].at, polygon[0].at);
        doubled += a.x * b.y - a.y * b.x;
    }
    return doubled / 2;
}

}  // namespace

std::optional<std::vector<CellShare>> voronoi_shares(std::span<const Key2> sites, Key2 place) {
    std::vector<Vector> at;
    long double reach = 0;
    for (const Key2& site : sites) {
        at.push_back(
            {static_cast<long double>(site.x) - place.x, static_cast<long double>(site.y) - place.y});
        reach = std::max({reach, std::abs(at.back().x), std::abs(at.back().y)});
    }
    reach *= 1000;
    Polygon cell{{{-reach, -reach}}, {{reach, -reach}}, {{reach, reach}}, {{-reach, reach}}};
    for (std::size_t i = 0; i < at.size(); ++i) {
        cell = cut_bisector(cell, {0, 0}, at[i], i);
    }
    std::vector<CellShare> shares;
    for (std::size_t k = 0; k < cell.size(); ++k) {
        const std::size_t i = cell[k].site;
        if (i == kNoSite) {
            return std::nullopt;
        }
        const Vector side = minus(cell[(k + 1) % cell.size()].at, cell[k].at);
        Polygon taken = cell;
        for (std::size_t j = 0; j < at.size() && !taken.empty(); ++j) {
            taken = j == i ? taken : cut_bisector(taken, at[i], at[j], j);
        }
        shares.push_back(
            {i, taken.empty() ? 0 : area(taken), std::sqrt(dot(side, side)) / std::sqrt(dot(at[i], at[i]))});
    }
    return shares;
}

}  // namespace tinwright_tests::oracle
