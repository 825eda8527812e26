#include "tinwright/surface/band_rings.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "tinwright/geometry/box.hpp"

namespace tinwright {

namespace {

bool is_less(Point2 a, Point2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }

/// For each point a number that only equal points share.
std::vector<std::uint32_t> number_points(const std::vector<Point2>& way) {
    std::vector<std::uint32_t> order(way.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return is_less(way[a], way[b]); });
    std::vector<std::uint32_t> numbers(way.size());
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        number += i > 0 && way[order[i]] != way[order[i - 1]] ? 1U : 0U;
        numbers[order[i]] = number;
    }
    return numbers;
}

void add_ring(std::vector<Point2> ring, std::vector<BandRing>& rings) {
    if (ring.size() < 3) {
        return;
    }
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), is_less), ring.end());
    ring.push_back(ring.front());
    rings.push_back(std::move(ring));
}

Box bounds_of(const BandRing& ring) {
    Box box;
    for (const Point2 p : ring) {
        box.add(p.x, p.y);
    }
    return box;
}

}  // namespace

void cut_rings(std::vector<Point2> way, std::vector<BandRing>& rings) {
    constexpr std::uint32_t kAbsent = 0xFFFFFFFFU;
    const std::vector<std::uint32_t> numbers = number_points(way);
    std::vector<std::uint32_t> place(way.size(), kAbsent);  // of a number: where it is on the path
    std::vector<std::uint32_t> path;                        // numbers
    std::vector<Point2> points;
    for (std::size_t i = 0; i < way.size(); ++i) {
        const std::uint32_t number = numbers[i];
        if (place[number] == kAbsent) {
            place[number] = static_cast<std::uint32_t>(path.size());
            path.push_back(number);
            points.push_back(way[i]);
            continue;
        }
        // The way comes back to a point: what it did since is a ring of its own.
        const std::size_t begin = place[number];
        add_ring({points.begin() + static_cast<std::ptrdiff_t>(begin), points.end()}, rings);
        for (std::size_t k = begin + 1; k < path.size(); ++k) {
            place[path[k]] = kAbsent;
        }
        path.resize(begin + 1);
        points.resize(begin + 1);
    }
    add_ring(std::move(points), rings);
}

BandPolygon as_polygon(std::vector<BandRing> rings) {
    // Holes touch the outer ring in one point each at most, so they reach less far on one side at least.
    const auto is_wider = [](const Box& a, const Box& b) {
        return std::tie(a.x_min, b.x_max, a.y_min, b.y_max) < std::tie(b.x_min, a.x_max, b.y_min, a.y_max);
    };
    std::size_t outer = 0;
    Box widest = bounds_of(rings.front());
    for (std::size_t i = 1; i < rings.size(); ++i) {
        const Box box = bounds_of(rings[i]);
        if (is_wider(box, widest)) {
            widest = box;
            outer = i;
        }
    }
    std::swap(rings.front(), rings[outer]);
    std::sort(rings.begin() + 1, rings.end(),
              [](const BandRing& a, const BandRing& b) { return precedes(a, b); });
    return rings;
}

bool precedes(const BandRing& a, const BandRing& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_less);
}

bool precedes(const BandPolygon& a, const BandPolygon& b) {
    return std::lexicographical_compare(
        a.begin(), a.end(), b.begin(), b.end(),
        [](const BandRing& ring, const BandRing& other) { return precedes(ring, other); });
}

}  // namespace tinwright
