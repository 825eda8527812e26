#ifndef TINWRIGHT_BREAKLINES_KEYED_LINES_HPP
#define TINWRIGHT_BREAKLINES_KEYED_LINES_HPP

#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/clean_line.hpp"
#include "tinwright/breaklines/line_check.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/geometry/lattice.hpp"

/// What auditing and repairing lines begin with (line_check.hpp, line_repair.hpp).
namespace tinwright {

/// Lines on the lattice that they share with the samples, each one clean in itself.
struct KeyedLines {
    Lattice lattice;  ///< refined
    std::vector<LineTraits> traits;
    std::vector<CleanLine> lines;
    std::vector<std::vector<LineFault>> faults;  ///< one list a line
    double snap = 0;                             ///< in keys
    double dangling = 0;                         ///< in keys
};

/// The lattice of all points, refined for those that will be made. Throws InputError as `find_lattice` does.
/// O(n).
Lattice shared_lattice(std::span<const Breakline> lines, std::span<const Point3> samples);

/// What is known of each line: what the caller says, and what follows from the roles.
std::vector<LineTraits> complete_traits(std::span<const Breakline> lines, std::span<const LineTraits> given);

/// `lattice`: one that all points of the lines are on. Throws UsageError for options out of range. O(n).
KeyedLines key_lines(std::span<const Breakline> lines, const Lattice& lattice,
                     const LineCheckOptions& options, CrossingPolicy crossing_z = CrossingPolicy::Mean);

/// `node_lines` of those that have any length; line numbers are those of `source`, origins are not kept.
NodedLines node_keyed_lines(const KeyedLines& keyed, std::span<const Breakline> source,
                            const NodingOptions& options);

}  // namespace tinwright

#endif
