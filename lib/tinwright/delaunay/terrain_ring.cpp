#include "tinwright/delaunay/terrain_ring.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "tinwright/breaklines/sample_hull.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

struct Place {
    Key2 key;
    double z;
};

/// The convex hull counter-clockwise, places on its edges included, by Andrew's two chains.
std::vector<Place> hull_of(std::vector<Place> places) {
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.key.x, a.key.y, a.z) < std::tie(b.key.x, b.key.y, b.z);
    });
    const auto is_same = [](const Place& a, const Place& b) { return a.key == b.key; };
    places.erase(std::unique(places.begin(), places.end(), is_same), places.end());
    std::vector<Place> hull;
    const auto add_chain = [&hull](auto first, auto last) {
        const std::size_t base = hull.size();
        for (; first != last; ++first) {
            while (hull.size() >= base + 2 &&
                   orient2d(hull[hull.size() - 2].key, hull.back().key, first->key) < 0) {
                hull.pop_back();
            }
            hull.push_back(*first);
        }
        hull.pop_back();  // it begins the other chain
    };
    add_chain(places.begin(), places.end());
    add_chain(places.rbegin(), places.rend());
    return hull;
}

}  // namespace

std::optional<Breakline> find_terrain_ring(std::span<const Breakline> lines, const Drape& drape,
                                           const Lattice& lattice, std::span<const Key2> keys,
                                           std::span<const double> z) {
    std::vector<Place> places;
    for (const VertexId v : drape.hull()) {
        places.push_back({keys[v.value], z[v.value]});
    }
    std::vector<Key2> draped;
    for (const Breakline& line : lines) {
        for (const Point3& p : line.points) {
            const Key2 key = lattice.key({p.x, p.y});
            if (std::isnan(p.z)) {
                draped.push_back(key);
            } else {
                places.push_back({key, p.z});
            }
        }
    }
    const std::vector<Place> hull = hull_of(std::move(places));
    std::vector<Key2> corners;
    for (const Place& place : hull) {
        corners.push_back(place.key);
    }
    const SampleHull area(corners);
    if (std::all_of(draped.begin(), draped.end(), [&](Key2 key) { return area.covers(key); })) {
        return std::nullopt;
    }
    Breakline ring;
    ring.role = LineRole::Hole;
    for (const Place& place : hull) {
        const Point2 at = lattice.position(place.key);
        ring.points.push_back({at.x, at.y, kDraped});
    }
    ring.points.push_back(ring.points.front());
    return ring;
}

}  // namespace tinwright
