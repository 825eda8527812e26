#ifndef TINWRIGHT_OPTIMAL_OPTIMIZE_HPP
#define TINWRIGHT_OPTIMAL_OPTIMIZE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/norm.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

/// Making a TIN optimal under a criterion: what is asked for, and what is reported.
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
    Scope scope = {};  ///< for length always Max, whatever is said
    Norm norm = {};    ///< what length is measured by; the other criteria are not affected
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

/// What the relative neighbourhood graph left to look at; see `min_max_length.hpp`.
struct LengthReport {
    std::size_t graph_edges = 0;  ///< of the graph, other than constrained edges
    std::size_t polygons = 0;     ///< looked at: with an edge longer than was known to be needed
    std::size_t incomplete = 0;   ///< of these, with a side that is not in the graph of the polygon's corners
    std::size_t largest = 0;      ///< of these, sides of the one that has most
    std::size_t changed = 0;      ///< of these, triangulated anew; the longest edge does not need the others
};

struct OptimizeReport {
    WorstMeasures before;
    WorstMeasures after;
    /// For scope vector: of the whole vector; for the others: of the worst measure.
    Proof proof = Proof::None;
    StoppedBy stopped_by = StoppedBy::Finished;
    std::size_t insertions = 0;  ///< edges inserted
    std::size_t tries = 0;       ///< faces whose improvement was sought; for length, polygons looked at
    std::size_t candidates = 0;  ///< edges considered for insertion
    std::size_t frozen = 0;      ///< faces within the scope that were found to be as good as can be
    std::size_t ties = 0;        ///< measures met that equal, as far as can be told, the one to improve on
    double seconds = 0;
    std::optional<LengthReport> length;  ///< for that criterion only
};

/// Makes `tin` optimal under a criterion: by edge insertion (`edge_insertion.hpp`), or for length by the
/// relative neighbourhood graph (`min_max_length.hpp`); see there. Vertices, constrained edges and the domain
/// stay; the number of faces too. From the same TIN always the same result. Stopped early, `tin` is a valid
/// triangulation that is no worse than at the start.
///
/// `tin`: at least one terrain face, Delaunay within its constrained edges. Throws InputError, with the
/// sample, for an elevation beyond 1e100.
OptimizeReport optimize(Tin& tin, const OptimizeOptions& options);

}  // namespace tinwright

#endif
