#include "quality_report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::tools {

namespace {

struct MeasureWords {
    const char* key;    ///< in JSON
    const char* title;  ///< for people
    const char* unit;
};

/// Of the ground the unit is told.
MeasureWords words_of(FaceMeasure measure, bool is_geodesic) {
    switch (measure) {
        case FaceMeasure::LargestAngle:
            return {"largest_angle_deg", "largest angle", " deg"};
        case FaceMeasure::Slope:
            return {"slope_deg", "slope", " deg"};
        case FaceMeasure::LongestEdge:
            return {"longest_edge", "longest edge", is_geodesic ? " metre" : ""};
        case FaceMeasure::Area:
            return {"area", "area", is_geodesic ? " square metre" : ""};
    }
    return {"", "", ""};
}

std::string short_number(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

std::pair<double, double> z_range(const Tin& tin) {
    const auto [low, high] = std::minmax_element(tin.z.begin(), tin.z.end());
    return {*low, *high};
}

const char* kind_name(io::SampleSlice::Kind kind) {
    switch (kind) {
        case io::SampleSlice::Kind::Vector:
            return "vector";
        case io::SampleSlice::Kind::Text:
            return "text";
        case io::SampleSlice::Kind::Raster:
            return "raster";
    }
    return "";
}

/// As they are written.
std::array<Point3, 3> corners_of(const Tin& tin, const io::OutputPositions& positions, FaceId face) {
    const auto& v = tin.mesh.face(face).vertex;
    std::array<Point3, 3> corners{tin.position(v[0]), tin.position(v[1]), tin.position(v[2])};
    positions.apply_to(corners);
    return corners;
}

/// The bins from the first to the last that hold something.
std::string histogram_lines(const Histogram& histogram, const char* unit) {
    constexpr std::size_t kBar = 40;
    const std::size_t most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    std::size_t first = 0;
    std::size_t last = histogram.counts.size();
    for (; histogram.counts[first] == 0; ++first) {
    }
    for (; histogram.counts[last - 1] == 0; --last) {
    }
    std::string lines;
    for (std::size_t i = first; i < last; ++i) {
        std::array<char, 96> line{};
        const std::string range =
            decimal_text(histogram.bounds[i]) + " to " + decimal_text(histogram.bounds[i + 1]);
        std::snprintf(line.data(), line.size(), "    %16s%s %10zu", range.c_str(), unit, histogram.counts[i]);
        const std::size_t bar = (histogram.counts[i] * kBar + most - 1) / most;
        lines += line.data() + (bar == 0 ? std::string() : " " + std::string(bar, '#')) + "\n";
    }
    return lines;
}

std::string worst_lines(const Tin& tin, const io::OutputPositions& positions, const MeasureSummary& summary,
                        const char* unit) {
    std::string lines = "    greatest:\n";
    for (const FaceValue& face : summary.worst) {
        lines += "      " + short_number(face.value) + unit + " at";
        for (const Point3& corner : corners_of(tin, positions, face.face)) {
            lines += " (" + decimal_text(corner.x) + " " + decimal_text(corner.y) + " " +
                     decimal_text(corner.z) + ")";
        }
        lines += face.is_on_border ? ", on the border\n" : "\n";
    }
    return lines;
}

JsonValue worst_json(const Tin& tin, const io::OutputPositions& positions, const MeasureSummary& summary) {
    JsonValue list = JsonValue::array();
    for (const FaceValue& face : summary.worst) {
        JsonValue corners = JsonValue::array();
        for (const Point3& corner : corners_of(tin, positions, face.face)) {
            corners.append(JsonValue::array_of({corner.x, corner.y, corner.z}));
        }
        list.append(JsonValue::object()
                        .set("value", face.value)
                        .set("on_border", face.is_on_border)
                        .set("corners", corners));
    }
    return list;
}

}  // namespace

std::string content_text(const Surface& surface) {
    std::string text;
    for (const io::SampleSlice& slice : surface.slices) {
        text += "  source      " + slice.file + (slice.layer.empty() ? "" : ", " + slice.layer) + ": " +
                std::to_string(slice.count) + " samples\n";
    }
    if (surface.tin.vertex_count() > 0) {
        const auto [low, high] = z_range(surface.tin);
        text += "  z           " + decimal_text(low) + " to " + decimal_text(high) + "\n";
    }
    for (const auto& [key, value] : surface.metadata) {
        text += "  " + key + " = " + value + "\n";
    }
    return text;
}

void add_content_json(JsonValue& json, const Surface& surface) {
    JsonValue sources = JsonValue::array();
    for (const io::SampleSlice& slice : surface.slices) {
        sources.append(JsonValue::object()
                           .set("file", slice.file)
                           .set("layer", slice.layer)
                           .set("kind", kind_name(slice.kind))
                           .set("samples", slice.count)
                           .set("skipped", slice.skipped));
    }
    if (surface.report) {
        json.set("sources", sources);
    }
    if (surface.tin.vertex_count() > 0) {
        const auto [low, high] = z_range(surface.tin);
        json.set("z",
                 JsonValue::object().set("minimum", low).set("maximum", high).set("unit", surface.z_unit));
    }
    JsonValue metadata = JsonValue::object();
    for (const auto& [key, value] : surface.metadata) {
        metadata.set(key, value);
    }
    if (!surface.report) {
        json.set("layer", surface.tin_layer).set("metadata", metadata);
    }
}

std::string quality_text(const Surface& surface, const QualityReport& quality) {
    const io::OutputPositions positions = surface.output_positions();
    std::string text;
    for (const MeasureSummary& summary : quality.summaries) {
        const MeasureWords words = words_of(summary.measure, surface.ground.is_geodesic());
        text += std::string("  ") + words.title + ": from " + short_number(summary.minimum) + " to " +
                short_number(summary.maximum) + words.unit + ", median " + short_number(summary.median) +
                ", 99 % up to " + short_number(summary.percentile_99) + "\n" +
                histogram_lines(summary.histogram, words.unit) +
                worst_lines(surface.tin, positions, summary, words.unit);
    }
    return text;
}

void add_quality_json(JsonValue& json, const Surface& surface, const QualityReport& quality) {
    const io::OutputPositions positions = surface.output_positions();
    json.set("area", quality.area);
    JsonValue measures = JsonValue::object();
    for (const MeasureSummary& summary : quality.summaries) {
        JsonValue counts = JsonValue::array();
        for (const std::size_t count : summary.histogram.counts) {
            counts.append(count);
        }
        JsonValue measure = JsonValue::object();
        measure.set("minimum", summary.minimum)
            .set("median", summary.median)
            .set("percentile_99", summary.percentile_99)
            .set("maximum", summary.maximum);
        if (summary.measure == FaceMeasure::Slope) {
            measure.set("maximum_ratio",
                        slope_ratio(surface.tin, summary.worst.front().face, surface.z_factor));
        }
        measure.set("histogram", JsonValue::object()
                                     .set("bounds", JsonValue::array_of(summary.histogram.bounds))
                                     .set("counts", counts));
        const MeasureWords words = words_of(summary.measure, false);
        measures.set(words.key, measure.set("worst", worst_json(surface.tin, positions, summary)));
    }
    json.set("measures", measures);
}

}  // namespace tinwright::tools
