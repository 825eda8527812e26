#include "checked_surface.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include <ogrsf_frmts.h>

#include "tinwright/delaunay/delaunay_edges.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/output_positions.hpp"
#include "tinwright/io/read_tin.hpp"
#include "tinwright/io/tin_dataset.hpp"
#include "tinwright/io/tin_drivers.hpp"

#include "surface_input.hpp"

namespace tinwright::tools {

namespace {

/// Stable names of the defects: keys of the JSON report and values of the layer's field `kind`.
std::string key_of(FaceDefect defect) {
    switch (defect) {
        case FaceDefect::NotFinite:
            return "not_finite";
        case FaceDefect::ZeroArea:
            return "zero_area";
        case FaceDefect::Clockwise:
            return "clockwise";
        case FaceDefect::Repeated:
            return "repeated";
        case FaceDefect::SharedEdge:
            return "shared_edge";
        case FaceDefect::Crack:
            return "crack";
        case FaceDefect::VertexOnEdge:
            return "vertex_on_edge";
        case FaceDefect::Overlap:
            return "overlap";
    }
    return {};
}

/// Which way round is right was found from most faces, so "clockwise" would be wrong half the time.
std::string words_of(FaceDefect defect) {
    return defect == FaceDefect::Clockwise ? "corners the other way round" : std::string(text_of(defect));
}

JsonValue violation_json(const CheckedSurface& surface, const FaceViolation& violation) {
    const Point3& at = violation.location;
    JsonValue json = JsonValue::object();
    json.set("kind", key_of(violation.defect)).set("face", surface.face_ids[violation.face]);
    if (violation.other != FaceViolation::kNoFace) {
        json.set("other", surface.face_ids[violation.other]);
    }
    return json.set("location", JsonValue::array_of({at.x, at.y, at.z}));
}

/// Formats differ in the way round that a ring has (Shapefiles: clockwise), so it is the faces unlike most
/// others that are wrong.
FaceCheckReport check_either_way_round(io::TinFile& file) {
    FaceCheckReport report = check_faces(file.vertices, file.corners);
    if (report.count(FaceDefect::Clockwise) == 0) {
        return report;
    }
    for (std::size_t i = 0; i + 2 < file.corners.size(); i += 3) {
        std::swap(file.corners[i + 1], file.corners[i + 2]);
    }
    FaceCheckReport turned = check_faces(file.vertices, file.corners);
    return turned.count(FaceDefect::Clockwise) < report.count(FaceDefect::Clockwise) ? turned : report;
}

/// Empty where the file does not tell which edges are parts of lines.
std::optional<ConformityReport> check_conformity(const io::TinFile& file) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const io::TinFile::LineEdge& edge : file.line_edges) {
        edges.emplace_back(edge.a, edge.b);
    }
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    if (edges.empty()) {
        return std::nullopt;
    }
    const Lattice lattice = find_lattice(file.vertices).lattice;
    std::vector<Key2> keys;
    keys.reserve(file.vertices.size());
    for (const Point3& vertex : file.vertices) {
        keys.push_back(lattice.key({vertex.x, vertex.y}));
    }
    ConformityReport report;
    report.line_edges = edges.size();
    report.open_edges = count_edges_without_disk(keys, edges);
    report.is_claimed = std::any_of(file.metadata.begin(), file.metadata.end(), [](const auto& item) {
        return item.first == "TINWRIGHT_CONFORMING" && item.second == "true";
    });
    return report;
}

/// "3 of 120 edges of lines are not Delaunay".
std::string open_edges_text(const ConformityReport& conformity) {
    return std::to_string(conformity.open_edges) + " of " + std::to_string(conformity.line_edges) +
           (conformity.open_edges == 1 ? " edges of lines is" : " edges of lines are") + " not Delaunay";
}

