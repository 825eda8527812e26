#ifndef TINWRIGHT_TOOLS_LENGTH_CHECK_HPP
#define TINWRIGHT_TOOLS_LENGTH_CHECK_HPP

#include <cstdint>
#include <optional>
#include <string>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/read_tin.hpp"
#include "tinwright/optimal/length_certificate.hpp"

#include "json_value.hpp"

/// Proving again that the longest edge of a TIN file is as short as it can be, for `tinwright check`.
namespace tinwright::tools {

/// What is to be proven, and how.
struct LengthCheckOptions {
    std::optional<Norm> norm;  ///< empty: the one that the file was made with
    bool all = false;          ///< large polygons too
};

/// What is found in one file.
struct LengthCheck {
    Norm norm;
    std::string made_with;       ///< the norm in which the file says that it was made for length; or empty
    bool is_unfinished = false;  ///< the file says that a budget or an interrupt ended its optimising
    std::optional<std::size_t> largest_polygon;  ///< that was triangulated anew; empty: no limit
    LengthCertificate certificate;               ///< with vertices that mean nothing outside
    std::int64_t face = 0;                       ///< feature id of a face with the longest edge
    Point3 from;                                 ///< ends of that edge
    Point3 to;

    [[nodiscard]] bool is_improvable() const { return certificate.attainable.has_value(); }
};

/// `file`: without violations; `tin`: made of it. Throws Cancelled.
LengthCheck check_length(const io::TinFile& file, const Tin& tin, const LengthCheckOptions& options,
                         const Progress& progress);

/// "length, norm l2: no triangulation has a shorter longest edge than 12.5, ...".
std::string length_verdict(const LengthCheck& check);
/// One line beginning with the file's name, where the longest edge can be shorter; else empty.
std::string length_line(const LengthCheck& check, const std::string& file);
/// The object `optimality` of the JSON report.
JsonValue length_json(const LengthCheck& check);

}  // namespace tinwright::tools

#endif
