#include "water_finding_text.hpp"

#include <array>
#include <cmath>

#include "tinwright/geometry/decimal.hpp"

namespace tinwright::tools {

namespace {

struct KindWords {
    const char* key;
    const char* one;
    const char* many;
    const char* alone;  ///< what a feature does by itself
    const char* with;   ///< stands before the name of the other one
    const char* after;  ///< stands behind it
};

/// By the kind's value.
constexpr std::array<KindWords, WaterFinding::kKinds> kWords = {
    {{"runs_uphill", "rise", "rises", "runs uphill", "runs uphill with ", ""},
     {"wrong_direction", "river drawn upstream", "rivers drawn upstream", "ends higher than it begins",
      "ends higher than it begins, in ", ""},
     {"beyond_limit", "place beyond the limits", "places beyond the limits",
      "takes more than the limits allow", "takes more than the limits allow, for ", ""},
     {"dangling_reach", "dangling reach", "dangling reaches", "ends where there is no water to run to",
      "ends short of ", ""},
     {"loop", "loop", "loops", "is in a circle of running water", "is in a circle of running water with ",
      ""},
     {"braid", "braid", "braids", "divides and comes together again", "comes together again with ", ""},
     {"river_through_lake", "river through a lake", "rivers through lakes", "passes a lake", "passes ", ""},
     {"lake_not_level", "lake that is not level", "lakes that are not level", "is not level",
      "is not level with ", ""},
     {"shore_under_water", "shore under water", "shores under water", "has a shore under water", "is above ",
      " beside it"},
     {"lakes_meet", "meeting of lakes", "meetings of lakes", "meets itself", "meets ", ""},
     {"lakes_out_of_order", "lake below the next one", "lakes below the next one",
      "is lower than what it runs to", "is lower than what it runs to, ", ""},
     {"banks_not_level", "section that is not level", "sections that are not level",
      "has banks of two heights", "has banks of two heights with ", ""},
     {"water_overlaps", "overlap of water", "overlaps of water", "overlaps itself", "overlaps ", ""},
     {"raster_rises", "rise of cells", "rises of cells", "has cells that rise downstream",
      "has cells that rise downstream with ", ""},
     {"raster_lake_uneven", "lake of uneven cells", "lakes of uneven cells", "has cells that differ",
      "has cells that differ with ", ""}}};

const KindWords& words(WaterFinding::Kind kind) { return kWords[static_cast<std::size_t>(kind)]; }

std::string number_text(double value) { return decimal_text(rounded(value)); }

std::string z_text(const WaterFinding& finding) {
    const bool has_z = !std::isnan(finding.z);
    const bool has_other = !std::isnan(finding.other_z);
    if (has_z && has_other) {
        return ", z " + number_text(finding.z) + " and " + number_text(finding.other_z);
    }
    return has_z || has_other ? ", z " + number_text(has_z ? finding.z : finding.other_z) : std::string();
}

}  // namespace

std::string finding_key(WaterFinding::Kind kind) { return words(kind).key; }

std::string finding_counts_text(const WaterFindingCounts& counts) {
    std::string text;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (counts[i] > 0) {
            text += (text.empty() ? "" : ", ") + std::to_string(counts[i]) + " " +
                    (counts[i] == 1 ? kWords[i].one : kWords[i].many);
        }
    }
    return text;
}

std::string finding_text(const WaterFinding& finding, const PartNames& names) {
    const KindWords& of_kind = words(finding.kind);
    std::string other;
    if (finding.sample != WaterFinding::kNone) {
        other = names.of_sample(finding.sample);
    } else if (finding.other_line != WaterFinding::kNone && finding.other_line != finding.line) {
        other = names.of_line(finding.other_line);
    }
    const bool has_line = finding.line != WaterFinding::kNone;
    std::string text = has_line ? names.of_line(finding.line) : "water";
    text += " ";
    text += other.empty() ? std::string(of_kind.alone) : of_kind.with + other + of_kind.after;
    if (finding.amount > 0) {
        text += ", by " + number_text(finding.amount);
    }
    if (finding.length > 0) {
        text += " along " + number_text(finding.length);
    }
    text += " at " + location_text({rounded(finding.location.x), rounded(finding.location.y)});
    if (finding.chainage > 0) {
        text += ", " + number_text(finding.chainage) + " from its start";
    }
    return text + z_text(finding);
}

}  // namespace tinwright::tools
