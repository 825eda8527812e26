#ifndef TINWRIGHT_TESTS_BENCHMARKS_GROWTH_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_GROWTH_HPP

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report.hpp"

/// How a time grows with the number of points.
namespace tinwright_benchmarks {

struct Growth {
    struct Step {
        double count = 0;
        double seconds = 0;
    };

    std::string name;
    std::vector<Step> steps;

    /// The exponent of the power of `count` that fits best (least squares of the logarithms); none below two
    /// steps.
    [[nodiscard]] std::optional<double> exponent() const;
};

/// A Markdown table with a column a size, printed line by line on stdout.
class GrowthTable {
  public:
    /// Prints the head with the numbers of points.
    GrowthTable(const std::string& what, std::span<const std::size_t> counts,
                std::optional<Target> target = std::nullopt);
    /// For lines that differ in their numbers of points, which are then told in each cell.
    GrowthTable(const std::string& what, std::size_t columns);

    /// One line; steps that are missing took too long.
    void add(const Growth& growth);

  private:
    std::size_t columns_;
    bool tells_counts_;
    std::optional<Target> target_;
};

/// Writes a picture of microseconds a point against points, both axes logarithmic (SVG).
void plot_growth(const std::string& path, std::span<const Growth> curves);

}  // namespace tinwright_benchmarks

#endif
