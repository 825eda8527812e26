#ifndef TINWRIGHT_TOOLS_SAMPLE_TABLE_HPP
#define TINWRIGHT_TOOLS_SAMPLE_TABLE_HPP

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/write_tin.hpp"

#include "options_output.hpp"

namespace tinwright::tools {

/// What a column holds.
struct TableColumn {
    enum class Type : std::uint8_t { Whole, Real, Text };
    const char* name;
    Type type;
};
/// A cell of a table; the first kind is an empty one.
using TableValue = std::variant<std::monostate, std::int64_t, double, std::string>;

/// A table of places, being written row by row.
class SampleTable {
  public:
    SampleTable() = default;
    virtual ~SampleTable() = default;
    SampleTable(const SampleTable&) = delete;
    SampleTable& operator=(const SampleTable&) = delete;

    /// One value a column. Numbers that are not finite are left empty.
    virtual void add(Point2 position, std::span<const TableValue> row) = 0;
    /// Completes the table and puts it in its place. Throws IoError.
    virtual void finish() = 0;
    /// "CSV", or GDAL's name of the driver.
    [[nodiscard]] virtual std::string driver() const = 0;
};

/// Whether the output is standard output: it is named so, or not at all.
bool is_to_stdout(const OutputOptions& output);

/// Throws UsageError when no driver fits, or when another format than CSV is to go to standard output.
void check_table_target(const OutputOptions& output);

/// CSV with a header, every number with the digits it takes to read it back, for a target ending in .csv and
/// for standard output; through OGR a layer `samples` of points without z for others. Throws IoError.
std::unique_ptr<SampleTable> make_sample_table(const OutputOptions& output,
                                               std::span<const TableColumn> columns, const io::Crs& crs,
                                               const io::TinMetadata& metadata);

}  // namespace tinwright::tools

#endif
