#include "conflict_layer.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "tinwright/geometry/decimal.hpp"

#include "point_layer.hpp"

namespace tinwright::tools {

namespace {

struct KindNames {
    const char* key;
    const char* one;
    const char* many;
};

/// By the kind's value.
constexpr std::array<KindNames, LineConflict::kKinds> kKindNames = {
    {{"crossing", "crossing", "crossings"},
     {"self_crossing", "self-crossing", "self-crossings"},
     {"touch", "touch", "touches"},
     {"overlap", "overlap", "overlaps"},
     {"duplicate", "duplicate line", "duplicate lines"},
     {"zero_length", "part without length", "parts without length"},
     {"near_miss", "near miss", "near misses"},
     {"elevation_clash", "clash of elevations", "clashes of elevations"},
     {"sample_on_line", "sample on a line", "samples on lines"},
     {"sample_near_line", "sample near a line", "samples near lines"},
     {"outside_samples", "point outside the samples", "points outside the samples"},
     {"outside_boundary", "line outside the boundary", "lines outside the boundary"},
     {"dangling", "dangling end", "dangling ends"},
     {"spike", "spike", "spikes"},
     {"missing_z", "line without z", "lines without z"},
     {"open_ring", "open ring", "open rings"}}};

constexpr std::array<const char*, 7> kActionNames = {"noded",  "merged",  "dropped", "snapped",
                                                     "chosen", "clamped", "reported"};

/// A source as it would be written on the command line, and the feature in it.
struct Side {
    std::optional<std::string> source;
    std::optional<std::int64_t> feature;
};

std::string source_text(const std::string& file, const std::string& layer) {
    return layer.empty() ? file : file + ",layer=" + layer;
}

Side side_of_line(std::uint32_t line, const io::Lines& lines) {
    if (line >= lines.lines.size()) {
        return {};
    }
    const io::LineSlice& slice = lines.slice_of(line);
    return {source_text(slice.file, slice.layer), lines.parts[line].feature};
}

Side side_of_sample(std::uint32_t sample, const io::Samples& samples) {
    const io::SampleSlice* const slice = samples.find_slice(sample);
    if (slice == nullptr) {
        return {};
    }
    const bool is_layer = slice->kind == io::SampleSlice::Kind::Vector;
    return {source_text(slice->file, is_layer ? slice->layer : std::string()),
            slice->id(sample - slice->first)};
}

/// Of a conflict: the lines, else the samples.
std::array<Side, 2> sides_of(const LineConflict& conflict, const ConflictOrigins& origins) {
    std::array<Side, 2> sides;
    sides[0] = conflict.line_a != LineConflict::kNone
                   ? side_of_line(conflict.line_a, origins.lines)
                   : side_of_sample(conflict.other_sample, origins.samples);
    sides[1] = conflict.line_b != LineConflict::kNone ? side_of_line(conflict.line_b, origins.lines)
                                                      : side_of_sample(conflict.sample, origins.samples);
    return sides;
}

std::optional<double> known(double z) { return std::isfinite(z) ? std::optional(z) : std::nullopt; }

}  // namespace

std::string conflict_key(LineConflict::Kind kind) { return kKindNames[static_cast<std::size_t>(kind)].key; }

std::string action_key(LineConflict::Action action) { return kActionNames[static_cast<std::size_t>(action)]; }

std::string conflict_counts_text(const ConflictCounts& counts) {
    std::string text;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) {
            text += (text.empty() ? "" : ", ") + std::to_string(counts[i]) + " " +
                    (counts[i] == 1 ? kKindNames[i].one : kKindNames[i].many);
        }
    }
    return text;
}

std::string conflict_text(const LineConflict& conflict, const ConflictOrigins& origins) {
    std::string text = kKindNames[static_cast<std::size_t>(conflict.kind)].one;
    text += " at " + location_text(conflict.location);
    if (const auto a = known(conflict.z_a)) {
        text += ", z " + decimal_text(*a);
    }
    if (const auto b = known(conflict.z_b)) {
        text += (known(conflict.z_a) ? " and " : ", z ") + decimal_text(*b);
    }
    text += ": " + action_key(conflict.action);
    std::string names;
    const auto add = [&names](const std::string& name) { names += (names.empty() ? " (" : "; ") + name; };
    if (conflict.line_a != LineConflict::kNone) {
        add(origins.lines.describe(conflict.line_a));
    }
    if (conflict.line_b != LineConflict::kNone && conflict.line_b != conflict.line_a) {
        add(origins.lines.describe(conflict.line_b));
    }
    if (conflict.other_sample != LineConflict::kNone) {
        add(origins.samples.describe(conflict.other_sample));
    }
    if (conflict.sample != LineConflict::kNone) {
        add(origins.samples.describe(conflict.sample));
    }
    return names.empty() ? text : text + names + ")";
}

void check_conflict_target(const std::string& target, const std::string& driver) {
    PointLayer::check_target(target, driver);
}

std::unique_ptr<io::AtomicOutput> write_conflicts(std::span<const LineConflict> conflicts,
                                                  const ConflictOrigins& origins, const io::Crs& crs,
                                                  const std::string& target, bool overwrite,
                                                  const std::string& driver) {
    constexpr std::array<io::TinField, 10> kFields{{{"kind", OFTString},
                                                    {"source_a", OFTString},
                                                    {"feature_a", OFTInteger64},
                                                    {"source_b", OFTString},
                                                    {"feature_b", OFTInteger64},
                                                    {"x", OFTReal},
                                                    {"y", OFTReal},
                                                    {"z_a", OFTReal},
                                                    {"z_b", OFTReal},
                                                    {"action", OFTString}}};
    PointLayer layer(target, driver, overwrite, "conflicts", kFields, crs);
    for (const LineConflict& conflict : conflicts) {
        const auto [a, b] = sides_of(conflict, origins);
        layer.set(0, conflict_key(conflict.kind));
        layer.set(1, a.source);
        layer.set(2, a.feature);
        layer.set(3, b.source);
        layer.set(4, b.feature);
        layer.set(5, conflict.location.x);
        layer.set(6, conflict.location.y);
        layer.set(7, known(conflict.z_a));
        layer.set(8, known(conflict.z_b));
        layer.set(9, action_key(conflict.action));
        layer.write({conflict.location.x, conflict.location.y,
                     known(conflict.z_a).value_or(known(conflict.z_b).value_or(0))});
    }
    return layer.finish();
}

}  // namespace tinwright::tools
