#include "tinwright/io/cell_places.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/io/angular_unit.hpp"
#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/geographic_extent.hpp"
#include "tinwright/io/place_polynomial.hpp"

namespace tinwright::io {

namespace {

// Rows and columns of a block to begin with: large, so that exact points are few.
constexpr std::int64_t kBlockCells = 256;
// Parts of blocks, with and without polynomials, that are kept: 100 bytes to a kilobyte each.
constexpr std::int64_t kKeptParts = 1 << 16;
// Rows of blocks that are kept whatever they take: some threads may be at work in one while others are in the
// next.
constexpr std::size_t kKeptRows = 4;

/// A block of cells: its polynomial, its parts, or neither, where cells are exact.
struct PlacedBlock {
    CellBlock cells;
    std::unique_ptr<PlacePolynomial> polynomial;
    std::vector<PlacedBlock> parts;

    PlacedBlock(const CellBlock& of, const ExactPlaces& exact);
    [[nodiscard]] std::int64_t count_parts() const;
    /// Of the columns asked for those that it has.
    void find(std::int64_t row, std::int64_t first, std::span<CellPlace> places,
              const ExactPlaces& exact) const;
};

PlacedBlock::PlacedBlock(const CellBlock& of, const ExactPlaces& exact) : cells(of) {
    // Few cells are exact at no more cost.
    if (cells.rows * cells.columns <= PlacePolynomial::kExactPoints) {
        return;
    }
    if (auto fitted = PlacePolynomial::fit(cells, exact, kCellPlaceError / 10)) {
        polynomial = std::make_unique<PlacePolynomial>(std::move(*fitted));
        return;
    }
    // Long blocks, at the raster's edges, are halved across.
    const std::int64_t rows = cells.columns > 2 * cells.rows ? cells.rows : (cells.rows + 1) / 2;
    const std::int64_t columns = cells.rows > 2 * cells.columns ? cells.columns : (cells.columns + 1) / 2;
    for (std::int64_t row = 0; row < cells.rows; row += rows) {
        for (std::int64_t column = 0; column < cells.columns; column += columns) {
            parts.emplace_back(
                CellBlock{cells.row + row, cells.column + column, std::min(rows, cells.rows - row),
                          std::min(columns, cells.columns - column)},
                exact);
        }
    }
}

std::int64_t PlacedBlock::count_parts() const {
    std::int64_t count = 1;
    for (const PlacedBlock& part : parts) {
        count += part.count_parts();
    }
    return count;
}

void PlacedBlock::find(std::int64_t row, std::int64_t first, std::span<CellPlace> places,
                       const ExactPlaces& exact) const {
    const std::int64_t begin = std::max(first, cells.column);
    const std::int64_t end =
        std::min(first + static_cast<std::int64_t>(places.size()), cells.column + cells.columns);
    if (row < cells.row || row >= cells.row + cells.rows || begin >= end) {
        return;
    }
    for (const PlacedBlock& part : parts) {
        part.find(row, first, places, exact);
    }
    const std::span<CellPlace> own =
        places.subspan(static_cast<std::size_t>(begin - first), static_cast<std::size_t>(end - begin));
    if (polynomial) {
        polynomial->find(row, begin, own);
    } else if (parts.empty()) {
        exact.find(row, begin, own);
    }
}

/// Blocks side by side, made when they are asked for.
class BlockRow {
  public:
    explicit BlockRow(std::int64_t columns) : slots_(static_cast<std::size_t>(columns)) {}

    const PlacedBlock& block(const CellBlock& cells, const ExactPlaces& exact) {
        Slot& slot = slots_[static_cast<std::size_t>(cells.column / kBlockCells)];
        std::call_once(slot.is_made, [&] {
            slot.block = std::make_unique<const PlacedBlock>(cells, exact);
            parts_ += slot.block->count_parts();
        });
        return *slot.block;
    }
    [[nodiscard]] std::int64_t parts() const { return parts_; }

  private:
    struct Slot {
        std::once_flag is_made;
        std::unique_ptr<const PlacedBlock> block;
    };
    std::vector<Slot> slots_;
    std::atomic<std::int64_t> parts_ = 0;
};

/// All the places of a raster.
class RasterPlaces {
  public:
    explicit RasterPlaces(ExactPlaces exact) : exact_(std::move(exact)) {}

