#include "job_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <sys/resource.h>

#include "tinwright/geometry/decimal.hpp"

namespace tinwright::tools {

namespace {

std::size_t count_constrained_edges(const TriangleMesh& mesh) {
    std::size_t edges = 0;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            const HalfEdgeId h = half_edge(FaceId{f}, corner);
            const bool is_first = h < mesh.twin(h) || !mesh.is_terrain(face_of(mesh.twin(h)));
            edges += mesh.is_constrained(h) && is_first ? 1U : 0U;
        }
    }
    return edges;
}

/// Bounds of what was read, in the system that is written.
Box bounds_of(const Surface& surface) {
    const std::vector<Point2> vertices = io::written_vertices(surface.tin, surface.output_positions());
    if (vertices.empty()) {
        return surface.bounds();
    }
    Box bounds;
    for (const Point2 p : vertices) {
        bounds.add(p.x, p.y);
    }
    return bounds;
}

/// Whether there is more to say of the plane than that it is the one of the sources and of what is written.
bool is_plane_told(const Surface& surface) {
    using Origin = io::WorkingPlane::Origin;
    return surface.plane.is_source_geographic() || !surface.is_written_in_plane() ||
           surface.plane.origin == Origin::Utm || surface.plane.origin == Origin::Local;
}

const char* origin_word(io::WorkingPlane::Origin origin) {
    using Origin = io::WorkingPlane::Origin;
    switch (origin) {
        case Origin::Asked:
            return "asked";
        case Origin::Shared:
            return "shared";
        case Origin::Utm:
            return "utm";
        case Origin::Local:
            return "local";
        case Origin::Unknown:
            break;
    }
    return "unknown";
}

