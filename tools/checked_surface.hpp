#ifndef TINWRIGHT_TOOLS_CHECKED_SURFACE_HPP
#define TINWRIGHT_TOOLS_CHECKED_SURFACE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/mesh/face_check.hpp"

#include "json_value.hpp"
#include "optimality_check.hpp"
#include "options_crs.hpp"
#include "progress.hpp"

namespace tinwright::tools {

/// What a file with lines in it says of being conforming, and what is true.
struct ConformityReport {
    std::size_t line_edges = 0;  ///< edges that are parts of lines
    std::size_t open_edges = 0;  ///< of these, those without an empty disk: not Delaunay
    bool is_claimed = false;     ///< whether the metadata say that there are none
    [[nodiscard]] bool is_refuted() const { return is_claimed && open_edges > 0; }
};

/// A TIN file after its audit.
struct CheckedSurface {
    std::string file;
    std::string layer;
    io::Crs crs;
    std::size_t vertices = 0;
    std::vector<std::int64_t> face_ids;  ///< feature id of each face
    FaceCheckReport report;
    std::optional<ConformityReport> conformity;  ///< where the file tells which edges are parts of lines
    std::optional<OptimalityReport> optimality;  ///< where asked for, and there is no violation

    /// All violations, listed or not; a claim to be conforming that is refuted is one too.
    [[nodiscard]] std::size_t violation_count() const;
    [[nodiscard]] std::size_t improvable() const { return optimality ? optimality->improvable() : 0; }
};

/// Reads and audits a TIN file, and proves it optimal again where `optimality` asks for that. `begin`, `end`:
/// its share of the progress. Throws as `io::read_tin_file` does.
CheckedSurface check_surface(const io::Source& source, const CrsOptions& crs,
                             const OptimalityOptions& optimality, ProgressLine& progress, double begin,
                             double end);

/// One line a listed violation or improvable face.
std::string violation_lines(const CheckedSurface& surface);
/// "file: 3 violations in 120 faces", and what came of a proof where `optimality` asked for one.
std::vector<std::string> verdicts(const CheckedSurface& surface, const OptimalityOptions& optimality);
/// An entry of the key `surfaces` of the report.
JsonValue surface_json(const CheckedSurface& surface);

struct ViolationLayerOptions {
    std::string driver;  ///< empty: from the file's extension
    bool overwrite = false;
};

/// Throws UsageError when no vector driver fits the target.
void check_violation_target(const std::string& target, const ViolationLayerOptions& options);

/// Writes the listed violations and improvable faces as points, with the fields `surface` (number of the
/// file, from 1), `kind`, `face` and `other` (feature ids). Throws UsageError, IoError.
void write_violations(std::span<const CheckedSurface> surfaces, const std::string& target,
                      const ViolationLayerOptions& options);

}  // namespace tinwright::tools

#endif
