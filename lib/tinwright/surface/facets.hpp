#ifndef TINWRIGHT_SURFACE_FACETS_HPP
#define TINWRIGHT_SURFACE_FACETS_HPP

#include <memory>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/interpolator.hpp"

namespace tinwright {

/// A surface that is read from the facets themselves on some faces, on water say, and by another method on
/// all others. `is_facet`: by face slot; empty: none, and `surface` comes back as it is, as it does when it
/// is null, which stands for the facets. Where the edges between are sharp, all methods but nearest are
/// straight along them, so that the surface is continuous. A facet whose corners have one elevation has it
/// everywhere, bit for bit, its edges included where they are read from its side. `tin` must outlive the
/// result.
std::unique_ptr<Interpolator> keep_facets(const Tin& tin, std::unique_ptr<Interpolator> surface,
                                          std::vector<bool> is_facet);

}  // namespace tinwright

#endif