std::string counted(std::size_t count, const std::string& singular, const std::string& plural) {
    return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

std::string fixed(double value, int decimals) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

JsonValue raster_json(const RasterReport& raster) {
    const GridGeometry& grid = raster.grid;
    const Box extent = grid.extent();
    JsonValue json = JsonValue::object();
    json.set("columns", grid.columns)
        .set("rows", grid.rows)
        .set("cell_width", grid.cell_width)
        .set("cell_height", grid.cell_height)
        .set("extent", JsonValue::array_of({extent.x_min, extent.y_min, extent.x_max, extent.y_max}))
        .set("cells_with_value", raster.written.cells_with_value)
        .set("nodata",
             std::isnan(raster.written.nodata) ? JsonValue("nan") : JsonValue(raster.written.nodata))
        .set("type", raster.written.data_type)
        .set("method", raster.method)
        .set("products", JsonValue::array_of(raster.written.bands));
    if (raster.ground_size) {
        json.set("cell_on_ground", JsonValue::array_of({raster.ground_size->x, raster.ground_size->y}));
    }
    return json;
}

/// Of whatever was done to the Delaunay TIN afterwards.
std::optional<double> optimize_seconds(const TriangulateReport& report) {
    if (report.optimize) {
        return report.optimize->seconds;
    }
    return report.data_dependent ? std::optional(report.data_dependent->seconds) : std::nullopt;
}

JsonValue timings_json(const JobReport& report, const Surface& surface) {
    JsonValue timings = JsonValue::object();
    timings.set("read", surface.read_seconds);
    if (surface.water) {
        timings.set("water", surface.water->report.seconds);
    }
    if (surface.report) {
        timings.set("triangulate", surface.report->triangulate_seconds);
    }
    if (report.graph) {
        timings.set("graph", report.graph->seconds);
    } else if (surface.report) {
        timings.set("constrain", surface.report->constrain_seconds);
        if (const std::optional<double> seconds = optimize_seconds(*surface.report)) {
            timings.set("optimize", *seconds);
        }
    }
    if (report.raster) {
        timings.set("interpolate", report.raster->written.interpolate_seconds);
        timings.set("write", report.raster->written.write_seconds);
    } else if (!report.outputs.empty()) {
        if (report.contours) {
            timings.set("contour", report.contours->seconds);
        }
        timings.set("write", report.write_seconds);
    }
    return timings;
}

/// The keys that are about faces and what they keep to.
void set_face_keys(JsonValue& json, const Surface& surface) {
    json.set("constrained_edges", count_constrained_edges(surface.tin.mesh));
    if (surface.report) {
        json.set("steiner_vertices", surface.lines.steiner_vertices.value_or(0));
        json.set("conflicts", surface.report->lines.conflicts.size());
    } else if (surface.lines.steiner_vertices) {
        json.set("steiner_vertices", *surface.lines.steiner_vertices);
    }
    if (surface.lines.counts) {
        json.set("lines", lines_json(surface.lines));
    }
    if (surface.water) {
        json.set("water", water_json(*surface.water));
    }
    if (surface.flat_faces) {
        json.set("flat_faces", flat_faces_json(*surface.flat_faces));
    }
    if (!surface.criterion.name.empty()) {
        json.set("criterion", criterion_json(surface.criterion));
    }
    if (surface.report) {
        json.set("conforming", surface.report->is_conforming && surface.report->is_left_delaunay());
    } else if (surface.lines.is_conforming) {
        json.set("conforming", *surface.lines.is_conforming);
    }
}

std::string input_line(const Surface& surface) {
    if (!surface.report) {
        return "a TIN with " + counted(surface.tin.mesh.count_terrain(), "face", "faces") + " and " +
               counted(surface.tin.vertex_count(), "vertex", "vertices");
    }
    std::size_t skipped = 0;
    std::size_t sources = 0;
    for (const io::SampleSlice& slice : surface.slices) {
        skipped += slice.skipped;
        sources = std::max(sources, slice.source + 1);
    }
    std::string text = counted(surface.report->samples, "sample", "samples") + " from " +
                       counted(sources, "source", "sources");
    return skipped == 0 ? text : text + "; " + counted(skipped, "bad row", "bad rows") + " skipped";
}

std::string duplicates_line(const JobReport& report, const DuplicateReport& duplicates) {
    std::string text;
    if (duplicates.equal > 0) {
        text = std::to_string(duplicates.equal) + " merged with an equal one";
    }
    if (duplicates.conflicting > 0) {
        text += (text.empty() ? "" : ", ") + std::to_string(duplicates.conflicting) + " conflicting (" +
                report.duplicate_policy + " taken)";
    }
    return text;
}

std::string conflict_lines(const DuplicateReport& duplicates, const io::OutputPositions& positions) {
    std::string lines;
    for (const DuplicateConflict& conflict : duplicates.first) {
        lines += "    at " + location_text(positions.transform({conflict.location.x, conflict.location.y})) +
                 ": z from " + decimal_text(conflict.z_min) + " to " + decimal_text(conflict.z_max) + "\n";
    }
    return lines;
}

std::string tin_line(const JobReport& report, const Surface& surface) {
    const std::size_t faces = surface.report ? surface.report->faces : surface.tin.mesh.count_terrain();
    std::string text = counted(faces, "face", "faces") + " on " +
                       counted(surface.tin.vertex_count(), "vertex", "vertices") + ", domain " +
                       report.domain;
    if (surface.report && surface.report->domain.cut_faces > 0) {
        text += ", " + counted(surface.report->domain.cut_faces, "face", "faces") + " cut off";
    }
    if (surface.report && surface.report->domain.trimmed_faces > 0) {
        text += " (" + std::to_string(surface.report->domain.trimmed_faces) + " border faces dropped)";
    }
    const std::size_t voids = surface.report ? surface.report->domain.void_faces : surface.void_faces;
    if (voids > 0) {
        text += ", " + counted(voids, "face", "faces") + " dropped as voids";
    }
    return text;
}

/// Enough digits for a cell size; more are the noise of the raster it was taken from.
std::string length_text(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.10g", value);
    return decimal_text(std::strtod(text.data(), nullptr));
}

/// Three digits.
std::string short_text(double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.*f", std::clamp(2 - static_cast<int>(std::log10(value)), 0, 4),
                  value);
    return text.data();
}

std::string raster_line(const RasterReport& raster) {
    const GridGeometry& grid = raster.grid;
    const double cells = static_cast<double>(grid.columns) * static_cast<double>(grid.rows);
    const double share = 100 * static_cast<double>(raster.written.cells_with_value) / cells;
    std::string size = length_text(grid.cell_width);
    if (length_text(grid.cell_height) != size) {
        size += " x " + length_text(grid.cell_height);
    }
    std::string more;
    if (raster.ground_size) {
        size += " " + raster.unit;
        more = short_text(raster.ground_size->x) + " x " + short_text(raster.ground_size->y) +
               " m on the ground in the middle";
    }
    if (raster.is_resolution_chosen) {
        more += std::string(more.empty() ? "" : ", ") + "chosen from the sample spacing";
    }
    return std::to_string(grid.columns) + " x " + std::to_string(grid.rows) + " cells of " + size +
           (more.empty() ? "" : " (" + more + ")") + ", " + fixed(share, 1) + " % with a value, nodata " +
           decimal_text(raster.written.nodata);
}

std::string method_line(const RasterReport& raster) {
    std::string line = raster.method + ": ";
    for (const std::string& band : raster.written.bands) {
        line += (&band == raster.written.bands.data() ? "" : ", ") + band;
    }
    return line;
}

/// Step of the coordinates that came in; made points may have a finer one.
double data_quantum(const Lattice& lattice) { return std::ldexp(lattice.quantum(), lattice.refinement()); }

