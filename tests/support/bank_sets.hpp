#ifndef TINWRIGHT_TESTS_SUPPORT_BANK_SETS_HPP
#define TINWRIGHT_TESTS_SUPPORT_BANK_SETS_HPP

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

#include "support/point_sets.hpp"

/// Seeded polygons of running water.
namespace tinwright_tests {

/// A connected polygon: its outer ring counter-clockwise, then its islands clockwise.
struct BankSet {
    std::vector<std::vector<tinwright::Key2>> rings;
    [[nodiscard]] std::size_t islands() const { return rings.size() - 1; }
};

/// The polygon of the '#' in a map of characters, rows from above, which touch along sides only: columns and
/// rows as wide as told, sides divided into pieces of at most `spacing`, vertices moved by up to `jitter`
/// along each axis (below a quarter of the pieces and of what is narrowest).
struct MapScale {
    std::vector<double> columns;  ///< widths; the last one for all beyond
    std::vector<double> rows;
    double spacing = 1e9;
    double jitter = 0;
};
BankSet banks_from_map(std::span<const std::string_view> map, const MapScale& scale, Random& random);

/// A straight channel along x: `stations` vertices a bank, `spacing` apart, the banks `width` apart.
BankSet straight_banks(std::size_t stations, double spacing, double width);

/// Both sides of a sine-generated curve of `bends` half waves, `stations` vertices a bank; `steepest`: its
/// greatest angle with x, radians, up to 1.9. In the middle of each half wave whose number is in `islands` is
/// an island half as wide as the water.
BankSet meander_banks(std::size_t bends, double steepest, std::size_t stations, double width,
                      std::span<const std::size_t> islands);

/// A kind of banks; `make` gives about `size` vertices, 12 or more.
struct BankFamily {
    const char* name;
    BankSet (*make)(Random& random, std::size_t size);
};

/// Channels straight, widening and bent, hairpins, arms, bays, braids and mazes on lattices and off them,
/// pools, needles, few and many vertices; and all of `ring_families`.
std::span<const BankFamily> bank_families();

}  // namespace tinwright_tests

#endif
