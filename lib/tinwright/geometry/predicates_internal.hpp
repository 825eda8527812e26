#ifndef TINWRIGHT_GEOMETRY_PREDICATES_INTERNAL_HPP
#define TINWRIGHT_GEOMETRY_PREDICATES_INTERNAL_HPP

#include <optional>

#include "tinwright/geometry/lattice.hpp"

/// The tiers behind the predicates, opened to their tests. A tier that answers is right; one that cannot
/// tell says nothing, and the next is asked.
namespace tinwright::internal {

/// Double precision: differences of keys are exact, so only products and sums round. Answers when the
/// determinant exceeds its error bound, or when every intermediate is an integer below 2^53.
std::optional<int> orient2d_double(Key2 a, Key2 b, Key2 c);
/// 128-bit integers; always answers.
int orient2d_int128(Key2 a, Key2 b, Key2 c);

/// As `orient2d_double`; the bound on the error uses |u x v| <= |u||v| in place of the usual permanent.
std::optional<int> incircle_double(Key2 a, Key2 b, Key2 c, Key2 d);
/// 128-bit integers; answers when all coordinate differences to d are at most 2^30.
std::optional<int> incircle_int128(Key2 a, Key2 b, Key2 c, Key2 d);
/// 256-bit integers; always answers.
int incircle_int256(Key2 a, Key2 b, Key2 c, Key2 d);

/// The side on which the symbolic perturbation puts d when `incircle` is zero: see `incircle_perturbed`.
int incircle_tie(Key2 a, Key2 b, Key2 c, Key2 d);

}  // namespace tinwright::internal

#endif
