#ifndef TINWRIGHT_GEOMETRY_LATTICE_HPP
#define TINWRIGHT_GEOMETRY_LATTICE_HPP

#include <span>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// A lattice point: `x` and `y` hold non-negative integers below 2^45, so sums and differences of
/// keys are exact in double precision. Zero when made with braces.
struct Key2 {
    double x;
    double y;
    friend bool operator==(const Key2&, const Key2&) = default;
};

/// Keys at or beyond this value are refused at ingest (2^45).
inline constexpr double kKeyLimit = 35184372088832.0;

/// The grid of representable positions: a position is (origin + key) steps of `quantum` CRS units.
///
/// Survey coordinates are decimal, and three points of a straight decimal row are not collinear once
/// each is rounded to binary. On the lattice they are: all geometry runs on keys, and positions are
/// turned back into CRS units, correctly rounded, only for output. A coordinate that came in on the
/// lattice goes out bit for bit (a negative zero becomes zero).
class Lattice {
  public:
    Lattice() = default;

    /// Steps of 10^-decimals; `origin` counts steps from zero, |origin + key| below 2^51, decimals 0..22.
    static Lattice decimal(int decimals, Key2 origin);
    /// Steps of 2^exponent; same condition on the origin.
    static Lattice binary(int exponent, Key2 origin, bool is_exact);

    /// The same lattice with every step divided by 2^bits, for points that are made rather than given. Key k
    /// becomes k * 2^bits and keeps its position bit for bit. `bits`: 0 to what `refinement_room` allows.
    [[nodiscard]] Lattice refined(int bits) const;
    /// Bits that the lattice can be refined by, at most kRefinementBits, when keys go up to `largest`.
    [[nodiscard]] int refinement_room(double largest) const;
    /// Bits by which the lattice is finer than the data asked for.
    [[nodiscard]] int refinement() const { return refinement_; }

    /// Length of one step, CRS units.
    [[nodiscard]] double quantum() const;
    /// Its inverse, which is exact.
    [[nodiscard]] double steps_per_unit() const { return steps_per_unit_; }
    /// Number of decimals of a decimal lattice, -1 for a binary one.
    [[nodiscard]] int decimals() const { return decimals_; }
    /// Exponent of a binary lattice (its quantum is 2^exponent); 0 for a decimal one.
    [[nodiscard]] int exponent() const { return exponent_; }
    /// Position of key (0, 0), in steps from zero.
    [[nodiscard]] Key2 origin() const { return origin_; }
    /// Whether every coordinate the lattice was made for lies on it, bit for bit. If not, each moved by
    /// at most half a quantum.
    [[nodiscard]] bool is_exact() const { return is_exact_; }

    /// Nearest lattice point, as a key; exact for positions on the lattice.
    [[nodiscard]] Key2 key(Point2 position) const {
        return {nearest_integer(position.x * steps_per_unit_) - origin_.x,
                nearest_integer(position.y * steps_per_unit_) - origin_.y};
    }
    /// The position of a key, correctly rounded.
    [[nodiscard]] Point2 position(Key2 key) const {
        return {(origin_.x + key.x) / steps_per_unit_, (origin_.y + key.y) / steps_per_unit_};
    }

    /// `value` rounded to an integer, ties to even; |value| below 2^51.
    static double nearest_integer(double value) {
        constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52: doubles are integers from here on
        return (value + kShift) - kShift;
    }

    friend bool operator==(const Lattice&, const Lattice&) = default;

  private:
    Key2 origin_{};
    double steps_per_unit_ = 1;  // 10^decimals or 2^-exponent, times 2^refinement: exact either way
    int decimals_ = 0;
    int exponent_ = 0;
    int refinement_ = 0;
    bool is_exact_ = true;
};

/// Made points get a lattice up to 2^20 times finer than the data's: a survey to the centimetre gets its
/// Steiner points to ten nanometres, near the resolution of its coordinates as doubles.
inline constexpr int kRefinementBits = 20;

/// A lattice with the bounding box (CRS units) of the samples it was found from.
struct FoundLattice {
    Lattice lattice;
    Box bounds;
};

/// Finds the coarsest lattice that holds the samples' x and y: 10^-d with the fewest decimals, else 10^-d /
/// 2^kRefinementBits (data with made points among them), else a power of two. Where neither holds them all in
/// 2^45 steps and the data are not decimal, the finest power of two that spans them (and a 2^51st of the
/// largest coordinate) is taken and `is_exact()` is false.
///
/// `samples`: n of them, any order; the result does not depend on it. `line_points`: more of them, whose x
/// and y count in the same way; their z is not looked at. Where the samples are decimal and only they are
/// (lines come from another CRS, say), it is the samples' lattice refined as far as it can be: samples lie on
/// it, lines are moved to it, by half of one of its steps at most. Throws InputError naming the first sample
/// with an x, y or z that is not finite, and for decimal data whose extent needs more than 2^45 steps. Cost:
/// O(n), parallel inside the caller's task arena. [DESIGN of keys: docs/robustness.md]
FoundLattice find_lattice(std::span<const Point3> samples, std::span<const Point3> line_points = {});

}  // namespace tinwright

#endif
