#include "tinwright/optimal/polygon_dp.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Fills in the table of [tan1993, Sec. 2.2] for one polygon: of the part on the side of vertices i to j of
/// the line from i to j, the least cost and the third corner of its face at that line.
///
/// A line is not tested for lying inside the polygon. It need not be: each choice of third corners makes a
/// disk of triangles, which the ring's positions map into the plane. If all of them have positive area, every
/// point off their edges is covered as often as the ring winds around it: once inside, never outside. So the
/// faces tile the polygon, and each ring edge, either side of a crack included, has its face on its left.
class PolygonTable {
  public:
    PolygonTable(std::span<const Key2> ring, const RingMeasure& measure, PolygonCost cost,
                 const Progress& progress)
        : ring_(ring),
          measure_(measure),
          progress_(progress),
          size_(static_cast<std::uint32_t>(ring.size())),
          is_sum_(cost == PolygonCost::Sum) {}

    std::optional<PolygonTriangulation> solve();

  private:
    struct Part {
        double cost = kInfinity;
        std::uint32_t middle = 0;
        bool is_needed = false;
    };
    struct Line {
        std::uint32_t i;
        std::uint32_t j;
    };

    /// Parts by j - i, then i.
    [[nodiscard]] Part& part(std::uint32_t i, std::uint32_t j) {
        const std::size_t before = j - i - 2;
        return parts_[before * (size_ - 2) - before * (before - 1) / 2 + i];
    }
    [[nodiscard]] double cost(std::uint32_t i, std::uint32_t j) {
        return j - i > 1 ? part(i, j).cost : is_sum_ ? 0.0 : -kInfinity;
    }
    [[nodiscard]] double join(double a, double b) const { return is_sum_ ? a + b : std::max(a, b); }

    /// Infinity where there may be no face.
    [[nodiscard]] double measure(std::uint32_t i, std::uint32_t k, std::uint32_t j) const {
        if (orient2d(ring_[i], ring_[k], ring_[j]) <= 0) {
            return kInfinity;
        }
        const double value = measure_(i, k, j);
        return std::isnan(value) ? kInfinity : value;
    }
    [[nodiscard]] bool has_face(std::uint32_t i, std::uint32_t j) const;
    void need(std::uint32_t i, std::uint32_t j);
    void find_needed();
    void solve_part(std::uint32_t i, std::uint32_t j);
    [[nodiscard]] PolygonTriangulation trace();

    std::span<const Key2> ring_;
    const RingMeasure& measure_;
    const Progress& progress_;
    std::uint32_t size_;
    bool is_sum_;
    std::vector<Part> parts_;
    std::vector<Line> lines_;  // stack
};

std::optional<PolygonTriangulation> PolygonTable::solve() {
    if (size_ < 3 || !has_face(0, size_ - 1)) {
        return std::nullopt;
    }
    parts_.resize(std::size_t{size_ - 1} * (size_ - 2) / 2);
    find_needed();
    for (std::uint32_t span = 2; span < size_; ++span) {
        report_progress(progress_, static_cast<double>(span) / static_cast<double>(size_));
        for (std::uint32_t i = 0; i + span < size_; ++i) {
            if (part(i, i + span).is_needed) {
                solve_part(i, i + span);
            }
        }
    }
    if (cost(0, size_ - 1) == kInfinity) {
        return std::nullopt;
    }
    return trace();
}

bool PolygonTable::has_face(std::uint32_t i, std::uint32_t j) const {
    for (std::uint32_t k = i + 1; k < j; ++k) {
        if (measure(i, k, j) < kInfinity) {
            return true;
        }
    }
    return false;
}

void PolygonTable::need(std::uint32_t i, std::uint32_t j) {
    if (j - i > 1 && !part(i, j).is_needed) {
        part(i, j).is_needed = true;
        lines_.push_back({i, j});
    }
}

/// The parts that faces allowed lead to, from the whole polygon on. Where many are forbidden that is few.
void PolygonTable::find_needed() {
    need(0, size_ - 1);
    while (!lines_.empty()) {
        const Line line = lines_.back();
        lines_.pop_back();
        for (std::uint32_t k = line.i + 1; k < line.j; ++k) {
            if (measure(line.i, k, line.j) < kInfinity) {
                need(line.i, k);
                need(k, line.j);
            }
        }
        report_progress(progress_, 0);
    }
}

void PolygonTable::solve_part(std::uint32_t i, std::uint32_t j) {
    Part& best = part(i, j);
    for (std::uint32_t k = i + 1; k < j; ++k) {
        const double rest = join(cost(i, k), cost(k, j));
        // A measure makes a maximum no smaller; of a sum nothing is known before.
        if (rest == kInfinity || (!is_sum_ && rest >= best.cost)) {
            continue;
        }
        const double whole = join(rest, measure(i, k, j));
        if (whole < best.cost) {
            best.cost = whole;
            best.middle = k;
        }
    }
}

PolygonTriangulation PolygonTable::trace() {
    PolygonTriangulation result{cost(0, size_ - 1), {}};
    result.faces.reserve(size_ - 2);
    lines_.push_back({0, size_ - 1});
    while (!lines_.empty()) {
        const Line line = lines_.back();
        lines_.pop_back();
        if (line.j - line.i > 1) {
            const std::uint32_t k = part(line.i, line.j).middle;
            result.faces.push_back({line.i, k, line.j});
            lines_.push_back({k, line.j});
            lines_.push_back({line.i, k});
        }
    }
    return result;
}

}  // namespace

std::optional<PolygonTriangulation> triangulate_polygon(std::span<const Key2> ring,
                                                        const RingMeasure& measure, PolygonCost cost,
                                                        const Progress& progress) {
    return PolygonTable(ring, measure, cost, progress).solve();
}

}  // namespace tinwright
