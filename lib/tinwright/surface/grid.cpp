#include "tinwright/surface/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

constexpr double kMostCells = 2147483647;  // columns or rows: what GDAL counts with

std::string pair(double x, double y) { return decimal_text(x) + " by " + decimal_text(y); }

/// Decimal numbers as whole steps of the finest digit among them.
struct Steps {
    Int128 low = 0;
    Int128 high = 0;
    Int128 cell = 1;
    int exponent = 0;
};

std::optional<Steps> find_steps(double low, double high, double cell) {
    const std::array<Decimal, 3> decimal{shortest_decimal(low), shortest_decimal(high),
                                         shortest_decimal(cell)};
    Steps steps;
    steps.exponent = std::min({decimal[0].exponent, decimal[1].exponent, decimal[2].exponent});
    const auto low_steps = whole_steps(decimal[0], steps.exponent);
    const auto high_steps = whole_steps(decimal[1], steps.exponent);
    const auto cell_steps = whole_steps(decimal[2], steps.exponent);
    if (!low_steps || !high_steps || !cell_steps) {
        return std::nullopt;
    }
    steps.low = *low_steps;
    steps.high = *high_steps;
    steps.cell = *cell_steps;
    return steps;
}

Int128 floor_divide(Int128 value, Int128 by) { return value / by - (value % by < 0 ? 1 : 0); }
Int128 ceil_divide(Int128 value, Int128 by) { return -floor_divide(-value, by); }

/// ceil(quotient), unless the quotient is a whole number but for rounding noise.
double ceil_but_noise(double quotient) {
    const double nearest = std::round(quotient);
    return std::abs(quotient - nearest) <= 1e-9 * std::max(1.0, nearest) ? nearest : std::ceil(quotient);
}

/// How many cells cover low..high. Decided on the decimal numbers: 0.3 is three times 0.1.
double count_cells(double low, double high, double cell) {
    const double quotient = (high - low) / cell;
    if (!(quotient < kMostCells + 1)) {
        return quotient;
    }
    const std::optional<Steps> steps = find_steps(low, high, cell);
    // A cell of 16 digits or more is itself a rounded quotient, such as a third of a metre.
    const bool is_decimal = steps && std::abs(static_cast<double>(shortest_decimal(cell).digits)) < 1e15;
    return std::max(1.0, is_decimal ? static_cast<double>(ceil_divide(steps->high - steps->low, steps->cell))
                                    : ceil_but_noise(quotient));
}

/// Grows low..high to multiples of `cell`.
void align(double& low, double& high, double cell) {
    if (const std::optional<Steps> steps = find_steps(low, high, cell)) {
        low = from_steps(floor_divide(steps->low, steps->cell) * steps->cell, steps->exponent);
        high = from_steps(ceil_divide(steps->high, steps->cell) * steps->cell, steps->exponent);
    } else {
        low = std::floor(low / cell) * cell;
        high = std::ceil(high / cell) * cell;
    }
}

/// `value` > 0 rounded to 1, 2 or 5 times a power of ten, by ratio.
double round_to_series(double value) {
    int exponent = static_cast<int>(std::floor(std::log10(value)));
    const double lead = value / std::pow(10.0, exponent);
    int digit = 1;
    if (lead >= std::sqrt(50.0)) {
        ++exponent;
    } else if (lead >= std::sqrt(10.0)) {
        digit = 5;
    } else if (lead >= std::sqrt(2.0)) {
        digit = 2;
    }
    return from_steps(digit, exponent);
}

Box choose_extent(const Box& bounds, const GridRequest& request) {
    const Box extent = request.extent ? *request.extent : bounds;
    if (!request.extent && extent.is_empty()) {
        throw InputError("the surface has no faces to make a grid of");
    }
    const bool is_finite = std::isfinite(extent.x_min) && std::isfinite(extent.y_min) &&
                           std::isfinite(extent.x_max) && std::isfinite(extent.y_max);
    if (!is_finite || !(extent.x_min < extent.x_max) || !(extent.y_min < extent.y_max)) {
        throw UsageError("--extent " + decimal_text(extent.x_min) + " " + decimal_text(extent.y_min) + " " +
                         decimal_text(extent.x_max) + " " + decimal_text(extent.y_max) +
                         " is empty; give xmin ymin xmax ymax with xmin < xmax and ymin < ymax");
    }
    return extent;
}