    void find(std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
        const GridGeometry& grid = exact_.grid();
        const std::int64_t top = row - row % kBlockCells;
        const std::shared_ptr<BlockRow> blocks = row_of_blocks(row / kBlockCells);
        const std::int64_t end = first + static_cast<std::int64_t>(places.size());
        for (std::int64_t left = first - first % kBlockCells; left < end; left += kBlockCells) {
            const CellBlock cells{top, left, std::min(kBlockCells, grid.rows - top),
                                  std::min(kBlockCells, grid.columns - left)};
            blocks->block(cells, exact_).find(row, first, places, exact_);
        }
    }
    [[nodiscard]] const ExactPlaces& exact() const { return exact_; }

  private:
    struct Entry {
        std::shared_ptr<BlockRow> blocks;
        std::uint64_t used = 0;
    };

    std::shared_ptr<BlockRow> row_of_blocks(std::int64_t number) {
        const std::scoped_lock lock(mutex_);
        Entry& entry = rows_[number];
        entry.used = ++uses_;
        if (entry.blocks == nullptr) {
            entry.blocks =
                std::make_shared<BlockRow>((exact_.grid().columns + kBlockCells - 1) / kBlockCells);
            std::shared_ptr<BlockRow> made = entry.blocks;
            forget_some();
            return made;
        }
        return entry.blocks;
    }
    /// Lets go of the rows that have not been asked for the longest, where they take too much; whoever is at
    /// work in one keeps it.
    void forget_some() {
        std::int64_t parts = 0;
        for (const auto& [number, entry] : rows_) {
            parts += entry.blocks->parts();
        }
        while (rows_.size() > kKeptRows && parts > kKeptParts) {
            const auto oldest =
                std::min_element(rows_.begin(), rows_.end(),
                                 [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
            parts -= oldest->second.blocks->parts();
            rows_.erase(oldest);
        }
    }

    ExactPlaces exact_;
    std::mutex mutex_;
    std::map<std::int64_t, Entry> rows_;
    std::uint64_t uses_ = 0;
};

/// Where a raster is, degrees.
GeographicExtent extent_of(const GridGeometry& grid, const Crs& grid_crs) {
    constexpr int kSteps = 40;
    const Crs geographic = grid_crs.geographic();
    if (!geographic.is_known()) {
        return {};
    }
    const Box box = grid.extent();
    std::vector<Point3> points;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            const double u = static_cast<double>(j) / kSteps;
            const double v = static_cast<double>(i) / kSteps;
            points.push_back(
                {box.x_min + u * (box.x_max - box.x_min), box.y_min + v * (box.y_max - box.y_min), 0});
        }
    }
    to_degrees(grid_crs, points);
    ExtentGatherer gatherer;
    gatherer.add(points);
    return gatherer.extent();
}

std::shared_ptr<RasterPlaces> make_places(const GridGeometry& grid, const Crs& grid_crs, const Crs& plane) {
    const GeographicExtent extent = extent_of(grid, grid_crs);
    return std::make_shared<RasterPlaces>(ExactPlaces(
        grid, CoordinateTransform(grid_crs.horizontal(), plane.horizontal(), {.extent = extent})));
}

}  // namespace

FindCellPlaces make_cell_places(const GridGeometry& grid, const Crs& grid_crs, const Crs& plane) {
    return make_raster_placing(grid, grid_crs, plane).find_places;
}

RasterPlacing make_raster_placing(const GridGeometry& grid, const Crs& grid_crs, const Crs& plane) {
    const std::shared_ptr<RasterPlaces> raster = make_places(grid, grid_crs, plane);
    RasterPlacing placing;
    placing.to_raster = [raster](std::span<Point2> positions) {
        raster->exact().transform().inverse(positions);
    };
    placing.find_places = [raster](std::int64_t row, std::int64_t first, std::span<CellPlace> places) {
        raster->find(row, first, places);
    };
    placing.period = grid_crs.is_geographic() ? 360 / degrees_per_unit(grid_crs) : 0;
    return placing;
}

}  // namespace tinwright::io
