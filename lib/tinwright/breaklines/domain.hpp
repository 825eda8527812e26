#ifndef TINWRIGHT_BREAKLINES_DOMAIN_HPP
#define TINWRIGHT_BREAKLINES_DOMAIN_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/geometry/ground_measures.hpp"
#include "tinwright/mesh/tin.hpp"

/// Which faces are terrain. Decided on the Delaunay TIN, before anything is optimised.
namespace tinwright {

struct DomainRule {
    enum class Kind { Convex, Trimmed, Concave };
    Kind kind = Kind::Convex;
    double length = 0;  ///< Concave only: border edges longer than this (CRS units, > 0) are opened
};

struct DomainReport {
    std::size_t cut_faces = 0;      ///< faces marked outside by boundaries and holes
    std::size_t trimmed_faces = 0;  ///< border faces marked outside by the rule
    std::size_t void_faces = 0;     ///< faces marked outside by `drop_long_faces`
};

/// Marks the faces that boundaries and holes cut off: those inside no polygon of role Boundary, if there is
/// any, and those inside one of role Hole. Decided by walking the mesh from outside the hull and counting
/// the rings passed, so only the rings' traces must be right, not their directions.
/// `lines`: those that `tin.traces` number. `terrain_ring`: the number of one more line, a ring outside which
/// is no terrain either; its traces go. Returns how many faces were marked. O(slots + traces log n), and
/// the number of polygons around a place for each area between rings.
std::size_t apply_polygons(Tin& tin, std::span<const Breakline> lines,
                           std::optional<std::uint32_t> terrain_ring = {});

/// Which face slots are water: terrain inside a polygon of role Lake or Bank. `lines`: those that
/// `tin.traces` number; empty where no line is such a polygon. Exact, and decided as `apply_polygons` does,
/// for each part of the mesh (of faces that share edges) from outside its outer border, where no water is.
/// O(slots + traces log n + hull log hull).
std::vector<bool> find_water_faces(const Tin& tin, std::span<const Breakline> lines);

/// Marks the faces outside the domain; every sample stays on or inside its border, which remains one
/// closed curve per surface without pinches. Faces already outside stay outside.
///
/// Trimmed: as long as there is one, the flattest needle on the border is dropped. A needle is a face with
/// exactly one border edge, whose opposite vertex is not on the border, and whose height over the border
/// edge is less than a tenth of that edge: a rule without scale. No face goes through a constrained edge.
/// Concave: as long as there is one, the longest border edge above `length` is opened, by dropping its face
/// if the opposite vertex is not on the border [duckham2008].
/// Returns how many faces were dropped. O(n + b log b), b border faces looked at. Result independent of
/// vertex numbering up to exact ties, which break on vertex ids.
std::size_t apply_domain(Tin& tin, const DomainRule& rule);

/// Marks every terrain face with an edge longer on the ground than `length` (`ground.unit`, > 0) as outside:
/// voids without data. Samples may be left without a face. `is_kept`: faces that stay whatever their edges,
/// water say; empty: none. O(n); only edges whose length in the plane is within `ground.distortion` of the
/// limit are measured by its function.
std::size_t drop_long_faces(Tin& tin, double length, const std::vector<bool>& is_kept = {},
                            const GroundMeasures& ground = {});

/// Constrains every border edge of the domain, so that nothing done later moves it. O(n).
void constrain_border(Tin& tin);

}  // namespace tinwright

#endif
