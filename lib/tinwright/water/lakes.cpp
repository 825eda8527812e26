#include "tinwright/water/lakes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tinwright/breaklines/line_segments.hpp"
#include "tinwright/breaklines/polygon_cover.hpp"
#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/constructions.hpp"

namespace tinwright {

namespace {

std::vector<double> own_elevations(const LakeShape& shape, std::span<const Breakline> lines) {
    std::vector<double> own;
    for (const std::uint32_t line : shape.lines) {
        for (const Point3& point : lines[line].points) {
            if (std::isfinite(point.z)) {
                own.push_back(point.z);
            }
        }
    }
    return own;
}

double length_of(const CleanLine& ring) {
    double length = 0;
    for (std::size_t i = 1; i < ring.keys.size(); ++i) {
        length += std::sqrt(squared_distance(ring.keys[i - 1], ring.keys[i]));
    }
    return length;
}

/// Squared distance of a key to the nearest segment, if it is no farther than `reach`.
double squared_distance_to(const LineSegments& shore, Key2 key, double reach) {
    double least = std::numeric_limits<double>::infinity();
    shore.visit_meeting(box_around(key, reach), [&](const LineSegments::Segment& segment) {
        least = std::min(least, measure_distance(key, shore.start(segment), shore.end(segment)).squared);
    });
    return least;
}

}  // namespace

double choose_level(const LevelRule& rule, std::vector<double> z) {
    std::sort(z.begin(), z.end());
    if (rule.kind == LevelRule::Kind::Mean) {
        double sum = 0;
        for (const double value : z) {
            sum += value - z.front();
        }
        return z.front() + sum / static_cast<double>(z.size());
    }
    if (rule.kind == LevelRule::Kind::Min) {
        return z.front();
    }
    // The nearest rank: an elevation that was measured.
    const auto count = static_cast<double>(z.size());
    const double rank = std::ceil(rule.percent / 100 * count) - 1;
    return z[static_cast<std::size_t>(std::clamp(rank, 0.0, count - 1))];
}

MeasuredLake measure_lake(const LakeShape& shape, std::span<const Breakline> lines, NearSamples& samples,
                          const Lattice& lattice, const LevelRule& rule, double shore_width) {
    MeasuredLake measured;
    LakeLevel& lake = measured.lake;
    lake.line = shape.lines.front();
    lake.location = lattice.position(shape.rings.front().keys.front());
    double length = 0;
    KeyBox box = KeyBox::of(shape.rings.front().keys);
    for (const CleanLine& ring : shape.rings) {
        length += length_of(ring);
        box.add(KeyBox::of(ring.keys));
    }
    lake.shore_length = length * lattice.quantum();

    const double reach = shore_width / lattice.quantum();
    const LineSegments shore(shape.rings);
    const PolygonCover cover(shape.rings, std::vector<std::uint32_t>(shape.rings.size(), 0));
    std::vector<double> near;
    box = {{box.low.x - reach, box.low.y - reach}, {box.high.x + reach, box.high.y + reach}};
    samples.visit_in(box, [&](std::uint32_t sample) {
        const Key2 key = samples.key(sample);
        const double squared = squared_distance_to(shore, key, reach);
        const bool is_near = squared <= reach * reach;
        const bool is_inside = cover.covers(key);
        lake.samples_inside += is_inside && squared > 0 ? 1U : 0U;
        if (is_near) {
            near.push_back(samples.z(sample));
        }
        if (is_near && !is_inside) {
            measured.beside.push_back(sample);
        }
    });
    std::sort(measured.beside.begin(), measured.beside.end());
    lake.samples_on_shore = measured.beside.size();

    std::vector<double> own = own_elevations(shape, lines);
    lake.is_own = !own.empty();
    if (lake.is_own) {
        const auto [low, high] = std::minmax_element(own.begin(), own.end());
        measured.z_low = *low;
        measured.z_high = *high;
        lake.level = choose_level(rule, std::move(own));
        return measured;
    }
    if (near.empty()) {
        for (const CleanLine& ring : shape.rings) {
            for (const Key2 key : ring.keys) {
                near.push_back(samples.terrain(key));
            }
        }
    }
    lake.level = choose_level(rule, std::move(near));
    return measured;
}

}  // namespace tinwright
