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

CheckedSurface check_surface(const io::Source& source, Console& console, double begin, double end) {
    const double middle = begin + (end - begin) / 2;
    io::TinFile file = io::read_tin_file(source, console.progress().stage(begin, middle));
    CheckedSurface surface;
    surface.file = source.path;
    surface.layer = std::move(file.layer);
    surface.crs = file.crs;
    surface.vertices = file.vertices.size();
    surface.report = check_either_way_round(file);
    surface.face_ids = std::move(file.face_ids);
    report_progress(console.progress().stage(middle, end), 1);
    return surface;
}

}  // namespace

void CommandCheck::setup(const std::vector<std::string>& arguments) {
    const auto parser =
        make_parser("check", "Audits TIN files; lists what keeps them from being surfaces.",
                    "SURFACE... [-o FILE] [options]",
                    {"tinwright check tin.gpkg", "tinwright check tin.shp -o violations.gpkg"});
    sources.add_to(*parser);
    output.add_to(*parser, "write the violations as a point layer",
                  "output driver (default: from the extension)");
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    sources.finish();
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
    std::size_t violations = 0;
    const double share = 1.0 / static_cast<double>(sources.sources.size());
    for (const io::Source& source : sources.sources) {
        const double begin = share * static_cast<double>(surfaces.size());
        surfaces.push_back(check_surface(source, console, begin, begin + share));
        violations += surfaces.back().violation_count();
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
    }
    print_result(talk.json ? checked_json(surfaces, outputs).text() : list);
    return violations == 0 ? Outcome::Done : Outcome::ViolationsFound;
}

}  // namespace tinwright::tools
