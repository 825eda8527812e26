#include "tinwright/io/cell_places.hpp"

namespace tinwright::io {

FindCellPlaces make_cell_places(const GridGeometry& /*grid*/, const Crs& /*grid_crs*/, const Crs& /*plane*/) {
    return {};
}
GridBasis find_grid_basis(const Tin& tin, const Crs& /*plane*/, const Crs& /*grid_crs*/) {
    return {tin.bounds(), median_spacing(tin)};
}

}  // namespace tinwright::io
