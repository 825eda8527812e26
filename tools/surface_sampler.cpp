#include "surface_sampler.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/read_places.hpp"

namespace tinwright::tools {

namespace {

using Type = TableColumn::Type;

constexpr std::array<TableColumn, 10> kPointColumns{{{"source", Type::Whole},
                                                     {"id", Type::Whole},
                                                     {"x", Type::Real},
                                                     {"y", Type::Real},
                                                     {"z", Type::Real},
                                                     {"slope", Type::Real},
                                                     {"aspect", Type::Real},
                                                     {"face", Type::Whole},
                                                     {"inside", Type::Whole},
                                                     {"breakline", Type::Real}}};
constexpr std::array<TableColumn, 14> kLineColumns{{{"source", Type::Whole},
                                                    {"id", Type::Whole},
                                                    {"line", Type::Whole},
                                                    {"part", Type::Whole},
                                                    {"chainage", Type::Real},
                                                    {"kind", Type::Text},
                                                    {"x", Type::Real},
                                                    {"y", Type::Real},
                                                    {"z", Type::Real},
                                                    {"slope", Type::Real},
                                                    {"aspect", Type::Real},
                                                    {"face", Type::Whole},
                                                    {"inside", Type::Whole},
                                                    {"breakline", Type::Real}}};

// Read together: enough to keep all threads busy, few enough to be asked now and then whether to stop.
constexpr std::size_t kPointsAtATime = 16384;

std::string kind_word(ProfilePoint::Kind kind) {
    switch (kind) {
        case ProfilePoint::Kind::Line:
            return "line";
        case ProfilePoint::Kind::Vertex:
            return "vertex";
        case ProfilePoint::Kind::Edge:
            return "edge";
        case ProfilePoint::Kind::Step:
            break;
    }
    return "step";
}

/// The places that there are, and where each of them stands among all.
struct PlaceList {
    std::vector<SurfacePlace> places;
    std::vector<std::size_t> indices;  // one an optional place; meaningless for empty ones
};

template <class Items, class PlaceOf>
PlaceList list_places(const Items& items, const PlaceOf& place_of) {
    PlaceList list;
    list.indices.reserve(items.size());
    for (const auto& item : items) {
        list.indices.push_back(list.places.size());
        if (const std::optional<SurfacePlace>& place = place_of(item)) {
            list.places.push_back(*place);
        }
    }
    return list;
}

/// The readings in the order of all items; nothing in particular for those without a place.
class Readings {
  public:
    Readings(const Interpolator& surface, PlaceList list)
        : indices_(std::move(list.indices)), readings_(read_places(surface, list.places)) {}

    [[nodiscard]] SurfaceReading at(std::size_t item) const {
        return indices_[item] < readings_.size() ? readings_[indices_[item]] : SurfaceReading{};
    }

  private:
    std::vector<std::size_t> indices_;
    std::vector<SurfaceReading> readings_;
};

ProfileCurve make_curve(const std::string& name, const std::vector<ProfilePoint>& points,
                        const Readings& readings) {
    ProfileCurve curve{name, {}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].place) {
            continue;
        }
        curve.parts.resize(points[i].part + std::size_t{1});
        curve.parts.back().push_back({points[i].chainage, readings.at(i).z});
    }
    return curve;
}

}  // namespace

std::vector<bool> breaklines_of(const Surface& surface) {
    std::vector<bool> are_breaklines;
    for (const io::LineOrigin& line : surface.origins.lines) {
        are_breaklines.push_back(line.role == LineRole::Breakline);
    }
    return are_breaklines;
}

std::span<const TableColumn> point_columns() { return kPointColumns; }
std::span<const TableColumn> line_columns() { return kLineColumns; }

SurfaceSampler::SurfaceSampler(const Surface& surface, const InterpolationChoice& interpolation,
                               SlopeUnit slope_unit, const io::Crs& place_crs, int threads, Progress progress)
    : surface_(surface),
      slope_unit_(slope_unit),
      interpolator_(interpolation.make(surface, threads)),
      face_numbers_(number_terrain(surface.tin.mesh)),
      breaklines_(surface.tin, breaklines_of(surface)),
      lattice_(surface.tin),
      positions_(surface.output_positions()),
      is_given_written_(place_crs.is_same_horizontally(surface.output_crs)),
      progress_(std::move(progress)) {}

