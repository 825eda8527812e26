#include "command_check.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_tin.hpp"

#include "checked_lines.hpp"
#include "checked_surface.hpp"
#include "conflict_layer.hpp"
#include "console.hpp"
#include "repair.hpp"
#include "written_places.hpp"

namespace tinwright::tools {

namespace {

constexpr double kTinShare = 0.5;  // of the progress, where there are TINs and lines

/// What was done about a conflict by repairing; what is left is in another list.
LineConflict::Action repair_action(LineConflict::Kind kind) {
    using Kind = LineConflict::Kind;
    using Action = LineConflict::Action;
    switch (kind) {
        case Kind::Crossing:
        case Kind::SelfCrossing:
        case Kind::Touch:
            return Action::Noded;
        case Kind::Overlap:
        case Kind::Duplicate:
        case Kind::ZeroLength:
            return Action::Merged;
        case Kind::Spike:
            return Action::Dropped;
        case Kind::NearMiss:
        case Kind::OpenRing:
            return Action::Snapped;
        case Kind::ElevationClash:
        case Kind::MissingZ:
            return Action::Chosen;
        default:
            return Action::Reported;
    }
}

/// Says of each conflict what the repair did; a conflict that is still there was only reported.
void note_actions(std::vector<LineConflict>& found, const std::vector<LineConflict>& left) {
    using Place = std::tuple<LineConflict::Kind, double, double>;
    const auto place_of = [](const LineConflict& conflict) {
        return Place(conflict.kind, conflict.location.x, conflict.location.y);
    };
    std::set<Place> still_there;
    std::transform(left.begin(), left.end(), std::inserter(still_there, still_there.end()), place_of);
    for (LineConflict& conflict : found) {
        conflict.action = still_there.contains(place_of(conflict)) ? LineConflict::Action::Reported
                                                                   : repair_action(conflict.kind);
    }
}

JsonValue check_json(const std::vector<CheckedSurface>& surfaces, bool is_proving, const CheckedLines* lines,
                     const std::vector<std::string>& outputs) {
    JsonValue list = JsonValue::array();
    std::size_t violations = 0;
    std::size_t improvable = 0;
    for (const CheckedSurface& surface : surfaces) {
        list.append(surface_json(surface));
        violations += surface.violation_count();
        improvable += surface.improvable();
    }
    JsonValue json = JsonValue::object();
    json.set("version", TINWRIGHT_VERSION).set("command", "check");
    json.set("clean", violations == 0 && (lines == nullptr || lines->found() == 0));
    json.set("violations", violations);
    if (is_proving) {
        json.set("improvable", improvable);
    }
    if (lines != nullptr) {
        json.set("conflicts", lines->remaining().conflicts.size());
    }
    json.set("surfaces", list);
    if (lines != nullptr) {
        json.set("lines", lines_json(*lines));
    }
    return json.set("outputs", JsonValue::array_of(outputs));
}

}  // namespace

void CommandCheck::setup(const std::vector<std::string>& arguments) {
    const auto parser =
        make_parser("check", "Audits TINs, lines and samples; lists what is wrong, and repairs lines.",
                    "SOURCE... [-o FILE] [options]",
                    {"tinwright check tin.gpkg --criterion slope",
                     "tinwright check survey.csv roads.gpkg --boundary site.gpkg -o found.gpkg",
                     "tinwright check roads.gpkg --repair -o clean"});
    sources.add_to(*parser);
    lines.add_sources_to(*parser);
    audit.add_to(*parser);
    crs.add_to(*parser);
    optimality.add_to(*parser);
    output.add_to(*parser, "write what is found as points, or the folder",
                  "output driver (default: from the extension)");
    talk.add_to(*parser);
    parse_options(*parser, arguments);

    check_key_values("--oo", sources.open_options);
    lines.finish(sources.open_options);
    crs.finish();
    crs.plane.takes_best = !crs.plane.is_limit_given;  // faults are looked for wherever they are
    if (!sources.texts.empty() || lines.sources.empty()) {
        sources.finish();
    }
    audit.finish();
    optimality.finish();
    if (audit.repair && output.path.empty()) {
        throw UsageError("--repair needs a folder for the repaired lines: name it with -o FOLDER");
    }
    if (audit.repair && !output.driver.empty()) {
        throw UsageError("--of does not go with --repair, which writes GeoPackages");
    }
    output.finish(false);
    talk.finish(output.is_stdout());
}

CommandCheck::Sorted CommandCheck::sort_sources() const {
    Sorted sorted;
    for (const io::Source& source : sources.sources) {
        if (io::is_tin(source)) {
            sorted.tins.push_back(source);
        } else if (io::has_lines(source)) {
            sorted.lines.push_back({source, LineRole::Breakline});
        } else {
            sorted.samples.push_back(source);
        }
    }
    sorted.lines.insert(sorted.lines.end(), lines.sources.begin(), lines.sources.end());
    if (audit.repair && sorted.lines.empty()) {
        throw UsageError("--repair is for lines, and none of the sources has any");
    }
    if (optimality.criterion && sorted.tins.empty()) {
        throw UsageError("--criterion is for TINs, and none of the sources is one");
    }
    return sorted;
}

std::vector<io::Source> CommandCheck::all_sources() const {
    std::vector<io::Source> all = sources.sources;
    for (const io::LineSource& source : lines.sources) {
        all.push_back(source.source);
    }
    return all;
}

CommandCheck::Targets CommandCheck::choose_targets(const Sorted& sorted) const {
    Targets targets;
    targets.conflicts = audit.conflicts;
    const bool has_lines = !sorted.lines.empty() || !sorted.samples.empty();
    if (audit.repair) {
        targets.folder = output.path;
    } else if (!output.path.empty() && sorted.tins.empty() && audit.conflicts.empty()) {
        targets.conflicts = output.path;
    } else if (!output.path.empty() && sorted.tins.empty()) {
        throw UsageError("-o and --conflicts both name a file for the conflicts: give one of them");
    } else if (!output.path.empty() && has_lines && audit.conflicts.empty()) {
        throw UsageError("-o " + io::quoted(output.path) +
                         " is for what is wrong with TINs: give --conflicts FILE for lines and samples too");
    } else {
        targets.violations = output.path;
    }
    if (!targets.conflicts.empty() && !has_lines) {
        throw UsageError("--conflicts is for lines and samples, and all of the sources are TINs");
    }
    const std::vector<io::Source> read = all_sources();
    for (const std::string& target : {targets.violations, targets.conflicts}) {
        if (!target.empty()) {
            refuse_to_overwrite_sources(target, read);
            check_conflict_target(target, output.driver);
            check_output_place(target, output.overwrite);
        }
    }
    return targets;
}

io::OutputPositions CommandCheck::choose_output(CheckedLines& checked) const {
    const io::WorkingPlane& plane =
        checked.samples.crs.is_known() ? checked.samples.plane : checked.lines.plane;
    checked.output_crs = audit_crs(crs, plane);
    return positions_of(checked.lines, checked.samples, plane.crs, checked.output_crs);
}

CheckedLines CommandCheck::check_lines_and_samples(const Sorted& sorted, const Targets& targets,
                                                   Console& console, std::vector<std::string>& outputs) {
    const double begin = sorted.tins.empty() ? 0 : kTinShare;
    const auto share = [&](double of_rest) { return begin + (1 - begin) * of_rest; };
    CheckedLines checked;
    if (!sorted.samples.empty()) {
        io::ReadOptions options;
        options.skip_bad = true;
        crs.apply_to(options);
        options.threads = 0;
        options.progress = console.progress().stage(share(0), share(0.4));
        checked.samples = io::read_samples(sorted.samples, options);
    }
    if (!sorted.lines.empty()) {
        io::ReadLinesOptions options;
        options.keep_faults = true;
        crs.apply_to(options, checked.samples);
        options.progress = console.progress().stage(share(0.4), share(0.5));
        checked.lines = io::read_lines(sorted.lines, options);
    }
    for (const auto* const warnings : {&checked.samples.warnings, &checked.lines.warnings}) {
        for (const std::string& warning : *warnings) {
            console.warn(warning);
        }
    }
    if (audit.repair) {
        repair(checked, sorted, targets, console, outputs);
    } else {
        LineCheckOptions options = audit.check;
        options.traits = traits_of(checked.lines);
        options.progress = console.progress().stage(share(0.5), 1);
        checked.report = check_lines(checked.lines.lines, checked.samples.points, options);
    }
    const io::OutputPositions positions = choose_output(checked);
    bring_to(positions, checked.report.conflicts);
    if (checked.left) {
        bring_to(positions, checked.left->conflicts);
    }
    if (!targets.conflicts.empty()) {
        write_conflicts(checked.report.conflicts, {checked.lines, checked.samples}, checked.output_crs,
                        targets.conflicts, output.overwrite, output.driver)
            ->commit();
        outputs.push_back(targets.conflicts);
    }
    return checked;
}

void CommandCheck::repair(CheckedLines& checked, const Sorted& sorted, const Targets& targets,
                          Console& console, std::vector<std::string>& outputs) {
    const RepairPlan plan = plan_repair(checked.lines, targets.folder, output.overwrite, all_sources());
    LineRepairOptions options;
    options.check = audit.check;
    options.check.traits = traits_of(checked.lines);
    options.crossing_z = audit.crossing_z;
    LineRepair repaired = repair_lines_on_samples(checked.lines, checked.samples, options);
    note_actions(repaired.found.conflicts, repaired.left.conflicts);
    bring_to(choose_output(checked), repaired.lines);
    OutputFolder folder(targets.folder);
    for (const std::string& written : write_repair(repaired.lines, checked.lines, sorted.lines, plan,
                                                   checked.output_crs, output.overwrite)) {
        console.say("tinwright check: wrote " + written + "\n");
    }
    folder.keep();
    for (const RepairPlan::File& file : plan.files) {
        outputs.push_back(file.target);
    }
    checked.report = std::move(repaired.found);
    checked.left = std::move(repaired.left);
    checked.crossing_z = audit.policy_name();
}

Outcome CommandCheck::run() {
    Console console("check", talk);
    const Sorted sorted = sort_sources();
    const Targets targets = choose_targets(sorted);
    const ViolationLayerOptions layer_options{output.driver, output.overwrite};
    const bool has_lines = !sorted.lines.empty() || !sorted.samples.empty();

    std::vector<CheckedSurface> surfaces;
    std::size_t found = 0;
    const double share =
        (has_lines ? kTinShare : 1.0) / static_cast<double>(std::max<std::size_t>(1, sorted.tins.size()));
    for (const io::Source& source : sorted.tins) {
        const double begin = share * static_cast<double>(surfaces.size());
        surfaces.push_back(check_surface(source, crs, optimality, console.progress(), begin, begin + share));
        found += surfaces.back().violation_count() + surfaces.back().improvable();
    }
    std::vector<std::string> outputs;
    if (!targets.violations.empty()) {
        write_violations(surfaces, targets.violations, layer_options);
        outputs.push_back(targets.violations);
    }
    std::optional<CheckedLines> checked;
    if (has_lines) {
        checked = check_lines_and_samples(sorted, targets, console, outputs);
        found += checked->found();
    }
    console.progress().finish();

    std::string list;
    for (const CheckedSurface& surface : surfaces) {
        list += violation_lines(surface);
        for (const std::string& verdict : verdicts(surface, optimality)) {
            console.say("tinwright check: " + verdict + "\n");
        }
    }
    if (checked) {
        list += conflict_lines(*checked);
        console.say("tinwright check: " + lines_verdict(*checked) + "\n");
        if (checked->left) {
            console.say("tinwright check: " + repair_verdict(*checked) + "\n");
        }
    }
    if (talk.json) {
        print_result(
            check_json(surfaces, optimality.criterion.has_value(), checked ? &*checked : nullptr, outputs)
                .text());
    } else if (!output.is_stdout()) {
        print_result(list);
    }
    return found == 0 ? Outcome::Done : Outcome::ViolationsFound;
}

}  // namespace tinwright::tools