/// Tells of locations in the file's own system.
void bring_to(const io::Crs& own_crs, const io::TinFile& file, FaceCheckReport& report) {
    Box bounds;
    for (const Point3& p : file.vertices) {
        bounds.add(p.x, p.y);
    }
    const io::OutputPositions positions(file.crs, own_crs, bounds);
    for (FaceViolation& violation : report.violations) {
        positions.apply_to(std::span(&violation.location, 1));
    }
}

}  // namespace

CheckedSurface check_surface(const io::Source& source, const CrsOptions& crs,
                             const OptimalityOptions& optimality, ProgressLine& progress, double begin,
                             double end) {
    // Proving takes longer than all the rest.
    const double read = begin + (end - begin) * (optimality.criterion ? 0.1 : 0.5);
    const double audited = begin + (end - begin) * (optimality.criterion ? 0.2 : 1.0);
    io::TinFile file = io::read_tin_file(source, progress.stage(begin, read));
    const io::Crs own_crs = file.crs;
    const bool is_moved = !metadata_value(file.metadata, "TINWRIGHT_WORKING_CRS").empty();
    if (file.crs.is_geographic() || (file.crs.is_known() && is_moved)) {
        io::ReadOptions placing;
        crs.apply_to(placing);
        io::place_tin(file, source, placing);
    }
    CheckedSurface surface;
    surface.file = source.path;
    surface.layer = file.layer;
    surface.crs = own_crs.is_known() ? own_crs : file.crs;
    surface.vertices = file.vertices.size();
    surface.report = check_either_way_round(file);
    if (surface.report.is_clean()) {
        surface.conformity = check_conformity(file);
    }
    bring_to(surface.crs, file, surface.report);
    report_progress(progress.stage(read, audited), 1);
    if (optimality.criterion && surface.report.is_clean()) {
        surface.optimality =
            check_optimality(file, optimality, progress.stage(audited, end), z_factor_of(file, crs));
    }
    surface.face_ids = std::move(file.face_ids);
    return surface;
}

std::size_t CheckedSurface::violation_count() const {
    return std::accumulate(report.counts.begin(), report.counts.end(),
                           std::size_t{conformity && conformity->is_refuted() ? 1U : 0U});
}

std::string violation_lines(const CheckedSurface& surface) {
    std::string lines;
    for (const FaceViolation& violation : surface.report.violations) {
        const Point3& at = violation.location;
        lines += surface.file + ": face " + std::to_string(surface.face_ids[violation.face]) + ": " +
                 words_of(violation.defect);
        if (violation.other != FaceViolation::kNoFace) {
            lines += ", with face " + std::to_string(surface.face_ids[violation.other]);
        }
        lines += " at " + location_text({at.x, at.y});
        if (violation.defect == FaceDefect::Crack) {
            lines += ", z " + decimal_text(at.z) + " and " + decimal_text(violation.other_z);
        }
        lines += "\n";
    }
    const std::size_t unlisted =
        std::accumulate(surface.report.counts.begin(), surface.report.counts.end(), std::size_t{0}) -
        surface.report.violations.size();
    if (unlisted > 0) {
        lines += surface.file + ": and " + std::to_string(unlisted) + " more of these kinds\n";
    }
    if (surface.conformity && surface.conformity->is_refuted()) {
        lines += surface.file + ": " + open_edges_text(*surface.conformity) +
                 ", while its metadata say that it is conforming\n";
    }
    if (surface.optimality) {
        lines += improvable_lines(*surface.optimality, surface.file);
    }
    return lines;
}

std::vector<std::string> verdicts(const CheckedSurface& surface, const OptimalityOptions& optimality) {
    const std::size_t count = surface.violation_count();
    const std::string faces =
        std::to_string(surface.face_ids.size()) + (surface.face_ids.size() == 1 ? " face" : " faces");
    std::vector<std::string> list{
        surface.file + ": " +
        (count == 0 ? "clean, " + faces
                    : std::to_string(count) + (count == 1 ? " violation in " : " violations in ") + faces)};
    if (surface.conformity) {
        list.push_back(surface.file + ": conforming: " +
                       (surface.conformity->open_edges > 0
                            ? "no (" + open_edges_text(*surface.conformity) + ")"
                            : "yes (" + std::to_string(surface.conformity->line_edges) + " edges of lines)"));
    }
    if (surface.optimality) {
        list.push_back(surface.file + ": " + optimality_verdict(*surface.optimality));
    } else if (optimality.criterion) {
        list.push_back(surface.file + ": " + optimality.criterion_text +
                       ": not examined, since the faces are no surface");
    }
    return list;
}

