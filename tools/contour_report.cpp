#include "contour_report.hpp"

#include <array>
#include <cstdio>

#include "tinwright/geometry/decimal.hpp"

namespace tinwright::tools {

namespace {

std::string counted(std::size_t count, const std::string& singular) {
    return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

std::string short_text(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

void add_lines(const LevelLines& lines, const GroundMeasures& ground, ContourReport& report) {
    report.lines += lines.count();
    report.points += lines.points.size();
    for (std::size_t i = 0; i < lines.count(); ++i) {
        const auto points = lines.line(i);
        report.closed += points.front() == points.back() ? 1U : 0U;
        for (std::size_t k = 1; k < points.size(); ++k) {
            report.length += ground.length(points[k - 1], points[k]);
        }
    }
}

}  // namespace

ContourReport summarize(const Contours& contours, const GroundMeasures& ground, const std::string& method) {
    ContourReport report;
    report.method = method;
    report.tracing = contours.tracing;
    report.levels = contours.levels.size();
    if (!contours.levels.empty()) {
        report.lowest = contours.levels.front().elevation;
        report.highest = contours.levels.back().elevation;
    }
    for (const LevelLines& lines : contours.lines) {
        add_lines(lines, ground, report);
    }
    report.is_bands = !contours.bands.empty();
    for (const Band& band : contours.bands) {
        ++report.lines;
        report.polygons += band.polygons.size();
        for (const BandPolygon& polygon : band.polygons) {
            for (const BandRing& ring : polygon) {
                report.points += ring.size();
            }
        }
    }
    return report;
}

JsonValue contours_json(const ContourReport& report) {
    JsonValue json = JsonValue::object();
    json.set("levels", report.levels);
    if (report.levels > 0) {
        json.set("lowest", report.lowest).set("highest", report.highest);
    }
    if (report.is_bands) {
        json.set("bands", report.lines).set("polygons", report.polygons).set("points", report.points);
    } else {
        json.set("lines", report.lines)
            .set("closed", report.closed)
            .set("points", report.points)
            .set("length", report.length);
    }
    json.set("method", report.method);
    if (report.tracing) {
        json.set("tolerance", report.tracing->tolerance)
            .set("largest_error", report.tracing->largest_error)
            .set("unresolved", report.tracing->unresolved)
            .set("traced_faces", report.tracing->faces);
    }
    return json;
}

std::string contours_line(const ContourReport& report) {
    std::string text = counted(report.levels, "level");
    if (report.levels > 0) {
        text += " from " + decimal_text(report.lowest) + " to " + decimal_text(report.highest);
    }
    text += ", ";
    text += report.is_bands
                ? counted(report.lines, "band") + " (" + counted(report.polygons, "polygon") + ")"
                : counted(report.lines, "line") + " (" + std::to_string(report.closed) + " closed)";
    return text + ", " + counted(report.points, "point");
}

std::string tracing_line(const ContourReport& report) {
    if (!report.tracing) {
        return {};
    }
    return report.method + ", within " + decimal_text(report.tracing->tolerance) + " (largest error found " +
           short_text(report.tracing->largest_error) + ")";
}

}  // namespace tinwright::tools
