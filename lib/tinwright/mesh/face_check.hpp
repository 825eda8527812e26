#ifndef TINWRIGHT_MESH_FACE_CHECK_HPP
#define TINWRIGHT_MESH_FACE_CHECK_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "tinwright/geometry/point.hpp"

/// Audit of loose faces, as they stand in a file, before a TIN can be made of them.
namespace tinwright {

/// What can be wrong with faces. The order is that of the audit: a face that is not finite, repeated or
/// without area is left out of the later tests, a clockwise one is turned round.
enum class FaceDefect {
    NotFinite,     ///< a coordinate or elevation of the face is not finite
    ZeroArea,      ///< the three corners are collinear or not distinct, seen from above
    Clockwise,     ///< corners in clockwise order, seen from above
    Repeated,      ///< same three locations as an earlier face
    SharedEdge,    ///< an edge has this face and an earlier one on the same side, or more than two faces
    Crack,         ///< one location, two elevations
    VertexOnEdge,  ///< a vertex lies on an edge of this face that nothing shares (T-junction)
    Overlap,       ///< the interiors of two faces meet
};
inline constexpr std::size_t kFaceDefects = 8;

/// A few words in the plural-free form that a list wants, e.g. "no area".
std::string_view text_of(FaceDefect defect);

struct FaceViolation {
    static constexpr std::size_t kNoFace = std::numeric_limits<std::size_t>::max();

    FaceDefect defect = FaceDefect::NotFinite;
    std::size_t face = 0;         ///< index of the face, in the order handed in
    std::size_t other = kNoFace;  ///< an earlier face concerned, or kNoFace
    /// Where, CRS units: the vertex of Crack and VertexOnEdge, the middle of the edge of SharedEdge, else the
    /// first corner of the face; a point common to both for Overlap. Crack: z is the elevation in `face`.
    Point3 location;
    double other_z = 0;  ///< Crack: the elevation in `other`
};

struct FaceCheckOptions {
    /// Violations of each kind that are listed; the rest is counted only.
    std::size_t limit = 1000;
};

struct FaceCheckReport {
    std::vector<FaceViolation> violations;           ///< by kind, then face, then other
    std::array<std::size_t, kFaceDefects> counts{};  ///< all violations, by kind
    [[nodiscard]] std::size_t count(FaceDefect defect) const {
        return counts[static_cast<std::size_t>(defect)];
    }
    [[nodiscard]] bool is_clean() const { return counts == std::array<std::size_t, kFaceDefects>{}; }
};

/// Finds everything that keeps faces from being a TIN.
///
/// `vertices`: n of them, repeated locations allowed (compared as lattice keys). `corners`: 3f indices into
/// them, three a face. Decisions are exact on the keys of `find_lattice(vertices)`; where that lattice is
/// not exact, coordinates count as moved by at most half its quantum.
/// Throws InputError when a corner is out of range.
/// O(n log n) for the sizes found in practice; parallel inside the caller's task arena, same report for
/// any number of threads.
FaceCheckReport check_faces(std::span<const Point3> vertices, std::span<const std::uint32_t> corners,
                            const FaceCheckOptions& options = {});

}  // namespace tinwright

#endif
