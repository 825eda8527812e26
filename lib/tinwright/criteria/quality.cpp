#include "tinwright/criteria/quality.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/mesh/border.hpp"

namespace tinwright {

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct Vector3 {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// From one vertex to another, CRS units; differences of keys are exact.
Vector3 vector_between(const Tin& tin, VertexId from, VertexId to) {
    const double quantum = tin.lattice.quantum();
    const Key2 a = tin.key(from);
    const Key2 b = tin.key(to);
    return {(b.x - a.x) * quantum, (b.y - a.y) * quantum, tin.z[to.value] - tin.z[from.value]};
}

std::array<Vector3, 3> edges_of(const Tin& tin, FaceId face) {
    const auto& v = tin.mesh.face(face).vertex;
    return {vector_between(tin, v[0], v[1]), vector_between(tin, v[1], v[2]),
            vector_between(tin, v[2], v[0])};
}

double length(const Vector3& v) { return std::hypot(v.x, v.y); }
double cross(const Vector3& a, const Vector3& b) { return a.x * b.y - a.y * b.x; }

/// The angle opposite the longest edge; from sine and cosine together, so that it is as good near 180
/// degrees as elsewhere.
double largest_angle_deg(const std::array<Vector3, 3>& edges) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        longest = length(edges[i]) > length(edges[longest]) ? i : longest;
    }
    const Vector3& in = edges[(longest + 1) % 3];
    const Vector3& out = edges[(longest + 2) % 3];
    return std::atan2(std::abs(cross(in, out)), -(in.x * out.x + in.y * out.y)) * kDegrees;
}

double gradient_length(const std::array<Vector3, 3>& edges) {
    const Vector3& a = edges[0];
    const Vector3& b = edges[1];
    return std::hypot(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z) / std::abs(cross(a, b));
}

/// 1, 2, 5, 10, ... around both values; powers of ten alone where that makes too many bins.
std::vector<double> round_bounds(double minimum, double maximum) {
    constexpr double kMostDecades = 6;
    const double first = std::floor(std::log10(minimum));
    const double last = std::max(std::ceil(std::log10(maximum)), first + 1);
    std::vector<double> bounds;
    for (double decade = first; decade <= last; ++decade) {
        const double power = std::pow(10.0, decade);
        bounds.push_back(power);
        if (last - first <= kMostDecades && decade < last) {
            bounds.push_back(2 * power);
            bounds.push_back(5 * power);
        }
    }
    // No empty bins at the ends.
    while (bounds.size() > 2 && bounds[bounds.size() - 2] >= maximum) {
        bounds.pop_back();
    }
    const auto above = std::upper_bound(std::next(bounds.begin()), std::prev(bounds.end()), minimum);
    bounds.erase(bounds.begin(), std::prev(above));
    return bounds;
}

std::vector<double> histogram_bounds(FaceMeasure measure, double minimum, double maximum) {
    switch (measure) {
        case FaceMeasure::LargestAngle:
            return {60, 75, 90, 105, 120, 135, 150, 165, 180};
        case FaceMeasure::Slope:
            return {0, 1, 2, 5, 10, 20, 30, 45, 60, 75, 90};
        case FaceMeasure::LongestEdge:
        case FaceMeasure::Area:
            break;
    }
    return round_bounds(minimum, maximum);
}

Histogram make_histogram(const std::vector<double>& values, std::vector<double> bounds) {
    Histogram histogram;
    histogram.counts.resize(bounds.size() - 1, 0);
    for (const double value : values) {
        // Rounding may put a value a hair outside the outermost bounds: it belongs to the outermost bins.
        const auto above = std::upper_bound(std::next(bounds.begin()), std::prev(bounds.end()), value);
        ++histogram.counts[static_cast<std::size_t>(above - bounds.begin()) - 1];
    }
    histogram.bounds = std::move(bounds);
    return histogram;
}

