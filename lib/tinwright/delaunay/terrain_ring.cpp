#include "tinwright/delaunay/terrain_ring.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tinwright/breaklines/sample_hull.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

/// The convex hull counter-clockwise, keys on its edges included, by Andrew's two chains.
std::vector<Key2> hull_of(std::vector<Key2> keys) {
    std::sort(keys.begin(), keys.end(), precedes);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    std::vector<Key2> hull;
    const auto add_chain = [&hull](auto first, auto last) {
        const std::size_t base = hull.size();
        for (; first != last; ++first) {
            while (hull.size() >= base + 2 && orient2d(hull[hull.size() - 2], hull.back(), *first) < 0) {
                hull.pop_back();
            }
            hull.push_back(*first);
        }
        hull.pop_back();  // it begins the other chain
    };
    add_chain(keys.begin(), keys.end());
    add_chain(keys.rbegin(), keys.rend());
    return hull;
}

}  // namespace

std::optional<Breakline> find_terrain_ring(std::span<const Breakline> lines, const Drape& drape,
                                           const Lattice& lattice, std::span<const Key2> keys) {
    std::vector<Key2> with_z;
    for (const VertexId v : drape.hull()) {
        with_z.push_back(keys[v.value]);
    }
    std::vector<Key2> draped;
    for (const Breakline& line : lines) {
        for (const Point3& p : line.points) {
            (std::isnan(p.z) ? draped : with_z).push_back(lattice.key({p.x, p.y}));
        }
    }
    const std::vector<Key2> hull = hull_of(std::move(with_z));
    const SampleHull area(hull);
    if (std::all_of(draped.begin(), draped.end(), [&](Key2 key) { return area.covers(key); })) {
        return std::nullopt;
    }
    Breakline ring;
    ring.role = LineRole::Hole;
    for (const Key2 key : hull) {
        const Point2 at = lattice.position(key);
        ring.points.push_back({at.x, at.y, kDraped});
    }
    ring.points.push_back(ring.points.front());
    return ring;
}

}  // namespace tinwright
