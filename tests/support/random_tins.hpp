#ifndef TINWRIGHT_TESTS_SUPPORT_RANDOM_TINS_HPP
#define TINWRIGHT_TESTS_SUPPORT_RANDOM_TINS_HPP

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/mesh/tin.hpp"

#include "support/point_sets.hpp"
#include "support/triangulation_oracle.hpp"

/// Small seeded TINs to be optimised, and what the oracles have to know of them.
namespace tinwright_tests {

/// A kind of TIN; `make` gives the Delaunay TIN of about `count` vertices, or one without faces.
struct TinFamily {
    const char* name;
    tinwright::Tin (*make)(Random& random, std::size_t count);
};

/// Without collinear, co-circular or coplanar vertices but by a chance of less than one in a million:
/// squares, strips, near-convex rings, clusters; elevations at random, of a hill, of a cliff.
std::span<const TinFamily> general_families();

/// With many equal measures: lattices, rows, circles, within a key of both, flat with a cliff, terraces.
std::span<const TinFamily> degenerate_families();

/// The Delaunay TIN of these sites, the vertices in curve order; repeated keys are left out.
tinwright::Tin tin_of_sites(const std::vector<oracle::Site>& sites);

/// The TIN with these counter-clockwise faces, three indices of `sites` each.
tinwright::Tin tin_of_faces(const std::vector<oracle::Site>& sites,
                            const std::vector<std::uint32_t>& corners);

/// Tries to flip as many random edges, without a look at any measure.
void flip_at_random(Random& random, tinwright::Tin& tin, int count);
/// Marks so many random edges as constrained (the same one perhaps twice).
void constrain_at_random(Random& random, tinwright::Tin& tin, int count);
/// Marks so many random faces as not terrain, but one stays.
void make_voids_at_random(Random& random, tinwright::Tin& tin, int count);

/// The vertices; as constraints the constrained edges and those of faces that are not terrain.
oracle::Sites sites_of(const tinwright::Tin& tin);
oracle::Site site_of(const tinwright::Tin& tin, tinwright::VertexId v);
/// Sorted badnesses, worst first, of the terrain faces or of all but ghosts. `norm` is for length.
enum class Faces { Terrain, All };
std::vector<long double> badnesses_of(const tinwright::Tin& tin, tinwright::Criterion criterion, Faces which,
                                      tinwright::Norm norm = {});
/// The number in CRS units that a report should give for a badness.
double report_of(const tinwright::Tin& tin, tinwright::Criterion criterion, long double badness);

/// Whether two numbers agree to 1e-9 of the larger.
bool are_close(long double a, long double b);
bool are_close(const std::vector<long double>& a, const std::vector<long double>& b);

/// Sorted measures of the terrain faces, worst first, bit for bit as the engine compares them.
std::vector<double> measures_of(const tinwright::Tin& tin, tinwright::Criterion criterion,
                                tinwright::Norm norm = {});

/// Whether both audits find nothing.
bool is_sound(const tinwright::Tin& tin);

/// Vertices, faces and constrained edges as text, to build a failing case again.
std::string describe(const tinwright::Tin& tin);

}  // namespace tinwright_tests

#endif
