#ifndef TINWRIGHT_DELAUNAY_LENGTH_ORDER_HPP
#define TINWRIGHT_DELAUNAY_LENGTH_ORDER_HPP

#include <algorithm>
#include <span>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/norm.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/geometry/predicates_internal.hpp"
#include "tinwright/mesh/handles.hpp"

namespace tinwright {

/// All pairs of vertices in one row, shorter ones first, none equal.
///
/// Equal lengths are told apart as if the norm had a little of the Euclidean one in it, which makes its disks
/// strictly convex [tan1993, Sec. 5.8], and then by the vertices' numbers. What the theorems of
/// [tan1993, Ch. 5] ask of lengths all different holds of this order, since their lemmas need only that equal
/// lengths, in whatever order, never turn a strict inequality round: nothing has to be moved, so collinear
/// vertices stay collinear and no flat face comes about (docs/criteria.md).
class LengthOrder {
  public:
    /// `keys` must outlive the order.
    explicit LengthOrder(std::span<const Key2> keys, Norm norm = {}) : keys_(keys), norm_(norm) {}

    [[nodiscard]] Norm norm() const { return norm_; }
    [[nodiscard]] std::span<const Key2> keys() const { return keys_; }

    /// Sign of the length of a b less that of c d, exact; zero for equal lengths.
    [[nodiscard]] int compare(VertexId a, VertexId b, VertexId c, VertexId d) const {
        if (!norm_.is_euclidean()) {
            return compare_lengths(norm_, key(a), key(b), key(c), key(d));
        }
        // The same as compare_distances, of which the quick part is worth having here.
        const int quick = internal::compare_squares(internal::localize(key(a), key(b)).square,
                                                    internal::localize(key(c), key(d)).square);
        if (quick != internal::kUnsure) {
            return quick;
        }
        return compare_distances(key(a), key(b), key(c), key(d));
    }

    /// Whether the pair a b comes before the pair c d; false if they are the same pair.
    [[nodiscard]] bool is_shorter(VertexId a, VertexId b, VertexId c, VertexId d) const {
        const int order = compare(a, b, c, d);
        return order != 0 ? order < 0 : is_first_of_equals(a, b, c, d);
    }

    /// Whether x is in the lune of p q: the pairs p x and q x both come before p q.
    [[nodiscard]] bool is_in_lune(VertexId x, VertexId p, VertexId q) const {
        return is_shorter(p, x, p, q) && is_shorter(q, x, p, q);
    }

    /// Whether x is in the open lune of p q: both lengths are less, ties not broken.
    [[nodiscard]] bool is_in_open_lune(VertexId x, VertexId p, VertexId q) const {
        return compare(p, x, p, q) < 0 && compare(q, x, p, q) < 0;
    }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return keys_[v.value]; }
    [[nodiscard]] bool is_first_of_equals(VertexId a, VertexId b, VertexId c, VertexId d) const {
        if (!norm_.is_euclidean()) {
            const int order = compare_distances(key(a), key(b), key(c), key(d));
            if (order != 0) {
                return order < 0;
            }
        }
        return std::minmax(a, b) < std::minmax(c, d);
    }

    std::span<const Key2> keys_;
    Norm norm_;
};

}  // namespace tinwright

#endif