std::vector<FaceValue> find_worst(const Tin& tin, const std::vector<FaceId>& faces,
                                  const std::vector<double>& values, std::size_t count) {
    std::vector<FaceValue> worst;
    const auto is_worse = [](const FaceValue& a, const FaceValue& b) {
        return a.value != b.value ? a.value > b.value : a.face < b.face;
    };
    for (std::size_t i = 0; i < faces.size() && count > 0; ++i) {
        const FaceValue candidate{faces[i], values[i], false};
        if (worst.size() == count && !is_worse(candidate, worst.back())) {
            continue;
        }
        if (worst.size() == count) {
            worst.pop_back();
        }
        worst.insert(std::upper_bound(worst.begin(), worst.end(), candidate, is_worse), candidate);
    }
    for (FaceValue& value : worst) {
        value.is_on_border = is_on_border(tin.mesh, value.face);
    }
    return worst;
}

/// The measure of a face, lengths and areas on the ground.
double measure_on_ground(const Tin& tin, FaceId face, FaceMeasure measure, const GroundMeasures& ground,
                         double z_factor) {
    if (measure != FaceMeasure::LongestEdge && measure != FaceMeasure::Area) {
        return measure_face(tin, face, measure, z_factor);
    }
    std::array<Point2, 3> corners{};
    for (unsigned i = 0; i < 3; ++i) {
        const Point3 p = tin.position(tin.mesh.vertex(face, i));
        corners[i] = {p.x, p.y};
    }
    if (measure == FaceMeasure::Area) {
        return ground.area(corners);
    }
    // Edges that the plane says are shorter by more than it is off, twice, need no measuring.
    const double least = measure_face(tin, face, measure) * (1 - 2 * ground.distortion - 1e-8);
    double longest = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const Point2 a = corners[i];
        const Point2 b = corners[next_corner(i)];
        if (std::hypot(b.x - a.x, b.y - a.y) >= least) {
            longest = std::max(longest, ground.length(a, b));
        }
    }
    return longest;
}

void fill(std::vector<double>& values, const Tin& tin, const std::vector<FaceId>& faces, FaceMeasure measure,
          const GroundMeasures& ground, double z_factor) {
    if (!ground.is_geodesic()) {
        std::transform(faces.begin(), faces.end(), values.begin(),
                       [&](FaceId face) { return measure_face(tin, face, measure, z_factor); });
        return;
    }
    constexpr std::size_t kBlock = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces.size(), kBlock), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            values[i] = measure_on_ground(tin, faces[i], measure, ground, z_factor);
        }
    });
}

double value_of_rank(std::vector<double>& values, std::size_t rank) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace

double measure_face(const Tin& tin, FaceId face, FaceMeasure measure, double z_factor) {
    const std::array<Vector3, 3> edges = edges_of(tin, face);
    switch (measure) {
        case FaceMeasure::LargestAngle:
            return largest_angle_deg(edges);
        case FaceMeasure::Slope:
            return std::atan(z_factor * gradient_length(edges)) * kDegrees;
        case FaceMeasure::LongestEdge:
            return std::max({length(edges[0]), length(edges[1]), length(edges[2])});
        case FaceMeasure::Area:
            return std::abs(cross(edges[0], edges[1])) / 2;
    }
    return 0;
}

double slope_ratio(const Tin& tin, FaceId face, double z_factor) {
    return z_factor * gradient_length(edges_of(tin, face));
}

QualityReport assess_quality(const Tin& tin, std::size_t worst, const GroundMeasures& ground,
                             double z_factor) {
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain(FaceId{f})) {
            faces.push_back(FaceId{f});
        }
    }
    QualityReport report;
    report.faces = faces.size();
    if (faces.empty()) {
        return report;
    }
    std::vector<double> values(faces.size());
    for (const FaceMeasure measure : kFaceMeasures) {
        fill(values, tin, faces, measure, ground, z_factor);
        if (measure == FaceMeasure::Area) {
            report.area = std::accumulate(values.begin(), values.end(), 0.0);
        }
        const auto [minimum, maximum] = std::minmax_element(values.begin(), values.end());
        MeasureSummary summary;
        summary.measure = measure;
        summary.minimum = *minimum;
        summary.maximum = *maximum;
        summary.histogram = make_histogram(values, histogram_bounds(measure, *minimum, *maximum));
        summary.worst = find_worst(tin, faces, values, worst);
        summary.median = value_of_rank(values, values.size() / 2);
        summary.percentile_99 = value_of_rank(values, values.size() * 99 / 100);
        report.summaries.push_back(std::move(summary));
    }
    return report;
}

}  // namespace tinwright
