#include "checked_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "tinwright/geometry/decimal.hpp"

#include "conflict_layer.hpp"
#include "part_names.hpp"

namespace tinwright::tools {

namespace {

using Kind = LineConflict::Kind;

constexpr std::size_t kListed = 1000;  // of each kind

struct Phrase {
    const char* alone;  ///< of one line, or of a line with itself
    const char* with;   ///< stands before the other one's name
    const char* after;  ///< stands behind it
};

/// By the kind's value.
constexpr std::array<Phrase, LineConflict::kKinds> kPhrases = {
    {{"crosses itself", "crosses ", ""},
     {"crosses itself", "", ""},
     {"touches itself", "touches ", " without a common point"},
     {"runs along itself", "runs along ", ""},
     {"is there twice", "is there again as ", ""},
     {"has a part without length", "", ""},
     {"has ends that nearly meet", "nearly meets ", ""},
     {"has two elevations at one location", "has another elevation than ", ""},
     {"", "has another elevation than ", " on it"},
     {"", "is close to ", ""},
     {"is draped beyond the samples", "", ""},
     {"is outside the boundary", "", ""},
     {"ends just short of itself", "ends just short of ", ""},
     {"turns back on itself", "", ""},
     {"has no z", "", ""},
     {"is a ring that is not closed", "", ""}}};

std::string z_text(const LineConflict& conflict) {
    const bool has_a = !std::isnan(conflict.z_a);
    const bool has_b = !std::isnan(conflict.z_b);
    if (has_a && has_b) {
        return ", z " + decimal_text(rounded(conflict.z_a)) + " and " + decimal_text(rounded(conflict.z_b));
    }
    return has_a || has_b ? ", z " + decimal_text(rounded(has_a ? conflict.z_a : conflict.z_b))
                          : std::string();
}

std::string text_of(const LineConflict& conflict, const PartNames& names) {
    const Phrase& phrase = kPhrases[static_cast<std::size_t>(conflict.kind)];
    const bool has_line = conflict.line_a != LineConflict::kNone;
    std::optional<std::string> other;
    if (conflict.sample != LineConflict::kNone) {
        other = names.of_sample(conflict.sample);
    } else if (conflict.line_b != LineConflict::kNone && conflict.line_b != conflict.line_a) {
        other = names.of_line(conflict.line_b);
    }
    const std::string subject =
        has_line ? names.of_line(conflict.line_a) : names.of_sample(conflict.other_sample);
    return subject + " " + (other ? phrase.with + *other + phrase.after : std::string(phrase.alone)) +
           " at " + location_text({rounded(conflict.location.x), rounded(conflict.location.y)}) +
           z_text(conflict) + "\n";
}

/// Of each kind, the number of conflicts beyond those that are listed.
ConflictCounts unlisted(const LineCheckReport& report) {
    ConflictCounts counts = count_conflicts(report.conflicts);
    for (std::size_t& count : counts) {
        count -= std::min(count, kListed);
    }
    return counts;
}

/// Calls `visit` for the conflicts that are listed. They come by kind.
template <class Visit>
void for_each_listed(const LineCheckReport& report, const Visit& visit) {
    std::size_t of_kind = 0;
    for (std::size_t i = 0; i < report.conflicts.size(); ++i) {
        of_kind = i > 0 && report.conflicts[i].kind == report.conflicts[i - 1].kind ? of_kind + 1 : 0;
        if (of_kind < kListed) {
            visit(report.conflicts[i]);
        }
    }
}

std::string count_text(std::size_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

JsonValue number_json(double value) { return std::isnan(value) ? JsonValue() : JsonValue(value); }

void set_line(JsonValue& json, const std::string& side, const CheckedLines& checked, std::uint32_t line) {
    const io::LineSlice& slice = checked.lines.slice_of(line);
    const io::LinePart& part = checked.lines.parts[line];
    json.set("source_" + side, slice.file).set("layer_" + side, slice.layer);
    json.set("feature_" + side, part.feature).set("part_" + side, part.part);
}

void set_sample(JsonValue& json, const std::string& side, const CheckedLines& checked, std::uint32_t sample) {
    const io::SampleSlice* const slice = checked.samples.find_slice(sample);
    if (slice != nullptr) {
        json.set("source_" + side, slice->file).set("layer_" + side, slice->layer);
        json.set("feature_" + side, slice->id(sample - slice->first));
    }
}

JsonValue conflict_json(const LineConflict& conflict, const CheckedLines& checked) {
    JsonValue json = JsonValue::object();
    json.set("kind", conflict_key(conflict.kind));
    if (conflict.line_a != LineConflict::kNone) {
        set_line(json, "a", checked, conflict.line_a);
    } else {
        set_sample(json, "a", checked, conflict.other_sample);
    }
    if (conflict.line_b != LineConflict::kNone) {
        set_line(json, "b", checked, conflict.line_b);
    } else {
        set_sample(json, "b", checked, conflict.sample);
    }
    json.set("location", JsonValue::array_of({conflict.location.x, conflict.location.y}));
    return json.set("z_a", number_json(conflict.z_a)).set("z_b", number_json(conflict.z_b));
}

void set_conflicts(JsonValue& json, const LineCheckReport& report, const CheckedLines& checked) {
    const ConflictCounts all = count_conflicts(report.conflicts);
    JsonValue counts = JsonValue::object();
    for (std::size_t i = 0; i < all.size(); ++i) {
        counts.set(conflict_key(static_cast<Kind>(i)), all[i]);
    }
    JsonValue conflicts = JsonValue::array();
    for_each_listed(
        report, [&](const LineConflict& conflict) { conflicts.append(conflict_json(conflict, checked)); });
    json.set("counts", counts).set("conflicts", conflicts);
}

/// "2 crossings, 1 that cannot be read"; empty when there is nothing.
std::string found_text(const LineCheckReport& report, std::size_t unusable) {
    std::string text = conflict_counts_text(count_conflicts(report.conflicts));
    if (unusable > 0) {
        text += (text.empty() ? "" : ", ") + std::to_string(unusable) + " that cannot be read";
    }
    return text;
}

}  // namespace

std::size_t CheckedLines::unusable() const {
    std::size_t count = lines.faults.size();
    for (const io::SampleSlice& slice : samples.slices) {
        count += slice.skipped;
    }
    return count;
}

std::vector<LineTraits> traits_of(const io::Lines& lines) {
    std::vector<LineTraits> traits;
    for (std::size_t i = 0; i < lines.lines.size(); ++i) {
        traits.push_back({lines.parts[i].is_ring, lines.lines[i].polygon, !lines.parts[i].lacks_z});
    }
    return traits;
}

std::string conflict_lines(const CheckedLines& checked) {
    const PartNames names(checked.lines, checked.samples);
    std::string list;
    for (const io::FeatureFault& fault : checked.lines.faults) {
        const auto slice =
            std::find_if(checked.lines.slices.begin(), checked.lines.slices.end(),
                         [&](const io::LineSlice& candidate) { return candidate.source == fault.source; });
        list += names.of_feature(slice->file, fault.layer, fault.feature) + " " + fault.what + "\n";
    }
    for_each_listed(checked.remaining(),
                    [&](const LineConflict& conflict) { list += text_of(conflict, names); });
    const std::string more = conflict_counts_text(unlisted(checked.remaining()));
    return more.empty() ? list : list + "and " + more + " more\n";
}

std::string lines_verdict(const CheckedLines& checked) {
    std::string what;
    if (!checked.lines.slices.empty()) {
        what = count_text(checked.lines.lines.size(), "line");
    }
    if (!checked.samples.slices.empty()) {
        what += (what.empty() ? "" : " and ") + count_text(checked.samples.points.size(), "sample");
    }
    const std::string found = found_text(checked.report, checked.unusable());
    return what + ": " + (found.empty() ? "clean" : found);
}

std::string repair_verdict(const CheckedLines& checked) {
    const std::string found = found_text(checked.remaining(), checked.unusable());
    return "repaired, z where lines meet: " + checked.crossing_z +
           "; left: " + (found.empty() ? "nothing" : found);
}

JsonValue lines_json(const CheckedLines& checked) {
    JsonValue json = JsonValue::object();
    json.set("lines", checked.lines.lines.size()).set("samples", checked.samples.points.size());
    json.set("unusable", checked.unusable());
    json.set("snap", checked.report.snap).set("dangling", checked.report.dangling);
    set_conflicts(json, checked.report, checked);
    if (checked.left) {
        JsonValue repair = JsonValue::object();
        repair.set("crossing_z", checked.crossing_z);
        set_conflicts(repair, *checked.left, checked);
        json.set("repair", repair);
    }
    return json;
}

}  // namespace tinwright::tools
