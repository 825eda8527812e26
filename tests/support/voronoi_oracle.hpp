#ifndef TINWRIGHT_TESTS_SUPPORT_VORONOI_ORACLE_HPP
#define TINWRIGHT_TESTS_SUPPORT_VORONOI_ORACLE_HPP

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

/// Voronoi cells by cutting half-planes off a large square, one for every other site.
namespace tinwright_tests::oracle {

/// What a new site has to do with an old one.
struct CellShare {
    std::size_t site = 0;
    long double area = 0;  ///< that the new cell takes from the old one
    long double side = 0;  ///< length of the side between both cells over the distance of the sites
};

/// The shares of all sites that the cell of `place`, none of them, has a side with; empty if the cell reaches
/// a thousand times farther than the sites. O(n^2).
std::optional<std::vector<CellShare>> voronoi_shares(std::span<const tinwright::Key2> sites,
                                                     tinwright::Key2 place);

}  // namespace tinwright_tests::oracle

#endif
