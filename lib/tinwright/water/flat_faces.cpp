#include "tinwright/water/flat_faces.hpp"

#include <chrono>

#include "tinwright/water/flat_axes.hpp"
#include "tinwright/water/flat_points.hpp"
#include "tinwright/water/flat_regions.hpp"
#include "tinwright/water/flat_swaps.hpp"

namespace tinwright {

FlatFacesReport remove_flat_faces(Tin& tin, FlatFaces how, const std::vector<bool>& is_water,
                                  bool keeps_delaunay) {
    const auto start = std::chrono::steady_clock::now();
    FlatFacesReport report;
    report.before = count_flat_faces(tin, is_water);
    if (report.before > 0 && how == FlatFaces::Insert) {
        const internal::FlatRegions regions(tin, is_water);
        const internal::FlatAxes axes = internal::find_flat_axes(tin, regions);
        std::vector<double> z = internal::find_axis_elevations(tin, axes);
        if (!keeps_delaunay) {
            internal::leave_out_single_faces(axes, z);
        }
        const internal::InsertedPoints points = internal::insert_axis_points(tin, axes, z);
        report.inserted = points.count;
        if (keeps_delaunay) {
            internal::restore_delaunay(tin);
        } else {
            internal::restore_delaunay_around(tin, points.edges);  // from bank to bank would dam a valley
        }
    }
    if (report.before > 0 && how != FlatFaces::Keep && !keeps_delaunay) {
        // What is left may look different then: parts of regions, with rims of their own.
        std::size_t swapped = 0;
        do {
            swapped = internal::swap_flat_edges(tin, internal::FlatRegions(tin, is_water));
            report.swapped += swapped;
        } while (swapped > 0);
    }
    report.after = count_flat_faces(tin, is_water);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

std::size_t count_flat_faces(const Tin& tin, const std::vector<bool>& is_water) {
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        const bool is_dry = tin.mesh.is_terrain({f}) && (f >= is_water.size() || !is_water[f]);
        count += is_dry && internal::is_flat(tin, {f}) ? 1U : 0U;
    }
    return count;
}

}  // namespace tinwright
