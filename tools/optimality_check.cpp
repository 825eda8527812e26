#include "optimality_check.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/optimal/data_dependent.hpp"

#include "criterion_report.hpp"
#include "option_values.hpp"
#include "options_triangulation.hpp"

namespace tinwright::tools {

namespace {

constexpr std::size_t kUsualFaces = 100;
constexpr std::size_t kUsualReach = 100;
constexpr const char* kNormIsForLength = "--norm says how edges are measured: it is for --criterion length";

constexpr auto kCriterionChoices =
    std::to_array<std::pair<std::string_view, Criterion>>({{"slope", Criterion::Slope},
                                                           {"height", Criterion::Height},
                                                           {"angle", Criterion::Angle},
                                                           {"eccentricity", Criterion::Eccentricity},
                                                           {"length", Criterion::Length}});

bool is_heuristic(const std::string& criterion) {
    return std::any_of(kCreaseMeasures.begin(), kCreaseMeasures.end(),
                       [&criterion](const auto& named) { return named.first == criterion; });
}

std::string counted(std::size_t count, const std::string& singular) {
    return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

std::string measure_text(Criterion criterion, double value) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data() + std::string(criterion_traits(criterion).unit == MeasureUnit::Degree ? " deg" : "");
}

bool promises_worst_only(const std::string& scope) { return scope == "max" || scope.starts_with("top:"); }

/// How many faces, up to a hundred, are beyond the value of scope `above`; a hundred for another scope.
/// `factor`: see `told_factor`.
std::size_t count_beyond(const Tin& tin, Criterion criterion, const std::string& scope, double factor) {
    constexpr std::string_view kAbove = "above:";
    const std::optional<double> stop =
        scope.starts_with(kAbove) ? find_number(scope.substr(kAbove.size())) : std::nullopt;
    if (!stop) {
        return kUsualFaces;
    }
    const bool is_greater_better = criterion_traits(criterion).is_greater_better;
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count() && count < kUsualFaces; ++f) {
        if (tin.mesh.is_terrain({f})) {
            const double measure = factor * measure_face(tin, {f}, criterion);
            count += (is_greater_better ? measure < *stop : measure > *stop) ? 1U : 0U;
        }
    }
    return count;
}

/// `factor`: see `told_factor`.
void tell_measures(Certificate& certificate, double factor) {
    certificate.worst.all *= factor;
    if (certificate.worst.interior) {
        *certificate.worst.interior *= factor;
    }
    for (Improvement& improvement : certificate.improvements) {
        improvement.measure *= factor;
        improvement.improved *= factor;
    }
}

/// "the 100 worst of 5998 faces", "the worst of 5998 faces", "5998 faces".
std::string examined_text(const OptimalityReport& report) {
    const std::size_t count = report.certificate.faces;
    if (count == report.faces) {
        return counted(count, "face");
    }
    return "the " + (count == 1 ? std::string() : std::to_string(count) + " ") + "worst of " +
           counted(report.faces, "face");
}

/// What the file promises, as far as it is less than everything.
std::string promise_text(const OptimalityReport& report) {
    if (report.is_unfinished) {
        return "; the file says that it was not finished";
    }
    if (promises_worst_only(report.scope)) {
        return "; --scope " + report.scope + " promises " +
               (report.scope == "max" ? "the worst face only" : "its worst faces only");
    }
    if (report.scope.starts_with("above:")) {
        return "; --scope " + report.scope + " promises the faces beyond that only";
    }
    if (report.scope.empty() && report.improvable() > 0) {
        return "; the file does not tell that it was made for this criterion";
    }
    return {};
}

JsonValue location_json(const Point3& p) { return JsonValue::array_of({p.x, p.y, p.z}); }

}  // namespace

