#ifndef TINWRIGHT_TOOLS_CONFLICT_LAYER_HPP
#define TINWRIGHT_TOOLS_CONFLICT_LAYER_HPP

#include <memory>
#include <span>
#include <string>

#include "tinwright/breaklines/line_conflict.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"

/// Conflicts of lines in words, and as a layer of points.
namespace tinwright::tools {

/// Stable name of a kind, as in the layer's field `kind` and in JSON: "self_crossing".
std::string conflict_key(LineConflict::Kind kind);
/// Stable name of what was done, as in the layer's field `action`: "noded".
std::string action_key(LineConflict::Action action);
/// "2 crossings, 1 sample on a line"; empty when there are none.
std::string conflict_counts_text(const ConflictCounts& counts);

/// Where conflicts come from: what `line_a`, `line_b` and `sample` number.
struct ConflictOrigins {
    const io::Lines& lines;
    const io::Samples& samples;
};

/// One conflict for people: `crossing at (3, 4), z 5 and 6: noded (file "a.gpkg", layer "p", feature 7;
/// ...)`.
std::string conflict_text(const LineConflict& conflict, const ConflictOrigins& origins);

/// Throws UsageError when no vector driver fits the target. `driver`: empty for the one of the extension.
void check_conflict_target(const std::string& target, const std::string& driver = "");

/// Writes the layer `conflicts`, fields as in docs/formats.md, empty when there are none. `crs`: of their
/// locations. The file is
/// complete but under its temporary name: `commit` moves it into place. Throws UsageError, IoError.
std::unique_ptr<io::AtomicOutput> write_conflicts(std::span<const LineConflict> conflicts,
                                                  const ConflictOrigins& origins, const io::Crs& crs,
                                                  const std::string& target, bool overwrite,
                                                  const std::string& driver = "");

}  // namespace tinwright::tools

#endif
