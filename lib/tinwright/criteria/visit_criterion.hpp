#ifndef TINWRIGHT_CRITERIA_VISIT_CRITERION_HPP
#define TINWRIGHT_CRITERIA_VISIT_CRITERION_HPP

#include <concepts>
#include <utility>

#include "tinwright/criteria/angle.hpp"
#include "tinwright/criteria/criterion.hpp"
#include "tinwright/criteria/eccentricity.hpp"
#include "tinwright/criteria/height.hpp"
#include "tinwright/criteria/length.hpp"
#include "tinwright/criteria/slope.hpp"

/// The list of all criteria, and the way from a name to the code made for it. A new criterion is a header of
/// its own, a line in each half of this file, a name in criterion.hpp and its traits in criterion.cpp; the
/// engine stays as it is. Not installed.
namespace tinwright {

/// What the engine asks of a criterion. Corners are given counter-clockwise.
template <class C>
concept FaceCriterion = requires(const C& criterion, VertexId v, double x) {
    { C::kTraits } -> std::convertible_to<CriterionTraits>;
    /// Greater is worse; a pure function of the three vertices, the same bits in whatever order.
    { criterion.measure(v, v, v) } -> std::same_as<double>;
    /// Corners (bit i: corner i) at which every improvement has to break the face: all must be tried
    /// if there are several; none if the face cannot be improved.
    { criterion.anchors(v, v, v) } -> std::same_as<unsigned>;
    /// To the unit that people read, and back; a number that no face can have stays beyond those of faces.
    { criterion.to_report(x) } -> std::same_as<double>;
    { criterion.from_report(x) } -> std::same_as<double>;
};

/// What the search under the weak condition asks besides: a cut, which knows when no edge q s through an edge
/// a b can improve a face q r p. Sound, not exact: it may leave too much, and it is asked at every
/// `kLevels`th level of the search only.
template <class C>
concept WeakCriterion = FaceCriterion<C> &&
    requires(const C& criterion, VertexId v, double x, typename C::Cut::State state) {
    { C::Cut::kLevels } -> std::convertible_to<unsigned>;
    { typename C::Cut(criterion, v, v, v, x).start() } -> std::same_as<typename C::Cut::State>;
    { typename C::Cut(criterion, v, v, v, x).cross(state, v, v) } -> std::same_as<bool>;
};

static_assert(FaceCriterion<AngleCriterion> && FaceCriterion<HeightCriterion> &&
              FaceCriterion<LengthCriterion>);
static_assert(WeakCriterion<SlopeCriterion> && WeakCriterion<EccentricityCriterion>);

/// Calls `visitor` with the criterion's code, made for `tin`, which must outlive it; `norm` is for length.
template <class Visitor>
decltype(auto) visit_criterion(Criterion criterion, const Tin& tin, Visitor&& visitor, Norm norm = {}) {
    switch (criterion) {
        case Criterion::Angle:
            return visitor(AngleCriterion(tin));
        case Criterion::Height:
            return visitor(HeightCriterion(tin));
        case Criterion::Eccentricity:
            return visitor(EccentricityCriterion(tin));
        case Criterion::Length:
            return visitor(LengthCriterion(tin, norm));
        case Criterion::Slope:
            break;
    }
    return visitor(SlopeCriterion(tin));
}

}  // namespace tinwright

#endif
