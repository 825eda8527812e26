#include "tinwright/breaklines/crossing_elevations.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <iterator>

namespace tinwright {
namespace {

/// The mean, counted from the lowest, so that equal elevations give themselves and order does not matter.
double mean_of(std::vector<double>& z) {
    std::sort(z.begin(), z.end(), [](double a, double b) { return std::strong_order(a, b) < 0; });
    double sum = 0;
    for (const double value : z) {
        sum += value - z.front();
    }
    return z.front() + sum / static_cast<double>(z.size());
}

/// The lowest and the highest of some elevations.
struct Range {
    const LineVisit* low = nullptr;
    const LineVisit* high = nullptr;
    double z_low = 0;
    double z_high = 0;

    void add(double z, const LineVisit* visit) {
        if (low == nullptr || z < z_low) {
            z_low = z;
            low = visit;
        }
        if (high == nullptr || z > z_high) {
            z_high = z;
            high = visit;
        }
    }
    [[nodiscard]] double width() const { return z_high - z_low; }
};

}  // namespace

double CrossingElevations::elevation(const LineVisit& visit, std::uint32_t vertex) const {
    const double z_from = z_of_point(visit.line, visit.point);
    if (visit.is_own) {
        return z_from;
    }
    // Counted from the same end whatever the line's direction.
    const double z_to = z_of_point(visit.line, visit.point + 1);
    const std::uint32_t segment = network_.segment_at[visit.point];
    const Key2 a = network_.a(segment);
    const Key2 b = network_.b(segment);
    const bool is_forward = network_.sites[network_.site[visit.point]] == a;
    const double z_a = is_forward ? z_from : z_to;
    const double z_b = is_forward ? z_to : z_from;
    const Key2 at = rounded_.vertices[vertex];
    const double way_x = b.x - a.x;
    const double way_y = b.y - a.y;
    const double part = ((at.x - a.x) * way_x + (at.y - a.y) * way_y) / (way_x * way_x + way_y * way_y);
    return z_a + (z_b - z_a) * part;
}

/// How far elevations may be apart that mean the same: a part in 10^12 and, where lines were bent, as far as
/// the segments there rise in two lattice steps.
double CrossingElevations::slack(std::span<const LineVisit> visits) const {
    constexpr double kPart = 0x1p-40;
    double slack = 0;
    const auto add_segment_from = [&](const LineVisit& visit, std::uint32_t point) {
        const double z_from = z_of_point(visit.line, point);
        const double z_to = z_of_point(visit.line, point + 1);
        const std::uint32_t segment = network_.segment_at[point];
        if (segment == kNoSegment || std::isnan(z_from) || std::isnan(z_to)) {
            return;
        }
        const Key2 a = network_.a(segment);
        const Key2 b = network_.b(segment);
        const double steps = rounded_.is_rounded ? 2 : 0;
        const double rise = std::abs(z_to - z_from) / std::hypot(b.x - a.x, b.y - a.y);
        slack = std::max(slack, kPart * (std::abs(z_from) + std::abs(z_to)) + steps * rise);
    };
    for (const LineVisit& visit : visits) {
        if (visit.is_own && visit.point > points_.start[visit.line]) {
            add_segment_from(visit, visit.point - 1);
        }
        if (visit.point + 1 < points_.start[visit.line + 1]) {
            add_segment_from(visit, visit.point);
        }
    }
    return slack;
}

MeetingElevation CrossingElevations::meet(std::span<const LineVisit> visits, std::uint32_t vertex) {
    int rank = 0;
    for (const LineVisit& visit : visits) {
        if (rank_of(visit) > rank && !std::isnan(elevation(visit, vertex))) {
            rank = rank_of(visit);
        }
    }
    if (rank == 0) {
        return meet_all(visits, vertex);
    }
    of_water_.clear();
    std::copy_if(visits.begin(), visits.end(), std::back_inserter(of_water_),
                 [&](const LineVisit& visit) { return rank_of(visit) == rank; });
    MeetingElevation met = meet_all(of_water_, vertex);
    if (met.is_clash) {
        return met;
    }
    Range all;
    for (const LineVisit& visit : visits) {
        const double z = rank_of(visit) > 0 ? met.z : elevation(visit, vertex);
        if (!std::isnan(z)) {
            all.add(z, &visit);
        }
    }
    if (all.width() > options_.crossing_tolerance + slack(visits)) {
        return {met.z, true, true, all.low, all.high, all.z_low, all.z_high};
    }
    return met;
}

MeetingElevation CrossingElevations::meet_all(std::span<const LineVisit> visits, std::uint32_t vertex) {
    said_.clear();
    Range all;
    Range of_points;
    for (const LineVisit& visit : visits) {
        const double z = elevation(visit, vertex);
        if (std::isnan(z)) {
            continue;
        }
        said_.push_back({z, &visit});
        all.add(z, &visit);
        if (visit.is_own) {
            of_points.add(z, &visit);
        }
    }
    if (said_.empty()) {
        return {};
    }
    if (all.width() == 0) {
        return {std::min_element(said_.begin(), said_.end(), [](const Said& p, const Said& q) {
                    return std::strong_order(p.z, q.z) < 0;  // zeros of both signs
                })->z};
    }
    const double rounding = slack(visits);
    const double tolerance = options_.crossing_tolerance;
    if (of_points.width() > tolerance || all.width() > tolerance + rounding) {
        return {choose(all.z_low, all.z_high), true, false, all.low, all.high, all.z_low, all.z_high};
    }
    return {mean(of_points.low != nullptr && all.width() <= rounding)};
}

/// Each line counts once.
double CrossingElevations::mean(bool of_points_only) {
    line_means_.clear();
    for (std::size_t i = 0; i < said_.size();) {
        const std::uint32_t line = said_[i].visit->line;
        of_line_.clear();
        for (; i < said_.size() && said_[i].visit->line == line; ++i) {
            if (said_[i].visit->is_own || !of_points_only) {
                of_line_.push_back(said_[i].z);
            }
        }
        if (!of_line_.empty()) {
            line_means_.push_back(mean_of(of_line_));
        }
    }
    return mean_of(line_means_);
}

double CrossingElevations::choose(double low, double high) {
    switch (options_.crossing_z) {
        case CrossingPolicy::First:
            return said_.front().z;
        case CrossingPolicy::Min:
            return low;
        case CrossingPolicy::Max:
            return high;
        default:
            return mean(false);
    }
}

}  // namespace tinwright