void check_request(const GridRequest& request) {
    if (request.resolution) {
        const auto [x, y] = *request.resolution;
        if (!(std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0)) {
            throw UsageError("--resolution " + decimal_text(x) + " " + decimal_text(y) +
                             " must be greater than zero");
        }
    }
    if (request.size && (request.size->columns < 1 || request.size->rows < 1)) {
        throw UsageError("--size " + std::to_string(request.size->columns) + " " +
                         std::to_string(request.size->rows) + " must be at least 1 1");
    }
    if (request.align_to_resolution && !request.resolution) {
        throw UsageError("--tap aligns the grid with multiples of the resolution; add --resolution");
    }
}

Point2 choose_resolution(double spacing, const GridRequest& request, const Box& extent) {
    if (request.resolution) {
        return *request.resolution;
    }
    if (request.size) {
        // Decimal differences: 0.3 - 0.1 is 0.2.
        const auto length = [](double low, double high) {
            const std::optional<Steps> steps = find_steps(low, high, 1);
            return steps ? from_steps(steps->high - steps->low, steps->exponent) : high - low;
        };
        return {length(extent.x_min, extent.x_max) / static_cast<double>(request.size->columns),
                length(extent.y_min, extent.y_max) / static_cast<double>(request.size->rows)};
    }
    if (!(spacing > 0)) {
        throw InputError("the surface has no faces to find a resolution from; give --resolution");
    }
    const double resolution = round_to_series(spacing / 2);
    return {resolution, resolution};
}

}  // namespace

Box GridGeometry::extent() const {
    return {x_min, y_max - static_cast<double>(rows) * cell_height,
            x_min + static_cast<double>(columns) * cell_width, y_max};
}

GridGeometry choose_grid(const Tin& tin, const GridRequest& request) {
    const bool is_spacing_wanted = !request.resolution && !request.size;
    return choose_grid(
        {request.extent ? *request.extent : tin.bounds(), is_spacing_wanted ? median_spacing(tin) : 0},
        request);
}

GridGeometry choose_grid(const GridBasis& basis, const GridRequest& request) {
    check_request(request);
    Box extent = choose_extent(basis.bounds, request);
    const Point2 resolution = choose_resolution(basis.spacing, request, extent);
    if (request.align_to_resolution) {
        align(extent.x_min, extent.x_max, resolution.x);
        align(extent.y_min, extent.y_max, resolution.y);
    }
    double columns = count_cells(extent.x_min, extent.x_max, resolution.x);
    double rows = count_cells(extent.y_min, extent.y_max, resolution.y);
    if (request.size) {
        const auto asked_columns = static_cast<double>(request.size->columns);
        const auto asked_rows = static_cast<double>(request.size->rows);
        const bool is_free = !request.resolution || (!request.extent && !request.align_to_resolution);
        if (!is_free && (asked_columns != columns || asked_rows != rows)) {
            throw UsageError("--size " + decimal_text(asked_columns) + " " + decimal_text(asked_rows) +
                             " contradicts --extent and --resolution, which make " + pair(columns, rows) +
                             " cells; drop one of the three");
        }
        columns = asked_columns;
        rows = asked_rows;
    }
    if (!(columns <= kMostCells && rows <= kMostCells)) {
        throw UsageError("a resolution of " + pair(resolution.x, resolution.y) + " makes a raster of " +
                         pair(columns, rows) +
                         " cells, more than 2147483647 a side; give a coarser --resolution or a smaller "
                         "--extent");
    }
    return {extent.x_min,
            extent.y_max,
            resolution.x,
            resolution.y,
            static_cast<std::int64_t>(columns),
            static_cast<std::int64_t>(rows)};
}

double median_spacing(const Tin& tin) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::vector<double> shortest(tin.vertex_count(), kNone);  // squared, in keys
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        const auto& vertex = tin.mesh.face({f}).vertex;
        for (unsigned corner = 0; corner < 3; ++corner) {
            const VertexId from = vertex[corner];
            const VertexId to = vertex[next_corner(corner)];
            const double dx = tin.key(to).x - tin.key(from).x;
            const double dy = tin.key(to).y - tin.key(from).y;
            const double squared = dx * dx + dy * dy;
            shortest[from.value] = std::min(shortest[from.value], squared);
            shortest[to.value] = std::min(shortest[to.value], squared);
        }
    }
    std::erase(shortest, kNone);
    if (shortest.empty()) {
        return 0;
    }
    const auto middle = shortest.begin() + static_cast<std::ptrdiff_t>(shortest.size() / 2);
    std::nth_element(shortest.begin(), middle, shortest.end());
    return std::sqrt(*middle) * tin.lattice.quantum();
}

}  // namespace tinwright
