#ifndef TINWRIGHT_CRITERIA_QUALITY_HPP
#define TINWRIGHT_CRITERIA_QUALITY_HPP

#include <array>
#include <cstddef>
#include <vector>

#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/mesh/tin.hpp"

/// How good the faces of a TIN are: distributions and worst faces, for reports. Numbers here are rounded
/// floating point and decide nothing.
namespace tinwright {

/// A number for one face.
enum class FaceMeasure {
    LargestAngle,  ///< degrees, 60 to 180, seen from above
    Slope,         ///< degrees, 0 to 90
    LongestEdge,   ///< CRS units, seen from above
    Area,          ///< square CRS units, seen from above
};
inline constexpr std::array kFaceMeasures{FaceMeasure::LargestAngle, FaceMeasure::Slope,
                                          FaceMeasure::LongestEdge, FaceMeasure::Area};

/// The measure of a face that is not a ghost. `z_factor`: CRS units in a unit of z, which slopes count.
/// Relative error a few units in the last place of the coordinate differences, which themselves are exact.
double measure_face(const Tin& tin, FaceId face, FaceMeasure measure, double z_factor = 1);

/// Length of a face's gradient: rise over run, 0 for a level face. `z_factor` as above.
double slope_ratio(const Tin& tin, FaceId face, double z_factor = 1);

/// Counts of values between bounds.
struct Histogram {
    std::vector<double> bounds;       ///< ascending; one more than counts
    std::vector<std::size_t> counts;  ///< counts[i]: values from bounds[i] up to below bounds[i + 1]; the
                                      ///< last bin holds its upper bound too
};

struct FaceValue {
    FaceId face{0};
    double value = 0;
    bool is_on_border = false;  ///< an edge of the face has no terrain behind it
};

/// One measure over all terrain faces.
struct MeasureSummary {
    FaceMeasure measure = FaceMeasure::LargestAngle;
    double minimum = 0;
    double median = 0;         ///< the value of rank floor(n / 2)
    double percentile_99 = 0;  ///< the value of rank floor(0.99 n)
    double maximum = 0;
    Histogram histogram;           ///< fixed bins for angles; steps of 1, 2, 5 for lengths and areas
    std::vector<FaceValue> worst;  ///< greatest first, equal ones by face
};

struct QualityReport {
    std::size_t faces = 0;                  ///< terrain faces
    double area = 0;                        ///< of all of them, square CRS units, or on the ground
    std::vector<MeasureSummary> summaries;  ///< in the order of kFaceMeasures; empty without faces
};

/// Summarises every measure. `worst`: how many of the worst faces to list. Lengths and areas are those of the
/// ground. `z_factor`: CRS units in a unit of z. O(n), parallel inside the caller's task arena where these
/// are functions; 8 bytes a face of scratch.
QualityReport assess_quality(const Tin& tin, std::size_t worst = 5, const GroundMeasures& ground = {},
                             double z_factor = 1);

}  // namespace tinwright

#endif
