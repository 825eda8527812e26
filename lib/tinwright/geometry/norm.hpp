#ifndef TINWRIGHT_GEOMETRY_NORM_HPP
#define TINWRIGHT_GEOMETRY_NORM_HPP

#include <optional>
#include <string>
#include <string_view>

#include "tinwright/geometry/lattice.hpp"

namespace tinwright {

/// A way to measure lengths in the plane: the p-th root of |x|^p + |y|^p, for a whole p, or the greater of
/// |x| and |y| (p infinite). Euclidean unless said otherwise.
class Norm {
  public:
    static constexpr int kLargestPower = 64;

    constexpr Norm() = default;
    /// `p`: 1 to kLargestPower. Throws UsageError otherwise.
    static Norm lp(int p);
    static constexpr Norm maximum() { return Norm(kInfinitePower); }

    [[nodiscard]] constexpr bool is_euclidean() const { return power_ == 2; }
    [[nodiscard]] constexpr bool is_maximum() const { return power_ == kInfinitePower; }
    /// p, of a norm that is not the maximum.
    [[nodiscard]] constexpr int power() const { return power_; }
    friend constexpr bool operator==(Norm, Norm) = default;

  private:
    static constexpr int kInfinitePower = 0;
    constexpr explicit Norm(int power) : power_(power) {}

    int power_ = 2;
};

/// Sign of the length of a b less that of c d: +1 if a and b are farther apart. Exact for keys of magnitude
/// up to 2^52; fast for p of 1, 2 and infinity, and for others where the lengths differ.
int compare_lengths(Norm norm, Key2 a, Key2 b, Key2 c, Key2 d);

/// Length of a b in keys; relative error below 2^-44.
double length(Norm norm, Key2 a, Key2 b);

/// "l1", "l2", "linf" or "lp:3", as in `--norm`.
std::string norm_name(Norm norm);
/// The norm of that name; "lp:1" and "lp:2" are l1 and l2. Empty if there is none: p is a whole number, 1 to
/// kLargestPower.
std::optional<Norm> find_norm(std::string_view name);

}  // namespace tinwright

#endif
