#include "tinwright/io/raster_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <cpl_conv.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright::io {

namespace {

/// Lowest and highest elevation of the vertices, those of no face included: a quick look.
std::pair<double, double> find_vertex_range(const Tin& tin) {
    const auto [lowest, highest] = std::minmax_element(tin.z.begin(), tin.z.end());
    return tin.z.empty() ? std::pair(0.0, 0.0) : std::pair(*lowest, *highest);
}

/// Lowest and highest elevation of the terrain.
std::pair<double, double> find_terrain_range(const Tin& tin) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            for (const VertexId v : tin.mesh.face({f}).vertex) {
                lowest = std::min(lowest, tin.z[v.value]);
                highest = std::max(highest, tin.z[v.value]);
            }
        }
    }
    return {lowest, highest};
}

/// Float32 tells whole numbers apart up to here.
constexpr double kExactInFloat = 16777216;

/// More than any slope or gradient that means something; Float32 holds it.
constexpr double kSteepest = 1e30;

double highest_slope(SlopeUnit unit) { return unit == SlopeUnit::Degree ? 90 : kSteepest; }

ValueRange elevation_range(const Tin& tin, const WriteGridOptions& options, bool is_quick) {
    auto [lowest, highest] = is_quick ? find_vertex_range(tin) : find_terrain_range(tin);
    const bool is_bounded = options.surface == nullptr || options.is_surface_bounded;
    const double beyond = is_bounded ? 0 : highest - lowest;
    return {lowest - beyond, highest + beyond, is_bounded};
}

ValueRange range_of(Product product, const Tin& tin, const WriteGridOptions& options, bool is_quick) {
    switch (product) {
        case Product::Elevation:
            return elevation_range(tin, options, is_quick);
        case Product::Slope:
            return {0, highest_slope(options.gridding.slope_unit)};
        case Product::Aspect:
            return {0, 360};
        case Product::GradientX:
        case Product::GradientY:
            return {-kSteepest, kSteepest, false};
        case Product::Hillshade:
            return {1, 255};
        case Product::NearestDistance: {
            const Box bounds = tin.bounds();
            return {0, std::hypot(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min)};
        }
        case Product::FaceNumber:
            break;
    }
    return {0, static_cast<double>(std::max<std::size_t>(tin.mesh.count_terrain(), 1) - 1), true, true};
}

}  // namespace

ValueRange find_value_range(const Tin& tin, const WriteGridOptions& options, bool is_quick) {
    const std::vector<Product>& products = options.gridding.products;
    ValueRange all = range_of(products.front(), tin, options, is_quick);
    for (const Product product : products) {
        const ValueRange range = range_of(product, tin, options, is_quick);
        all.lowest = std::min(all.lowest, range.lowest);
        all.highest = std::max(all.highest, range.highest);
        all.is_certain = all.is_certain && range.is_certain;
        all.is_count = all.is_count || range.is_count;
        if (product != Product::Elevation) {
            all.name = "values";
        }
    }
    return all;
}

RasterValues::RasterValues(const RasterDriver& driver, std::optional<double> asked,
                           const std::function<ValueRange(bool)>& find_range)
    : type_(driver.type), is_integer_(driver.is_integer()), range_(integer_range(driver.type)) {
    // The margin is wider than what Float32 rounds away.
    const auto is_harmless = [&](const ValueRange& range) {
        const double largest = std::max(-range.lowest, range.highest);
        const double nodata = asked.value_or(nodata_);
        return !is_integer_ && !range.is_count &&
               largest <= static_cast<double>(std::numeric_limits<float>::max()) &&
               !(nodata >= range.lowest - 1e-6 * largest && nodata <= range.highest + 1e-6 * largest);
    };
    ValueRange range = find_range(true);
    if (!is_harmless(range)) {
        range = find_range(false);
    }
    name_ = range.name;
    double lowest = range.lowest;
    double highest = range.highest;
    const auto describe = [&] {
        return name_ + " from " + decimal_text(lowest) + " to " + decimal_text(highest);
    };
    if (is_integer_) {
        lowest = std::round(lowest);
        highest = std::round(highest);
    } else if (type_ == GDT_Float32) {
        const double limit =
            range.is_count ? kExactInFloat : static_cast<double>(std::numeric_limits<float>::max());
        if (std::max(-lowest, highest) > limit) {
            throw InputError(describe() + " do not fit Float32; use --ot Float64");
        }
        lowest = static_cast<double>(static_cast<float>(lowest));
        highest = static_cast<double>(static_cast<float>(highest));
    }
    const auto is_outside = [&](double value) { return !(value >= lowest && value <= highest); };
    if (asked) {
        nodata_ = *asked;
    } else if (is_integer_) {
        const std::array<double, 3> candidates{-9999, range_.highest, range_.lowest};
        const auto* const found =
            std::find_if(std::begin(candidates), std::end(candidates),
                         [&](double value) { return value >= range_.lowest && is_outside(value); });
        if (found == std::end(candidates)) {
            throw InputError(
                describe() + " leave no value of " + driver.type_name() +
                " for nodata; use a wider type with --ot, or --nodata with a value that does not occur");
        }
        nodata_ = *found;
    }
    if (type_ == GDT_Float32) {
        nodata_ = static_cast<double>(static_cast<float>(nodata_));
    }
    must_check_ = is_integer_ || !range.is_certain || !is_outside(nodata_);
}

double RasterValues::filler() const {
    return must_check_ ? std::numeric_limits<double>::quiet_NaN() : nodata_;
}

void RasterValues::refuse(double value, std::int64_t cell, const GridGeometry& grid,
                          std::int64_t first_row) const {
    const std::int64_t column = cell % grid.columns;
    const std::int64_t row = first_row + cell / grid.columns;
    const Point2 at = grid.centre(column, row);
    const std::string where = "the cell at column " + std::to_string(column) + ", row " +
                              std::to_string(row) + " " + location_text(at) +
                              (name_ == "elevations" ? " has the elevation " : " has the value ");
    if (is_integer_ && !(value >= range_.lowest && value <= range_.highest)) {
        throw InputError(where + decimal_text(value) + ", which does not fit " + GDALGetDataTypeName(type_) +
                         " (" + decimal_text(range_.lowest) + " to " + decimal_text(range_.highest) +
                         "); use --ot " + (std::abs(value) < 2147483647.0 ? "Int32 or Float32" : "Float64"));
    }
    throw InputError(where + decimal_text(value) +
                     ", which stands for nodata; choose another value with --nodata");
}

template <class Value>
void RasterValues::check(std::span<Value> values, const GridGeometry& grid, std::int64_t first_row) const {
    const auto nodata = static_cast<Value>(nodata_);
    for (std::size_t i = 0; i < values.size(); ++i) {
        Value& value = values[i];
        if (std::isnan(value)) {
            value = nodata;
            continue;
        }
        if (is_integer_) {
            value = std::round(value);
        }
        const auto wide = static_cast<double>(value);
        if (value == nodata || (is_integer_ && (wide < range_.lowest || wide > range_.highest))) {
            refuse(wide, static_cast<std::int64_t>(i), grid, first_row);
        }
    }
}

template void RasterValues::check(std::span<float>, const GridGeometry&, std::int64_t) const;
template void RasterValues::check(std::span<double>, const GridGeometry&, std::int64_t) const;

}  // namespace tinwright::io
