#include "tinwright/criteria/criterion.hpp"

#include <algorithm>
#include <limits>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/mesh/border.hpp"

namespace tinwright {

const CriterionTraits& criterion_traits(Criterion criterion) {
    switch (criterion) {
        case Criterion::Angle:
            return AngleCriterion::kTraits;
        case Criterion::Height:
            return HeightCriterion::kTraits;
        case Criterion::Eccentricity:
            return EccentricityCriterion::kTraits;
        case Criterion::Length:
            return LengthCriterion::kTraits;
        case Criterion::Slope:
            break;
    }
    return SlopeCriterion::kTraits;
}

std::optional<Criterion> find_criterion(std::string_view name) {
    for (const Criterion criterion : kCriteria) {
        if (criterion_traits(criterion).name == name) {
            return criterion;
        }
    }
    return std::nullopt;
}

double measure_face(const Tin& tin, FaceId face, Criterion criterion, Norm norm) {
    return visit_criterion(
        criterion, tin,
        [&tin, face](const FaceCriterion auto& code) {
            const auto& [a, b, c] = tin.mesh.face(face).vertex;
            return code.to_report(code.measure(a, b, c));
        },
        norm);
}

WorstMeasures find_worst(const Tin& tin, Criterion criterion, Norm norm) {
    constexpr double kNone = -std::numeric_limits<double>::infinity();
    return visit_criterion(
        criterion, tin,
        [&tin](const FaceCriterion auto& code) {
            const TriangleMesh& mesh = tin.mesh;
            double all = kNone;
            double interior = kNone;
            for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
                if (!mesh.is_terrain({f})) {
                    continue;
                }
                const auto& [a, b, c] = mesh.face({f}).vertex;
                const double measure = code.measure(a, b, c);
                all = std::max(all, measure);
                if (measure > interior && !is_on_border(mesh, {f})) {
                    interior = measure;
                }
            }
            WorstMeasures worst{code.to_report(all), std::nullopt};
            if (interior != kNone) {
                worst.interior = code.to_report(interior);
            }
            return worst;
        },
        norm);
}

}  // namespace tinwright
