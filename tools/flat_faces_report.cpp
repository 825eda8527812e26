#include "flat_faces_report.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr auto kTreatments = std::to_array<std::pair<std::string_view, FlatFaces>>(
    {{"keep", FlatFaces::Keep}, {"swap", FlatFaces::Swap}, {"insert", FlatFaces::Insert}});

}  // namespace

std::string treatment_name(FlatFaces how) { return choice_name(how, kTreatments); }

FlatFaces treatment_value(const std::string& text) {
    return text.empty() ? FlatFaces::Keep : choice_value("--flat-faces", text, kTreatments);
}

FlatFacesSummary count_in_file(const Tin& tin, const std::vector<bool>& is_water,
                               const io::TinMetadata& metadata) {
    FlatFacesSummary summary{treatment_name(FlatFaces::Keep), {}, true};
    summary.report.after = count_flat_faces(tin, is_water);
    for (const auto& [key, value] : metadata) {
        if (key == kFlatFacesKey) {
            summary.treatment = value.substr(0, value.find(':'));
        }
    }
    return summary;
}

JsonValue flat_faces_json(const FlatFacesSummary& summary) {
    JsonValue json = JsonValue::object();
    json.set("treatment", summary.treatment);
    if (!summary.is_count_only) {
        json.set("before", summary.report.before)
            .set("swapped", summary.report.swapped)
            .set("inserted", summary.report.inserted);
    }
    return json.set("after", summary.report.after);
}

std::string flat_faces_line(const FlatFacesSummary& summary) {
    const FlatFacesReport& report = summary.report;
    if (summary.is_count_only) {
        return std::to_string(report.after) + (summary.treatment == treatment_name(FlatFaces::Keep)
                                                   ? std::string()
                                                   : ", after --flat-faces " + summary.treatment);
    }
    return std::to_string(report.before) + " before, " + std::to_string(report.after) + " after; " +
           std::to_string(report.swapped) + (report.swapped == 1 ? " edge" : " edges") + " swapped, " +
           std::to_string(report.inserted) + (report.inserted == 1 ? " point" : " points") + " inserted";
}

io::TinMetadata flat_faces_metadata(const FlatFacesSummary& summary) {
    return {{kFlatFacesKey, summary.treatment + ": " + flat_faces_line(summary)}};
}

}  // namespace tinwright::tools
