#ifndef TINWRIGHT_TESTS_BENCHMARKS_BLOCK_BOOTSTRAP_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_BLOCK_BOOTSTRAP_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"

/// Whether two methods' errors at the same places differ by more than chance.
namespace tinwright_benchmarks {

/// Squared errors of some contenders, summed by square blocks of the plane: errors near each other are alike,
/// so that a block counts once, however many places it has.
class BlockErrors {
  public:
    /// About a hundred blocks over the bounds of `places`.
    BlockErrors(std::span<const tinwright::Point3> places, std::size_t contenders);

    /// The errors of all contenders at one place within the bounds.
    void add(tinwright::Point2 place, std::span<const double> errors);

    [[nodiscard]] std::size_t count() const;
    /// Root of the mean square; NaN without places.
    [[nodiscard]] double rmse(std::size_t contender) const;

    /// What resampled blocks say of the ratio of two contenders' RMSE: the middle 95 percent of it.
    struct Interval {
        double low = 0;
        double high = 0;
    };
    /// Blocks are drawn with replacement, as many as there are, `kDraws` times; seeded.
    [[nodiscard]] Interval ratio_interval(std::size_t contender, std::size_t base) const;

  private:
    struct Block {
        std::size_t count = 0;
        std::vector<double> squares;  // by contender
    };

    [[nodiscard]] double sum(std::size_t contender) const;

    double x_min_ = 0;
    double y_min_ = 0;
    double side_ = 1;
    std::size_t columns_ = 1;
    std::size_t contenders_ = 0;
    std::vector<Block> blocks_;
};

inline constexpr int kDraws = 2000;

}  // namespace tinwright_benchmarks

#endif
