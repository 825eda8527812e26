#ifndef TINWRIGHT_TESTS_SUPPORT_POINT_SETS_HPP
#define TINWRIGHT_TESTS_SUPPORT_POINT_SETS_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"

/// Seeded point sets: the ordinary kinds, and the near-degenerate ones that break triangulators.
namespace tinwright_tests {

/// The splitmix64 sequence: the same numbers on every machine, whatever the standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next();
    /// An integer from `low` to `high`, both included.
    std::int64_t integer(std::int64_t low, std::int64_t high);
    /// A key coordinate from 0 to below `limit`, an integer.
    double key(double limit);
    /// From 0 to below 1.
    double real();

  private:
    std::uint64_t state_;
};

/// A kind of key sets; `make` gives about `count` keys below 2^45, some of them possibly repeated.
struct KeyFamily {
    const char* name;
    std::vector<tinwright::Key2> (*make)(Random& random, std::size_t count);
};

/// All kinds: uniform at several widths, grids, jittered grids, scan rows, points within one key of a line
/// or circle, co-circular rings, facing lines, clusters over decades, a parabola, crossing rows.
std::span<const KeyFamily> key_families();

/// `keys` without repetitions, in lexicographic order (x, then y).
std::vector<tinwright::Key2> without_repetitions(std::vector<tinwright::Key2> keys);

/// `columns` by `rows` keys, one apart.
std::vector<tinwright::Key2> grid_keys(int columns, int rows);

/// `count` of the 324 lattice points on the circle of radius 32045 around (40000, 40000), all of them if
/// `count` is greater.
std::vector<tinwright::Key2> circle_keys(Random& random, std::size_t count);

/// Coordinates with `decimals` decimals within `extent` of (x, y), each the double nearest to its decimal.
std::vector<tinwright::Point3> decimal_samples(Random& random, std::size_t count, int decimals, double x,
                                               double y, double extent);

/// Air-borne scan rows in UTM metres with centimetres: rows a metre apart, points unevenly along them, z to
/// the centimetre.
std::vector<tinwright::Point3> scan_samples(Random& random, std::size_t count);

/// `values` in a random order.
template <class Value>
std::vector<Value> shuffled(Random& random, std::vector<Value> values) {
    for (std::size_t i = values.size(); i > 1; --i) {
        std::swap(values[i - 1],
                  values[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i) - 1))]);
    }
    return values;
}

}  // namespace tinwright_tests

#endif