JsonValue surface_json(const CheckedSurface& surface) {
    JsonValue counts = JsonValue::object();
    for (std::size_t i = 0; i < kFaceDefects; ++i) {
        counts.set(key_of(static_cast<FaceDefect>(i)), surface.report.counts[i]);
    }
    JsonValue violations = JsonValue::array();
    for (const FaceViolation& violation : surface.report.violations) {
        violations.append(violation_json(surface, violation));
    }
    JsonValue json = JsonValue::object();
    json.set("file", surface.file)
        .set("layer", surface.layer)
        .set("vertices", surface.vertices)
        .set("faces", surface.face_ids.size())
        .set("counts", counts)
        .set("violations", violations);
    if (surface.conformity) {
        JsonValue conformity = JsonValue::object();
        conformity.set("conforming", surface.conformity->open_edges == 0)
            .set("claimed", surface.conformity->is_claimed)
            .set("line_edges", surface.conformity->line_edges)
            .set("open_edges", surface.conformity->open_edges);
        json.set("conformity", conformity);
    }
    if (surface.optimality) {
        json.set("optimality", optimality_json(*surface.optimality));
    }
    return json;
}

void check_violation_target(const std::string& target, const ViolationLayerOptions& options) {
    static_cast<void>(io::find_tin_driver(target, options.driver));
}

void write_violations(std::span<const CheckedSurface> surfaces, const std::string& target,
                      const ViolationLayerOptions& options) {
    constexpr std::array<io::TinField, 4> kFields{
        {{"surface", OFTInteger}, {"kind", OFTString}, {"face", OFTInteger64}, {"other", OFTInteger64}}};
    const io::TinDriver driver = io::find_tin_driver(target, options.driver);
    io::WriteTinOptions write_options;
    if (driver.name.starts_with("GeoJSON")) {
        write_options.layer_options = {"COORDINATE_PRECISION=9"};
    }
    const io::Crs crs = surfaces.empty() ? io::Crs() : surfaces.front().crs;
    io::AtomicOutput output(target, options.overwrite);
    io::TinDataset dataset(driver, output.path(), target, crs, write_options);
    io::TinLayer layer = dataset.add_layer("violations", wkbPoint25D, kFields, Tin{});
    int number = 0;
    const auto write = [&](const std::string& kind, std::int64_t face, std::optional<std::int64_t> other,
                           const Point3& location) {
        layer.set(0, number);
        layer.set(1, kind);
        layer.set(2, face);
        if (other) {
            layer.set(3, *other);
        } else {
            layer.set_null(3);
        }
        auto& point = layer.geometry<OGRPoint>();
        point.setX(location.x);
        point.setY(location.y);
        point.setZ(location.z);
        layer.write();
    };
    for (const CheckedSurface& surface : surfaces) {
        ++number;
        for (const FaceViolation& violation : surface.report.violations) {
            const bool has_other = violation.other != FaceViolation::kNoFace;
            write(key_of(violation.defect), surface.face_ids[violation.face],
                  has_other ? std::optional(surface.face_ids[violation.other]) : std::nullopt,
                  violation.location);
        }
        for (std::size_t i = 0; surface.optimality && i < surface.optimality->listed.size(); ++i) {
            const ImprovableFace& face = surface.optimality->listed[i];
            write("improvable", face.face, std::nullopt, face.from);
        }
    }
    dataset.close();
    output.commit();
}

}  // namespace tinwright::tools