std::string quantum_line(const Lattice& lattice) {
    const int bits = lattice.refinement();
    const std::string made =
        bits == 0 ? std::string()
                  : "; made points at 1/" + std::to_string(1U << static_cast<unsigned>(bits)) + " of it";
    if (lattice.decimals() >= 0) {
        return decimal_text(data_quantum(lattice)) + made;
    }
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "2^%d, about %.1e", lattice.exponent() + bits,
                  data_quantum(lattice));
    return text.data() + (lattice.is_exact() ? std::string() : "; coordinates are rounded to it") + made;
}

std::string crs_line(const Surface& surface) {
    const std::string unit = surface.output_crs.unit();
    return surface.output_crs.name() + (unit.empty() ? "" : ", unit " + unit) +
           (surface.z_unit.empty() ? "" : ", z in " + surface.z_unit);
}

/// What slopes take a unit of z for.
JsonValue z_unit_json(const Surface& surface) {
    const bool is_assumed = surface.z_unit.empty();
    return JsonValue::object()
        .set("name", is_assumed ? surface.crs.unit() : surface.z_unit)
        .set("assumed", is_assumed)
        .set("factor", surface.z_factor);
}

/// "US survey foot, 0.304801 of the CRS's unit", "metre, assumed".
std::string times_line(const JobReport& report, const Surface& surface) {
    std::string times = "read " + fixed(surface.read_seconds, 2);
    times += surface.water ? ", water " + fixed(surface.water->report.seconds, 2) : "";
    if (surface.report) {
        times += ", triangulate " + fixed(surface.report->triangulate_seconds, 2) +
                 (report.graph ? ", graph " + fixed(report.graph->seconds, 2)
                               : ", domain " + fixed(surface.report->constrain_seconds, 2));
        if (const std::optional<double> seconds = optimize_seconds(*surface.report)) {
            times += ", optimise " + fixed(*seconds, 2);
        }
    }
    if (report.raster) {
        times += ", interpolate " + fixed(report.raster->written.interpolate_seconds, 2) + ", write " +
                 fixed(report.raster->written.write_seconds, 2);
    } else if (!report.outputs.empty()) {
        times += report.contours ? ", contour " + fixed(report.contours->seconds, 2) : "";
        times += ", write " + fixed(report.write_seconds, 2);
    }
    return times;
}

/// The report for people, line by line.
class ReportLines {
  public:
    explicit ReportLines(const std::string& title) : text_(title + "\n") {}

    void add(const std::string& label, const std::string& value) {
        text_ += "  " + label + std::string(12 - label.size(), ' ') + value + "\n";
    }
    /// Lines that are whole already.
    void append(const std::string& lines) { text_ += lines; }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
};

/// Where everything lies.
void add_place(const Surface& surface, ReportLines& lines) {
    lines.add("CRS", crs_line(surface));
    if (is_plane_told(surface)) {
        lines.add("plane", surface.plane.text());
    }
    if (surface.ground.is_geodesic()) {
        lines.add("lengths", "geodesic, " + surface.ground.unit);
    }
    const Box bounds = bounds_of(surface);
    lines.add("extent", decimal_text(bounds.x_min) + " " + decimal_text(bounds.y_min) + " " +
                            decimal_text(bounds.x_max) + " " + decimal_text(bounds.y_max));
    lines.add("quantum", quantum_line(surface.tin.lattice));
}

/// What came in.
void add_inputs(const JobReport& report, const Surface& surface, const ReportDetail& detail,
                ReportLines& lines) {
    if (surface.report && surface.report->duplicates.equal + surface.report->duplicates.conflicting > 0) {
        lines.add("duplicates", duplicates_line(report, surface.report->duplicates));
        lines.append(detail.conflicts ? conflict_lines(surface.report->duplicates, surface.output_positions())
                                      : "");
    }
    for (const auto& [label, line] : lines_lines(surface.lines)) {
        lines.add(label, line);
    }
    if (surface.water) {
        for (const auto& [label, line] : water_lines(*surface.water)) {
            lines.add(label, line);
        }
    } else if (const std::string water = file_water_text(surface.metadata); !water.empty()) {
        lines.add("water", water);
    }
}

