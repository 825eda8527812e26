#ifndef TINWRIGHT_TESTS_BENCHMARKS_CONTENDERS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_CONTENDERS_HPP

#include <cstddef>
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

/// `METHOD[/GRADIENTS][@CRITERION[:ORDER]]`: as `--method`, `--gradients`, `--criterion`, `--delaunay-order`.
/// Throws std::runtime_error for what is none.
Contender parse_contender(const std::string& text);

/// Those of a list with commas, behind linear, which comes first. Without a list: all methods on the Delaunay
/// TIN, and linear on the data-dependent TINs.
std::vector<Contender> contenders_of(const std::string& list);
std::vector<std::string> split_list(const std::string& list);

/// Errors of the contenders at the checks of a fold that are on the terrain: `errors[i]` holds one number a
/// contender for the check `inside[i]`.
struct FoldErrors {
    std::vector<std::size_t> inside;
    std::vector<std::vector<double>> errors;
};
FoldErrors find_errors(const Fold& fold, const std::vector<Contender>& contenders);

}  // namespace tinwright_benchmarks

#endif
