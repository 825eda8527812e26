#include "tinwright/optimal/ring_measures.hpp"

#include <algorithm>
#include <cstdint>

#include "tinwright/criteria/visit_criterion.hpp"

namespace tinwright {

RingMeasure longest_side(std::span<const Key2> ring, Norm norm) {
    return [ring, norm](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
        return std::max(
            {length(norm, ring[i], ring[k]), length(norm, ring[k], ring[j]), length(norm, ring[j], ring[i])});
    };
}

RingMeasure half_perimeter(std::span<const Key2> ring, Norm norm) {
    return [ring, norm](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
        return (length(norm, ring[i], ring[k]) + length(norm, ring[k], ring[j]) +
                length(norm, ring[j], ring[i])) /
               2;
    };
}

RingMeasure criterion_measure(const Tin& tin, std::span<const VertexId> ring, Criterion criterion,
                              Norm norm) {
    return visit_criterion(
        criterion, tin,
        [ring](const FaceCriterion auto& code) -> RingMeasure {
            const double sign = code.kTraits.is_greater_better ? -1 : 1;
            return [code, ring, sign](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
                return sign * code.to_report(code.measure(ring[i], ring[k], ring[j]));
            };
        },
        norm);
}

}  // namespace tinwright