/// What came of it.
void add_products(const JobReport& report, const Surface& surface, ReportLines& lines) {
    if (report.graph) {
        lines.add("graph", graph_line(*report.graph) + " on " +
                               counted(surface.tin.vertex_count(), "vertex", "vertices"));
    } else {
        lines.add("TIN", tin_line(report, surface));
    }
    if (surface.flat_faces) {
        lines.add("flat faces", flat_faces_line(*surface.flat_faces));
    }
    std::string label = "criterion";
    for (const std::string& line : criterion_lines(surface.criterion)) {
        lines.add(label, line);
        label.clear();
    }
    if (report.raster) {
        lines.add("raster", raster_line(*report.raster));
        if (report.raster->method != "linear" ||
            report.raster->written.bands != std::vector<std::string>{"elevation"}) {
            lines.add("method", method_line(*report.raster));
        }
    }
    if (report.contours) {
        lines.add("contours", contours_line(*report.contours));
        if (report.contours->tracing) {
            lines.add("traced", tracing_line(*report.contours));
        }
    }
    for (const auto& [name, line] : report.details) {
        lines.add(name, line);
    }
}

}  // namespace

std::size_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // kilobytes on Linux
}

JsonValue crs_json(const io::Crs& crs) {
    if (!crs.is_known()) {
        return {};
    }
    JsonValue value = JsonValue::object();
    if (!crs.code().empty()) {
        value.set("code", crs.code());
    }
    return value.set("name", crs.name()).set("unit", crs.unit()).set("wkt", crs.wkt());
}

JsonValue plane_json(const io::WorkingPlane& plane) {
    JsonValue scale = JsonValue::object();
    scale.set("least", plane.scale.least)
        .set("greatest", plane.scale.greatest)
        .set("distortion", plane.scale.distortion());
    JsonValue json = JsonValue::object();
    json.set("crs", crs_json(plane.crs)).set("origin", origin_word(plane.origin));
    if (!plane.extent.is_empty) {
        json.set("scale", scale).set("extent", plane.extent.text());
    }
    return json;
}

void set_lengths(JsonValue& json, const GroundMeasures& ground, const io::Crs& plane) {
    json.set("lengths", ground.is_geodesic() ? "geodesic" : "planar");
    json.set("length_unit", ground.is_geodesic() ? ground.unit : plane.unit());
}

JsonValue make_json(const JobReport& report, const Surface& surface) {
    const Box bounds = bounds_of(surface);
    JsonValue json = JsonValue::object();
    json.set("version", TINWRIGHT_VERSION)
        .set("command", report.command)
        .set("crs", crs_json(surface.output_crs));
    json.set("bounds", JsonValue::array_of({bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max}));
    if (surface.crs.is_known()) {
        json.set("working_crs", plane_json(surface.plane));
    }
    set_lengths(json, surface.ground, surface.crs);
    if (!report.graph) {
        json.set("z_unit", z_unit_json(surface));
    }
    if (surface.report) {
        json.set("samples", surface.report->samples);
    }
    json.set("vertices", surface.tin.vertex_count());
    if (!report.graph) {
        json.set("faces", surface.report ? surface.report->faces : surface.tin.mesh.count_terrain());
    }
    if (surface.report && !report.graph) {
        json.set("hull_vertices", surface.report->hull_vertices);
    }
    json.set("quantum", data_quantum(surface.tin.lattice));
    if (surface.report) {
        const DuplicateReport& duplicates = surface.report->duplicates;
        json.set(
            "duplicates",
            JsonValue::object().set("equal", duplicates.equal).set("conflicting", duplicates.conflicting));
    }
    if (report.graph) {
        json.set("graph", graph_json(*report.graph));
    } else {
        set_face_keys(json, surface);
        json.set("domain", report.domain);
    }
    if (report.raster) {
        json.set("raster", raster_json(*report.raster));
    }
    if (report.contours) {
        json.set("contours", contours_json(*report.contours));
    }
    json.set("outputs", JsonValue::array_of(report.outputs));
    json.set("timings", timings_json(report, surface));
    return json.set("peak_memory_bytes", peak_memory_bytes());
}

std::string report_text(const JobReport& report, const Surface& surface, const ReportDetail& detail) {
    ReportLines lines("tinwright " + report.command + ": " + input_line(surface));
    add_place(surface, lines);
    add_inputs(report, surface, detail, lines);
    add_products(report, surface, lines);
    for (std::size_t i = 0; i < report.outputs.size(); ++i) {
        const std::string type = report.raster ? ", " + report.raster->written.data_type : std::string();
        lines.add("wrote", report.outputs[i] + (i == 0 ? " (" + report.output_driver + type + ")" : ""));
    }
    const bool is_said = report.tells_slopes && is_z_unit_assumed(surface);
    if (is_said || (detail.times && !report.graph)) {
        lines.add("z unit", z_unit_text(surface));
    }
    if (detail.times) {
        lines.add("seconds", times_line(report, surface));
        lines.add("memory",
                  fixed(static_cast<double>(peak_memory_bytes()) / 1048576.0, 0) + " MiB at the peak");
    }
    return lines.text();
}

}  // namespace tinwright::tools
