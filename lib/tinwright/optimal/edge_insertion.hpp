#ifndef TINWRIGHT_OPTIMAL_EDGE_INSERTION_HPP
#define TINWRIGHT_OPTIMAL_EDGE_INSERTION_HPP

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

/// Edge insertion: the engine that makes a TIN optimal under a criterion [tan1993, Ch. 3; bern1993].
namespace tinwright {

/// How far down the faces, sorted worst first, the optimum is sought.
struct Scope {
    enum class Kind : std::uint8_t {
        Max,     ///< until the worst measure is proven optimal
        Vector,  ///< all of them: the whole sorted vector of measures is optimal
        Top,     ///< faces at least as bad as the worst `value` percent were at the start
        Above,   ///< faces worse than `value`, in the criterion's unit
    };
    Kind kind = Kind::Top;
    double value = 0.5;
};

struct OptimizeOptions {
    Criterion criterion = Criterion::Slope;
    Scope scope = {};
    std::optional<double> budget_seconds = {};  ///< stop after this time
    /// Asked often, with the fraction done as far as it can be told; false stops the work like a budget.
    Progress progress = {};
};

/// What is known of an optimum.
enum class Proof : std::uint8_t {
    None,  ///< nothing: stopped early, or the scope ended above the first face that could not be improved
    /// Optimal up to ties: measures that were equal, which the theorems exclude, were met. From a Delaunay
    /// TIN the worst measure has always been seen to be the least; slopes of coplanar neighbours can keep it
    /// from being so when the start is another.
    Tested,
    Theorem,  ///< proven [tan1993, Theorem 4.1]
};

enum class StoppedBy : std::uint8_t { Finished, Budget, Interrupt };

struct OptimizeReport {
    WorstMeasures before;
    WorstMeasures after;
    /// For scope vector: of the whole vector; for the others: of the worst measure.
    Proof proof = Proof::None;
    StoppedBy stopped_by = StoppedBy::Finished;
    std::size_t insertions = 0;  ///< edges inserted
    std::size_t tries = 0;       ///< faces whose improvement was sought
    std::size_t candidates = 0;  ///< edges considered for insertion
    std::size_t frozen = 0;      ///< faces within the scope that were found to be as good as can be
    std::size_t ties = 0;        ///< measures met that equal, as far as can be told, the one to improve on
    double seconds = 0;
};

/// Improves the faces of `tin` under a criterion by edge insertion, without crossing a constrained edge or
/// leaving the terrain. Vertices, constrained edges and the domain stay; the number of faces too.
///
/// Meant to start from a Delaunay TIN. From the same TIN always the same result; without ties the result of
/// scope vector is unique, whatever the faces at the start. Stopped early, `tin` is a valid triangulation
/// that is better than at the start.
///
/// `tin`: at least one terrain face. Throws InputError, with the sample, for an elevation beyond 1e100.
/// Cost: seconds for 10^6 samples, growing about linearly (docs/benchmarks.md); at worst quadratic for angle
/// and height. About 50 bytes a vertex of scratch.
OptimizeReport optimize(Tin& tin, const OptimizeOptions& options);

}  // namespace tinwright

#endif
