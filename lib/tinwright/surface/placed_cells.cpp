#include "tinwright/surface/placed_cells.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "tinwright/geometry/predicates.hpp"

namespace tinwright {

namespace {

// A task's cells lie close together, whatever the shape of the raster: so do their faces.
constexpr std::int64_t kBlockColumns = 256;
constexpr std::int64_t kBlockRows = 32;
// Faces that a walk passes at most: a search in the tree takes as long as some more. Walks by orientation may
// go round in circles where the TIN is not Delaunay.
constexpr int kMostSteps = 24;

std::int64_t count_blocks(std::int64_t cells, std::int64_t of) { return (cells + of - 1) / of; }

}  // namespace

PlacedCells::PlacedCells(const Tin& tin, const GridGeometry& grid, const FindCellPlaces& find_places)
    : tin_(tin), find_places_(find_places), columns_(grid.columns), locator_(tin) {}

FaceId PlacedCells::walk(FaceId from, Key2 at) const {
    const TriangleMesh& mesh = tin_.mesh;
    FaceId face = from;
    for (int step = 0; step < kMostSteps && !mesh.is_ghost(face); ++step) {
        const auto& v = mesh.face(face).vertex;
        const std::array<Key2, 3> corner{locator_.lattice().scaled(tin_.key(v[0])),
                                         locator_.lattice().scaled(tin_.key(v[1])),
                                         locator_.lattice().scaled(tin_.key(v[2]))};
        bool is_inside = true;
        unsigned side = 0;
        for (; side < 3; ++side) {
            const int sign = orient2d(corner[side], corner[next_corner(side)], at);
            if (sign < 0) {
                break;
            }
            is_inside = is_inside && sign > 0;
        }
        if (side == 3) {
            return is_inside && mesh.is_terrain(face) ? face : kNoFace;
        }
        face = face_of(mesh.face(face).twin[side]);
    }
    return kNoFace;
}

FaceId PlacedCells::find(std::int64_t row, std::int64_t first, FaceId hint, Worker& worker) const {
    find_places_(row, first, worker.places);
    FaceId near = hint;
    FaceId near_first = kNoFace;
    for (std::size_t i = 0; i < worker.cells.size(); ++i) {
        const CellPlace& place = worker.places[i];
        PlacedCell& cell = worker.cells[i];
        cell = {{kNoFace, locator_.lattice().at(place.position)}, place.north};
        if (!QueryLattice::is_near(cell.place.at)) {
            continue;
        }
        if (near != kNoFace) {
            cell.place.face = walk(near, cell.place.at);
        }
        if (cell.place.face == kNoFace) {
            const auto found = locator_.find(cell.place.at);
            cell.place.face = found ? found->face : kNoFace;
        }
        if (cell.place.face != kNoFace) {
            near = cell.place.face;
            near_first = near_first == kNoFace ? near : near_first;
        }
    }
    return near_first == kNoFace ? hint : near_first;
}

void PlacedCells::visit(std::int64_t first_row, std::int64_t end_row, const Visit& visit) const {
    const std::int64_t across = count_blocks(columns_, kBlockColumns);
    const std::int64_t blocks = across * count_blocks(end_row - first_row, kBlockRows);
    tbb::enumerable_thread_specific<Worker> workers;
    tbb::parallel_for(
        tbb::blocked_range<std::int64_t>(0, blocks, 1),
        [&](const auto& range) {
            Worker& worker = workers.local();
            for (std::int64_t block = range.begin(); block != range.end(); ++block) {
                const std::int64_t first = block % across * kBlockColumns;
                const std::int64_t row = first_row + block / across * kBlockRows;
                const auto count = static_cast<std::size_t>(std::min(kBlockColumns, columns_ - first));
                worker.places.resize(count);
                worker.cells.resize(count);
                FaceId near = kNoFace;
                for (std::int64_t r = row; r < std::min(row + kBlockRows, end_row); ++r) {
                    near = find(r, first, near, worker);
                    visit(r, first, worker.cells);
                }
            }
        },
        tbb::simple_partitioner());
}

}  // namespace tinwright