void OptimalityOptions::add_to(CLI::App& parser) {
    add_value(parser, "--criterion", criterion_text, "NAME", "prove again: slope|height|angle|length|...");
    add_value(parser, "--norm", norm_text, "NORM", "of length (default: as the file says, or l2)");
    add_value(parser, "--worst", worst_text, "COUNT", "for so many of the worst faces (default 100)");
    parser.add_flag("--all", all, "for all faces; for length: polygons of any size");
    add_value(parser, "--reach", reach_text, "FACES", "by edges across so many, or all (default 100)");
}

void OptimalityOptions::finish() {
    if (!norm_text.empty() && criterion_text.empty()) {
        throw UsageError(kNormIsForLength);
    }
    const auto need_criterion = [this](bool is_given, const std::string& option) {
        if (is_given && criterion_text.empty()) {
            throw UsageError(option +
                             " is for --criterion: say which, slope, height, angle, eccentricity or length");
        }
    };
    need_criterion(!worst_text.empty(), "--worst");
    need_criterion(all, "--all");
    need_criterion(!reach_text.empty(), "--reach");
    if (all && !worst_text.empty()) {
        throw UsageError("--worst and --all exclude each other");
    }
    criterion.reset();
    worst.reset();
    reach = kUsualReach;
    if (is_heuristic(criterion_text)) {
        throw UsageError("--criterion " + criterion_text +
                         " makes a TIN by a heuristic, of which there is nothing to prove; slope, height, "
                         "angle, eccentricity and length can be proven");
    }
    if (!criterion_text.empty()) {
        criterion = choice_value("--criterion", criterion_text, kCriterionChoices);
        refuse_others_options();
    }
    norm = norm_text.empty() ? std::nullopt : std::optional(norm_value(norm_text));
    if (!worst_text.empty()) {
        worst = static_cast<std::size_t>(whole_value("--worst", worst_text, 1));
    }
    if (reach_text == "all") {
        reach.reset();
    } else if (!reach_text.empty()) {
        // An edge that crosses fewer faces than two crosses none.
        reach = static_cast<std::size_t>(whole_value("--reach (unless all)", reach_text, 2));
    }
}

void OptimalityOptions::refuse_others_options() const {
    if (criterion != Criterion::Length && !norm_text.empty()) {
        throw UsageError(kNormIsForLength);
    }
    if (criterion == Criterion::Length && !(worst_text.empty() && reach_text.empty())) {
        throw UsageError(
            std::string(worst_text.empty() ? "--reach" : "--worst") +
            " does not apply to --criterion length, which is about the longest edge; --all looks "
            "at polygons of any size");
    }
}

OptimalityReport check_optimality(const io::TinFile& file, const OptimalityOptions& options,
                                  const Progress& progress, double z_factor) {
    const Tin tin = io::make_tin(file);
    OptimalityReport report;
    report.criterion = *options.criterion;
    report.faces = file.face_ids.size();
    if (report.criterion == Criterion::Length) {
        const LengthCheck& length =
            report.length.emplace(check_length(file, tin, {options.norm, options.all}, progress));
        if (length.is_improvable()) {
            report.listed.push_back({length.face, length.from, length.to, length.certificate.longest,
                                     *length.certificate.attainable});
        }
        return report;
    }
    const CriterionReport made = read_criterion_report(file.metadata);
    if (made.name == criterion_traits(report.criterion).name) {
        report.scope = made.scope;
        report.is_unfinished = made.stopped_by == "budget" || made.stopped_by == "interrupt";
    }
    report.reach = options.reach;
    const double factor = told_factor(report.criterion, z_factor);
    CertificateOptions certificate;
    certificate.criterion = report.criterion;
    certificate.faces = options.all ? std::nullopt
                        : options.worst
                            ? options.worst
                            : std::optional(count_beyond(tin, report.criterion, report.scope, factor));
    const bool is_free = !options.all && !options.worst;
    certificate.until_improvable = is_free && promises_worst_only(report.scope);
    certificate.reach = options.reach;
    certificate.progress = progress;
    report.certificate = certify(tin, certificate);
    tell_measures(report.certificate, factor);
    if (certificate.until_improvable && report.improvable() > 0 && report.certificate.faces > 1) {
        report.is_next_improvable = true;
        report.certificate.improvements.clear();
        --report.certificate.faces;
    }
    // The mesh keeps the faces in the file's order; ghosts follow.
    for (const Improvement& improvement : report.certificate.improvements) {
        if (report.listed.size() < OptimalityReport::kListed) {
            report.listed.push_back({file.face_ids[improvement.face.value], tin.position(improvement.anchor),
                                     tin.position(improvement.apex), improvement.measure,
                                     improvement.improved});
        }
    }
    return report;
}