void SurfaceSampler::append_reading(std::vector<TableValue>& row, Point2 position, Point2 written,
                                    const std::optional<SurfacePlace>& place,
                                    const SurfaceReading& reading) const {
    row.emplace_back(written.x);
    row.emplace_back(written.y);
    if (place) {
        row.emplace_back(reading.z);
        const Point2 gradient{surface_.z_factor * reading.gradient.x, surface_.z_factor * reading.gradient.y};
        row.emplace_back(slope_of(gradient, slope_unit_));
        row.emplace_back(aspect_of(reading.gradient));
        row.emplace_back(static_cast<std::int64_t>(face_numbers_[place->face.value]));
    } else {
        row.resize(row.size() + 4);
    }
    row.emplace_back(std::int64_t{place ? 1 : 0});
    // Infinite, so empty, where there is none.
    row.emplace_back(breaklines_.at(lattice_.at(position), surface_.ground));
}

void SurfaceSampler::sample_points(const Queries& queries, SampleTable& table, SampledCounts& counts) const {
    const SurfaceLocator locator(surface_.tin);
    std::vector<TableValue> row;
    for (std::size_t first = 0; first < queries.points.size(); first += kPointsAtATime) {
        report_progress(progress_, static_cast<double>(first) / static_cast<double>(queries.points.size()));
        const std::span<const Point2> points =
            std::span(queries.points)
                .subspan(first)
                .first(std::min(kPointsAtATime, queries.points.size() - first));
        const std::vector<std::optional<SurfacePlace>> places = find_places(locator, points);
        const Readings readings(*interpolator_, list_places(places, [](const auto& place) { return place; }));
        const std::vector<Point2> written = positions_.transform(points);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const QueryId& id = queries.point_ids[first + i];
            const std::optional<Point2>& given = queries.given[first + i];
            const Point2 position = given && is_given_written_ ? *given : written[i];
            row.assign({id.source, id.feature});
            append_reading(row, points[i], position, places[i], readings.at(i));
            table.add(position, row);
            counts.outside += places[i] ? 0 : 1;
        }
    }
    counts.points += queries.points.size();
}

void SurfaceSampler::sample_lines(const Queries& queries, const ProfileOptions& options, SampleTable& table,
                                  SampledCounts& counts, std::vector<ProfileCurve>* curves) const {
    const ProfileCutter cutter(surface_.tin);
    std::vector<TableValue> row;
    for (std::size_t l = 0; l < queries.lines.size(); ++l) {
        report_progress(progress_, static_cast<double>(l) / static_cast<double>(queries.lines.size()));
        const std::vector<ProfilePoint> points = cutter.cut(queries.lines[l], options);
        const Readings readings(*interpolator_,
                                list_places(points, [](const auto& point) { return point.place; }));
        std::vector<Point2> written;
        std::transform(points.begin(), points.end(), std::back_inserter(written),
                       [](const ProfilePoint& point) { return point.position; });
        written = positions_.transform(written);
        const QueryId& id = queries.line_ids[l];
        std::uint32_t parts = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const ProfilePoint& point = points[i];
            row.assign({id.source, id.feature, static_cast<std::int64_t>(l)});
            if (point.place) {
                parts = point.part + 1;
                row.emplace_back(std::int64_t{point.part});
            } else {
                ++counts.outside;
                row.emplace_back();
            }
            row.emplace_back(point.chainage);
            row.emplace_back(kind_word(point.kind));
            append_reading(row, point.position, written[i], point.place, readings.at(i));
            table.add(written[i], row);
        }
        counts.points += points.size();
        counts.parts += parts;
        if (curves != nullptr) {
            curves->push_back(make_curve(
                "line " + std::to_string(l) + " (id " + std::to_string(id.feature) + ")", points, readings));
        }
    }
    counts.lines += queries.lines.size();
}

}  // namespace tinwright::tools
