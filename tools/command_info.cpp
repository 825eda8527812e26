#include "command_info.hpp"

#include "tinwright/criteria/quality.hpp"
#include "tinwright/geometry/threads.hpp"

#include "console.hpp"
#include "job_report.hpp"
#include "quality_report.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

namespace {

constexpr std::size_t kWorstFaces = 5;  // of each measure

}  // namespace

void CommandInfo::setup(const std::vector<std::string>& arguments) {
    const auto parser =
        make_parser("info", "Tells what samples or a TIN are like; writes no file.", "SOURCE... [options]",
                    {"tinwright info survey.csv", "tinwright info tin.gpkg --json"});
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    triangulation.add_to(*parser, "convex");
    crs.add_to(*parser);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    crs.finish();
    crs.plane.takes_best = !crs.plane.is_limit_given;  // to tell of a TIN is no reason to refuse it
    sources.finish();
    // Conflicts are to be counted and shown, not to end the command that was asked to show them.
    triangulation.finish(DomainRule::Kind::Convex, DuplicatePolicy::Mean);
    talk.finish(false);
}

Outcome CommandInfo::run() {
    Console console("info", talk);
    const SurfaceRequest request{.sources = sources, .crs = crs, .triangulation = triangulation};
    const bool is_tin = is_existing_tin(request);
    Surface surface = is_tin ? read_existing_tin(request, console) : triangulate_sources(request, console);
    if (crs.crs_text.empty() && is_tin && surface.plane.is_source_geographic()) {
        surface.output_crs = surface.plane.source_crs;  // the file as it is
    }
    if (!surface.flat_faces) {
        surface.flat_faces = count_in_file(surface.tin, surface.is_water_face, surface.metadata);
    }
    QualityReport quality;
    run_with_threads(triangulation.threads, [&] {
        quality = assess_quality(surface.tin, kWorstFaces, surface.ground, surface.z_factor);
    });
    if (surface.crs.unit() != "metre") {
        warn_of_slopes(surface, console);  // feet and metres are easily mixed
    }
    console.progress().finish();

    JobReport report;
    report.command = "info";
    report.tells_slopes = true;
    report.domain = is_tin ? "as in the TIN" : triangulation.domain_name();
    report.duplicate_policy = triangulation.policy_name();
    if (talk.json) {
        JsonValue json = make_json(report, surface);
        add_content_json(json, surface);
        add_quality_json(json, surface, quality);
        print_result(json.text());
    } else {
        print_result(report_text(report, surface, {true, talk.verbose}) + content_text(surface) +
                     quality_text(surface, quality));
    }
    return Outcome::Done;
}

}  // namespace tinwright::tools
