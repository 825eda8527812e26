#include "tinwright/optimal/polygon_dp.hpp"

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/predicates.hpp"

// The recurrence is that of [tan1993, Sec. 2.2], but a line is not tested for lying inside the polygon. It
// need not be: each choice of third corners makes a disk of triangles, which the ring's positions map into
// the plane. If all of them have positive area, every point off their edges is covered as often as the ring
// winds around it: once inside, never outside. So the faces tile the polygon, and each ring edge, either side
// of a crack included, has its face on its left.

namespace tinwright {

void PolygonTable::push_back(Key2 vertex) {
    parts_.resize(parts_.size() + ring_.size());
    ring_.push_back(vertex);
    if (ring_.size() > 1) {  // a side of the ring: nothing to be triangulated
        parts_.back() = {is_sum_ ? 0.0 : -kInfinity, 0};
    }
}

void PolygonTable::truncate(std::size_t size) {
    ring_.resize(size);
    parts_.resize(size == 0 ? 0 : size * (size - 1) / 2);
}

/// Infinity where there may be no face.
double PolygonTable::measure(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
    if (orient2d(ring_[i], ring_[k], ring_[j]) <= 0) {
        return kInfinity;
    }
    const double value = measure_(i, k, j);
    if (std::isnan(value)) {
        return kInfinity;
    }
    return value;
}

/// Whether something with a part of this cost cannot be less than what was found. What is joined makes a
/// maximum no less; of a sum nothing is known before.
bool PolygonTable::is_hopeless(double cost, const Part& best) const {
    return cost == kInfinity || (!is_sum_ && cost >= best.cost);
}

void PolygonTable::begin(std::uint32_t i, std::uint32_t j) {
    searches_.push_back({.i = i, .j = j, .k = i + 1, .best = {kInfinity, 0}});
}

/// Goes on with a search until it is finished. If it needs another part first, begins with that one, and
/// returns false.
bool PolygonTable::go_on(Search& search) {
    const auto [i, j] = std::pair(search.i, search.j);
    for (; search.k < j; ++search.k, search.is_measured = false) {
        const std::uint32_t k = search.k;
        if (search.best.cost == -kInfinity && !is_sum_) {
            break;
        }
        if (!search.is_measured) {
            search.measure = measure(i, k, j);
            search.is_measured = true;
        }
        if (is_hopeless(search.measure, search.best)) {
            continue;
        }
        const Part& first = parts_[index(i, k)];
        if (first.middle == kUnknown) {
            begin(i, k);
            return false;
        }
        if (is_hopeless(first.cost, search.best)) {
            continue;
        }
        const Part& second = parts_[index(k, j)];
        if (second.middle == kUnknown) {
            begin(k, j);
            return false;
        }
        const double whole = is_sum_ ? search.measure + (first.cost + second.cost)
                                     : std::max({search.measure, first.cost, second.cost});
        if (whole < search.best.cost) {
            search.best = {whole, k};
        }
    }
    return true;
}

double PolygonTable::cost(std::uint32_t i, std::uint32_t j, const Progress& progress) {
    Part& wanted = parts_[index(i, j)];
    if (wanted.middle != kUnknown) {
        return wanted.cost;
    }
    searches_.clear();  // of a search that was stopped
    begin(i, j);
    std::size_t done = 0;
    while (!searches_.empty()) {
        if (go_on(searches_.back())) {
            const Search& finished = searches_.back();
            parts_[index(finished.i, finished.j)] = finished.best;
            searches_.pop_back();
            ++done;
            report_progress(progress, static_cast<double>(done) / static_cast<double>(parts_.size()));
        }
    }
    return wanted.cost;
}

std::vector<std::array<std::uint32_t, 3>> PolygonTable::faces(std::uint32_t i, std::uint32_t j) const {
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> lines{{i, j}};
    while (!lines.empty()) {
        const auto [a, b] = lines.back();
        lines.pop_back();
        if (b - a > 1) {
            const std::uint32_t middle = parts_[index(a, b)].middle;
            faces.push_back({a, middle, b});
            lines.emplace_back(middle, b);
            lines.emplace_back(a, middle);
        }
    }
    return faces;
}

std::optional<PolygonTriangulation> triangulate_polygon(std::span<const Key2> ring,
                                                        const RingMeasure& measure, PolygonCost cost,
                                                        const Progress& progress) {
    if (ring.size() < 3) {
        return std::nullopt;
    }
    PolygonTable table(measure, cost);
    for (const Key2 vertex : ring) {
        table.push_back(vertex);
    }
    const auto last = static_cast<std::uint32_t>(ring.size() - 1);
    const double least = table.cost(0, last, progress);
    if (least == std::numeric_limits<double>::infinity()) {
        return std::nullopt;
    }
    return PolygonTriangulation{least, table.faces(0, last)};
}

}  // namespace tinwright
