#include "tinwright/water/water_finding.hpp"

namespace tinwright {

bool is_fault(const WaterFinding& finding) {
    switch (finding.kind) {
        case WaterFinding::Kind::Braid:
            return false;
        case WaterFinding::Kind::RiverThroughLake:
        case WaterFinding::Kind::LakesMeet:
            return finding.amount > 0;
        default:
            return true;
    }
}

WaterFindingCounts count_findings(std::span<const WaterFinding> findings) {
    WaterFindingCounts counts{};
    for (const WaterFinding& finding : findings) {
        ++counts[static_cast<std::size_t>(finding.kind)];
    }
    return counts;
}

}  // namespace tinwright
