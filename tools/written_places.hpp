#ifndef TINWRIGHT_TOOLS_WRITTEN_PLACES_HPP
#define TINWRIGHT_TOOLS_WRITTEN_PLACES_HPP

#include <span>
#include <vector>

#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/io/output_positions.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/working_plane.hpp"

#include "leveled_water.hpp"
#include "options_crs.hpp"
#include "repair.hpp"

/// Audits and repairs work in a plane too, and tell of places in a system of their sources.
namespace tinwright::tools {

/// The system that is written: --crs, else the sources' own where it is geographic, else the plane's.
io::Crs audit_crs(const CrsOptions& options, const io::WorkingPlane& plane);

/// The way from the plane to `output` for lines and samples that lie in it.
io::OutputPositions positions_of(const io::Lines& lines, const io::Samples& samples, const io::Crs& plane,
                                 const io::Crs& output);

/// Brings what is written to the system that is written. Throws InputError.
void bring_to(const io::OutputPositions& positions, std::span<LineConflict> conflicts);
void bring_to(const io::OutputPositions& positions, RepairedLines& lines);
/// Likewise reaches, sections, lakes and findings; sets `output_crs`. Widths of sections are measured first.
void bring_to_output(LeveledWater& leveled, const CrsOptions& options);

}  // namespace tinwright::tools

#endif
