#ifndef TINWRIGHT_TESTS_SUPPORT_CONSTRAINED_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_CONSTRAINED_ORACLE_HPP

#include <span>
#include <string>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/mesh/tin.hpp"

/// What constrained and conforming triangulations must be, by slow means: exact rational arithmetic, every
/// vertex and every line looked at. All tell the first defect; empty when there is none.
namespace tinwright_tests {

/// Audits of mesh and geometry, traces that are sorted and name constrained edges, and that no edge could be
/// flipped: it is constrained, or not inside the circle of the other side, ties broken the canonical way.
/// Locally Delaunay edges make a constrained Delaunay triangulation [lee1986].
std::string constrained_delaunay_defect(const tinwright::Tin& tin);

/// Every edge of a line has a circle through its ends that holds no vertex at all.
std::string empty_disk_defect(const tinwright::Tin& tin);

/// Every segment of every line is a chain of traced edges from its one end to its other. `allowed`: by how
/// many lattice steps (in x and in y) the vertices of the chain may lie beside the segment; 0: exactly on it.
std::string chain_defect(const tinwright::Tin& tin, std::span<const tinwright::Breakline> lines,
                         double allowed);

}  // namespace tinwright_tests

#endif
