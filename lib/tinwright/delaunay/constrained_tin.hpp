#ifndef TINWRIGHT_DELAUNAY_CONSTRAINED_TIN_HPP
#define TINWRIGHT_DELAUNAY_CONSTRAINED_TIN_HPP

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/breaklines/noding.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/box.hpp"
#include "tinwright/mesh/tin.hpp"

namespace tinwright {

struct ConstrainedTinOptions {
    DuplicateOptions duplicates;
    NodingOptions noding;
    /// Samples closer than this to a line (CRS units, >= 0), but not on it, are reported.
    double line_tolerance = 0;
    /// Whether points will be made on the lines later, so that the lattice is to be refined for them.
    bool wants_fine_lattice = false;
};

/// What became of the lines.
struct LinesReport {
    std::size_t lines = 0;
    std::size_t line_points = 0;        ///< points of the lines, as they came
    std::size_t crossing_vertices = 0;  ///< vertices made where lines cross
    std::size_t draped_vertices = 0;    ///< vertices of lines that got z from the samples' TIN
    std::size_t cleared_samples =
        0;  ///< locations of samples left out, as they are in a lake or between banks
    std::size_t cleared_pieces = 0;  ///< parts of breaklines and rivers left out likewise
    std::vector<LineConflict> conflicts;
};

struct ConstrainedTin {
    Tin tin;
    Box bounds;  ///< of samples and lines, CRS units
    DuplicateReport duplicates;
    LinesReport lines;
    /// Where lines are draped beyond all that has an elevation, the hull of that, as a ring that outside of
    /// which is no terrain. It is traced as if it were one more line behind the others.
    std::optional<Breakline> terrain_ring;
};

/// The constrained Delaunay TIN of samples and lines: lattice, noding, one vertex a location, elevations of
/// lines without from the samples' TIN, segments.
///
/// A sample at a line's vertex or on one of its segments counts as a duplicate of the line there, and follows
/// the policy for duplicates as if lines were read after all samples; a line of a water role keeps its z.
/// Strictly inside polygons of roles Lake and Bank nothing counts but lines of roles Lake, Bank and Section,
/// and borders, which get the elevation of the water. Throws InputError and BreaklineError for what cannot be
/// used: see `make_sample_vertices`, `node_lines`; rings that are not closed; lines to be draped without
/// samples to drape them on; all locations collinear. O((n + p) log (n + p)) for n samples and p pieces in
/// practice.
ConstrainedTin make_constrained_tin(std::span<const Point3> samples, std::span<const Breakline> lines,
                                    const ConstrainedTinOptions& options = {});

}  // namespace tinwright

#endif
