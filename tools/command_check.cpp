#include "command_check.hpp"

#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/read_tin.hpp"

#include "checked_surface.hpp"
#include "console.hpp"
#include "interrupt.hpp"

namespace tinwright::tools {

namespace {

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

CheckedSurface check_surface(const io::Source& source, const OptimalityOptions& optimality, Console& console,
                             double begin, double end) {
    // Proving takes longer than all the rest.
    const double read = begin + (end - begin) * (optimality.criterion ? 0.1 : 0.5);
    const double audited = begin + (end - begin) * (optimality.criterion ? 0.2 : 1.0);
    io::TinFile file = io::read_tin_file(source, console.progress().stage(begin, read));
    CheckedSurface surface;
    surface.file = source.path;
    surface.layer = file.layer;
    surface.crs = file.crs;
    surface.vertices = file.vertices.size();
    surface.report = check_either_way_round(file);
    report_progress(console.progress().stage(read, audited), 1);
    if (optimality.criterion && surface.report.is_clean()) {
        surface.optimality = check_optimality(file, optimality, console.progress().stage(audited, end));
    }
    surface.face_ids = std::move(file.face_ids);
    return surface;
}

}  // namespace

void CommandCheck::setup(const std::vector<std::string>& arguments) {
    const auto parser =
        make_parser("check", "Audits TIN files; lists what keeps them from being surfaces, or optimal.",
                    "SURFACE... [-o FILE] [options]",
                    {"tinwright check tin.gpkg", "tinwright check tin.shp -o violations.gpkg",
                     "tinwright check tin.gpkg --criterion slope"});
    sources.add_to(*parser);
    optimality.add_to(*parser);
    output.add_to(*parser, "write the violations as a point layer",
                  "output driver (default: from the extension)");
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    sources.finish();
    optimality.finish();
    output.finish(false);
    talk.finish(output.is_stdout());
}

Outcome CommandCheck::run() {
    Console console("check", talk);
    refuse_to_overwrite_sources(output.path, sources.sources);
    const ViolationLayerOptions layer_options{output.driver, output.overwrite};
    if (!output.path.empty()) {
        check_violation_target(output.path, layer_options);
        check_output_place(output.path, output.overwrite);
    }
    std::vector<CheckedSurface> surfaces;
    std::size_t found = 0;
    const double share = 1.0 / static_cast<double>(sources.sources.size());
    for (const io::Source& source : sources.sources) {
        const double begin = share * static_cast<double>(surfaces.size());
        surfaces.push_back(check_surface(source, optimality, console, begin, begin + share));
        found += surfaces.back().violation_count() + surfaces.back().improvable();
    }
    console.progress().finish();
    std::vector<std::string> outputs;
    if (!output.path.empty()) {
        write_violations(surfaces, output.path, layer_options);
        outputs.push_back(output.path);
    }
    std::string list;
    for (const CheckedSurface& surface : surfaces) {
        list += output.is_stdout() ? std::string() : violation_lines(surface);
        console.say("tinwright check: " + verdict_line(surface) + "\n");
        if (surface.optimality) {
            console.say("tinwright check: " + surface.file + ": " + optimality_verdict(*surface.optimality) +
                        "\n");
        } else if (optimality.criterion) {
            console.say("tinwright check: " + surface.file + ": " + optimality.criterion_text +
                        ": not examined, since the faces are no surface\n");
        }
    }
    print_result(talk.json ? checked_json(surfaces, optimality.criterion.has_value(), outputs).text() : list);
    return found == 0 ? Outcome::Done : Outcome::ViolationsFound;
}

}  // namespace tinwright::tools
