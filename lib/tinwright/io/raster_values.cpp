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

}  // namespace

RasterValues::RasterValues(const Tin& tin, const RasterDriver& driver, std::optional<double> asked)
    : type_(driver.type), is_integer_(driver.is_integer()), range_(integer_range(driver.type)) {
    // The margin is wider than what Float32 rounds away.
    const auto is_harmless = [&](std::pair<double, double> range) {
        const double largest = std::max(-range.first, range.second);
        const double nodata = asked.value_or(nodata_);
        return !is_integer_ && largest <= static_cast<double>(std::numeric_limits<float>::max()) &&
               !(nodata >= range.first - 1e-6 * largest && nodata <= range.second + 1e-6 * largest);
    };
    std::pair<double, double> range = find_vertex_range(tin);
    if (!is_harmless(range)) {
        range = find_terrain_range(tin);
    }
    double lowest = range.first;
    double highest = range.second;
    if (is_integer_) {
        lowest = std::round(lowest);
        highest = std::round(highest);
    } else if (type_ == GDT_Float32) {
        if (std::max(-lowest, highest) > static_cast<double>(std::numeric_limits<float>::max())) {
            throw InputError("elevations from " + decimal_text(lowest) + " to " + decimal_text(highest) +
                             " do not fit Float32; use --ot Float64");
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
                "elevations from " + decimal_text(lowest) + " to " + decimal_text(highest) +
                " leave no value of " + driver.type_name() +
                " for nodata; use a wider type with --ot, or --nodata with a value that does not occur");
        }
        nodata_ = *found;
    }
    if (type_ == GDT_Float32) {
        nodata_ = static_cast<double>(static_cast<float>(nodata_));
    }
    must_check_ = is_integer_ || !is_outside(nodata_);
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
                              std::to_string(row) + " " + location_text(at);
    if (is_integer_ && !(value >= range_.lowest && value <= range_.highest)) {
        throw InputError(where + " has the elevation " + decimal_text(value) + ", which does not fit " +
                         GDALGetDataTypeName(type_) + " (" + decimal_text(range_.lowest) + " to " +
                         decimal_text(range_.highest) + "); use --ot " +
                         (std::abs(value) < 2147483647.0 ? "Int32 or Float32" : "Float64"));
    }
    throw InputError(where + " has the elevation " + decimal_text(value) +
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
