#ifndef TINWRIGHT_SURFACE_FACETS_HPP
#define TINWRIGHT_SURFACE_FACETS_HPP

#include <memory>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/interpolator.hpp"

namespace tinwright {

/// A surface that is read from the facets themselves on some faces, on water say, and by another method on
/// all others. `is_facet`: by face slot; empty: none, and `surface` comes back as it is. Where the edges
/// between are sharp, the methods are linear along them, so that the surface is continuous; nearest is not
/// anyway.
std::unique_ptr<Interpolator> keep_facets(const Tin& tin, std::unique_ptr<Interpolator> surface,
                                          std::vector<bool> is_facet);

}  // namespace tinwright

#endif
