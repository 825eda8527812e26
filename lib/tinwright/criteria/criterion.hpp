#ifndef TINWRIGHT_CRITERIA_CRITERION_HPP
#define TINWRIGHT_CRITERIA_CRITERION_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tinwright/geometry/norm.hpp"
#include "tinwright/mesh/tin.hpp"

/// What makes one triangulation better than another. A criterion has a measure, a number for one face, and
/// asks that the worst face be as good as it can be; in its vector form, then the second worst, and so on.
/// Formulas, proofs and pictures: docs/criteria.md.
namespace tinwright {

enum class Criterion : std::uint8_t {
    Angle,         ///< smallest largest angle
    Height,        ///< greatest least height
    Slope,         ///< smallest steepest slope
    Eccentricity,  ///< smallest greatest distance from a face to its circumcentre
    Length,        ///< smallest longest edge
};
inline constexpr std::array kCriteria{Criterion::Angle, Criterion::Height, Criterion::Slope,
                                      Criterion::Eccentricity, Criterion::Length};
/// Those that edge insertion makes optimal.
inline constexpr std::array kInsertionCriteria{Criterion::Angle, Criterion::Height, Criterion::Slope,
                                               Criterion::Eccentricity};

/// What the numbers of a criterion count.
enum class MeasureUnit : std::uint8_t {
    Degree,
    Length,  ///< CRS units
    Ratio,   ///< z units over CRS units
};

/// Which of the two sufficient conditions for edge insertion the measure is proven to meet
/// [tan1993, Sec. 3.2]; `Strong` implies `Weak`. Without either it ends in local optima.
enum class InsertionCondition : std::uint8_t { None, Weak, Strong };

struct CriterionTraits {
    std::string_view name;     ///< as in `--criterion`: "slope"
    std::string_view measure;  ///< what is measured, for people: "slope"
    MeasureUnit unit = MeasureUnit::Ratio;
    bool is_greater_better = false;  ///< whether the worst face is the one of least measure
    InsertionCondition condition = InsertionCondition::Weak;
};

const CriterionTraits& criterion_traits(Criterion criterion);
/// The criterion of that name, as in `--criterion`.
std::optional<Criterion> find_criterion(std::string_view name);

/// Measures that differ by less than this part of themselves count as equal: more than their rounding, and
/// than what the rounding of elevations makes of a plane.
inline constexpr double kTieMargin = 1.0 / (1ULL << 34U);

/// The measure of a face that is not a ghost, in the criterion's unit. Relative error below 2^-44; of
/// slopes, a few units in the last place of the greatest rise over the least height. The same bits
/// whatever the order of the face's corners. `norm`: for length; the others are not affected.
double measure_face(const Tin& tin, FaceId face, Criterion criterion, Norm norm = {});

/// The worst measures of a TIN, in the criterion's unit.
struct WorstMeasures {
    double all = 0;                  ///< over all terrain faces
    std::optional<double> interior;  ///< over those without an edge on the border; empty if there are none
};

/// O(n). `tin` has at least one terrain face.
WorstMeasures find_worst(const Tin& tin, Criterion criterion, Norm norm = {});

}  // namespace tinwright

#endif
