#ifndef TINWRIGHT_TESTS_BENCHMARKS_CONTENDERS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_CONTENDERS_HPP

#include <string>
#include <vector>

#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/interpolation.hpp"

#include "benchmarks/held_out_sets.hpp"

/// The surfaces whose accuracy is compared.
namespace tinwright_benchmarks {

/// A way from samples to a surface.
struct Contender {
    std::string name;
    std::string criterion;  ///< of the TIN; empty: Delaunay
    tinwright::InterpolationOptions interpolation;
};

/// `METHOD[/GRADIENTS][@CRITERION]`: as `--method`, `--gradients` and `--criterion`. Throws
/// std::runtime_error for what is none.
Contender parse_contender(const std::string& text);

/// All methods on the Delaunay TIN, linear first, and linear on the data-dependent TINs.
std::vector<Contender> all_contenders();

/// Errors of the contenders at the checks of a fold that are on the terrain: `errors[i]` holds one number a
/// contender for the check `inside[i]`.
struct FoldErrors {
    std::vector<std::size_t> inside;
    std::vector<std::vector<double>> errors;
};
FoldErrors find_errors(const Fold& fold, const std::vector<Contender>& contenders);

}  // namespace tinwright_benchmarks

#endif