std::string optimality_verdict(const OptimalityReport& report) {
    if (report.length) {
        return length_verdict(*report.length);
    }
    const Certificate& certificate = report.certificate;
    std::string text = std::string(criterion_traits(report.criterion).name) + ": ";
    const bool is_cut = certificate.cut > 0 && report.reach;
    if (certificate.faces == 0) {
        text += "no face to be examined";
    } else if (report.improvable() > 0) {
        text += (certificate.faces == 1 ? "" : std::to_string(report.improvable()) + " of ") +
                examined_text(report) + " can be improved";
    } else {
        text += (certificate.faces == report.faces && report.faces > 1
                     ? "none of the " + examined_text(report) + " can be improved"
                     : examined_text(report) + " cannot be improved") +
                (is_cut ? " by edges across up to " + counted(*report.reach, "face") : std::string()) +
                (report.is_next_improvable ? ", the next one can" : "");
    }
    text += " (" + counted(certificate.edges, "edge") + " tried";
    if (is_cut) {
        text += ", " + counted(certificate.cut, "view") + " cut off";
    }
    text += "); worst " + measure_text(report.criterion, certificate.worst.all);
    if (certificate.worst.interior) {
        text += ", worst interior " + measure_text(report.criterion, *certificate.worst.interior);
    }
    return text + promise_text(report);
}

std::string improvable_lines(const OptimalityReport& report, const std::string& file) {
    if (report.length) {
        return length_line(*report.length, file);
    }
    const std::string measure(criterion_traits(report.criterion).measure);
    std::string lines;
    for (const ImprovableFace& face : report.listed) {
        lines += file + ": face " + std::to_string(face.face) + ": " + measure + " " +
                 measure_text(report.criterion, face.measure) + ", " +
                 measure_text(report.criterion, face.improved) + " with an edge from " +
                 location_text({face.from.x, face.from.y}) + " to " + location_text({face.to.x, face.to.y}) +
                 "\n";
    }
    const std::size_t unlisted = report.improvable() - report.listed.size();
    return unlisted == 0
               ? lines
               : lines + file + ": and " + counted(unlisted, "more face") + " that can be improved\n";
}

JsonValue optimality_json(const OptimalityReport& report) {
    if (report.length) {
        return length_json(*report.length);
    }
    const Certificate& certificate = report.certificate;
    JsonValue listed = JsonValue::array();
    for (const ImprovableFace& face : report.listed) {
        listed.append(JsonValue::object()
                          .set("face", face.face)
                          .set("measure", face.measure)
                          .set("improved", face.improved)
                          .set("from", location_json(face.from))
                          .set("to", location_json(face.to)));
    }
    JsonValue json = JsonValue::object();
    json.set("criterion", std::string(criterion_traits(report.criterion).name));
    if (!report.scope.empty()) {
        json.set("scope", report.scope);
    }
    json.set("worst", certificate.worst.all);
    if (certificate.worst.interior) {
        json.set("worst_interior", *certificate.worst.interior);
    }
    json.set("examined", certificate.faces)
        .set("anchorless", certificate.anchorless)
        .set("edges_tried", certificate.edges);
    if (report.reach) {
        json.set("reach", *report.reach);
    }
    return json.set("views_cut_off", certificate.cut)
        .set("next_improvable", report.is_next_improvable)
        .set("improvable", report.improvable())
        .set("improvable_faces", listed);
}

}  // namespace tinwright::tools
