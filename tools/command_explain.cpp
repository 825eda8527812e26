#include "command_explain.hpp"

#include <variant>

#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "console.hpp"
#include "explanation.hpp"
#include "job_report.hpp"
#include "sample_queries.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

void CommandExplain::take_coordinate() {
    std::vector<std::string>& texts = sources.texts;
    if (sample.at_texts.empty() && !texts.empty() && find_coordinate(texts.back())) {
        sample.at_texts.push_back(texts.back());
        texts.pop_back();
    }
    if (sample.at_texts.size() > 1) {
        throw UsageError("one place is explained at a time: give X,Y once");
    }
    if (sample.at_texts.empty()) {
        throw UsageError("no place is given: name it as X,Y after the sources");
    }
    if (!find_coordinate(sample.at_texts.front())) {
        throw UsageError("a place is two numbers X,Y, not " + io::quoted(sample.at_texts.front()));
    }
}

void CommandExplain::setup(const std::vector<std::string>& arguments) {
    const auto parser = make_parser(
        "explain", "Tells why a surface is as it is at one place.", "SOURCE... X,Y [options]",
        {"tinwright explain survey.csv 3500120,5402310", "tinwright explain tin.gpkg -12.5,40 --json"});
    sources.add_to(*parser);
    sources.add_skip_bad_to(*parser);
    add_repeatable(*parser, "--at", sample.at_texts, "X,Y", "the place, instead of after the sources");
    sample.add_slope_unit_to(*parser);
    interpolation.add_to(*parser);
    lines.add_all_sources_to(*parser);
    triangulation.add_to(*parser, "trimmed");
    lines.add_constraints_to(*parser);
    lines.add_fitting_to(*parser);
    crs.add_to(*parser);
    triangulation.add_threads_to(*parser);
    talk.add_to(*parser);
    parse_options(*parser, rewrite_coordinates(arguments));

    take_coordinate();
    crs.finish();
    sources.finish(lines.has_breaklines());
    lines.finish(sources.open_options);
    sample.finish({});
    at = std::get<Point2>(sample.at.front());
    interpolation.finish();
    triangulation.finish(DomainRule::Kind::Trimmed);
    talk.finish(false);
}

Outcome CommandExplain::run() {
    Console console("explain", talk);
    const SurfaceRequest request{.sources = sources,
                                 .crs = crs,
                                 .triangulation = triangulation,
                                 .lines = &lines,
                                 .keep_origins = true,
                                 .keep_ids = true,
                                 .progress_end = 0.8};
    const bool is_tin = is_existing_tin(request);
    const Surface surface =
        is_tin ? read_existing_tin(request, console) : triangulate_sources(request, console);
    if (surface.crs.unit() != "metre") {
        warn_of_slopes(surface, console);  // feet and metres are easily mixed
    }
    const io::Crs place_crs = surface.place_crs(crs);
    const ExplainOptions options{at,
                                 place_in_plane(at, place_crs, surface.crs),
                                 place_crs,
                                 interpolation,
                                 sample.slope_unit,
                                 triangulation.threads};
    Explanation explanation;
    run_with_threads(triangulation.threads, [&] { explanation = explain(surface, options); });
    if (surface.conflicts) {
        surface.conflicts->commit();
    }
    console.progress().finish();
    if (!talk.json) {
        print_result(explanation_text(explanation, surface, options));
        return Outcome::Done;
    }
    JobReport job;
    job.command = "explain";
    job.domain = is_tin ? "as in the TIN" : triangulation.domain_name();
    job.duplicate_policy = triangulation.policy_name();
    print_result(
        make_json(job, surface).set("explanation", explanation_json(explanation, surface, options)).text());
    return Outcome::Done;
}

}  // namespace tinwright::tools
