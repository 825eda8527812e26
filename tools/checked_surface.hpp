#ifndef TINWRIGHT_TOOLS_CHECKED_SURFACE_HPP
#define TINWRIGHT_TOOLS_CHECKED_SURFACE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tinwright/io/crs.hpp"
#include "tinwright/mesh/face_check.hpp"

#include "json_value.hpp"
#include "optimality_check.hpp"

namespace tinwright::tools {

/// A TIN file after its audit.
struct CheckedSurface {
    std::string file;
    std::string layer;
    io::Crs crs;
    std::size_t vertices = 0;
    std::vector<std::int64_t> face_ids;  ///< feature id of each face
    FaceCheckReport report;
    std::optional<OptimalityReport> optimality;  ///< where asked for, and there is no violation

    /// All violations, listed or not.
    [[nodiscard]] std::size_t violation_count() const;
    [[nodiscard]] std::size_t improvable() const { return optimality ? optimality->improvable() : 0; }
};

/// One line a listed violation or improvable face.
std::string violation_lines(const CheckedSurface& surface);
/// "file: 3 violations in 120 faces".
std::string verdict_line(const CheckedSurface& surface);
/// `is_proving`: a criterion was asked for.
JsonValue checked_json(std::span<const CheckedSurface> surfaces, bool is_proving,
                       const std::vector<std::string>& outputs);

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
