#ifndef TINWRIGHT_IO_SOURCE_HPP
#define TINWRIGHT_IO_SOURCE_HPP

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tinwright::io {

/// One source as the user wrote it: `PATH[,key=value...]`.
struct Source {
    enum class Format { Auto, Xyz, Pnezd, Csv };
    enum class Kind { Auto, Tin, Samples };

    std::string path;
    std::optional<std::string> layer;
    std::optional<std::string> where;
    std::optional<std::string> sql;
    std::optional<std::string> z;  ///< `geometry`, a field's name, or a constant
    std::optional<std::string> x_field;
    std::optional<std::string> y_field;
    bool vertices = false;  ///< vertices of lines and polygons are samples
    std::optional<int> band;
    std::optional<int> stride;
    std::optional<std::string> crs;
    Format format = Format::Auto;
    Kind as = Kind::Auto;
    std::vector<std::string> open_options;  ///< KEY=VALUE, in the order given

    friend bool operator==(const Source&, const Source&) = default;
};

/// Parses the grammar: the text is split only before a known `key=`; a doubled comma is a literal one.
/// Throws UsageError for an empty path, a key given twice (but `oo`), or a value that the key cannot have.
Source parse_source(std::string_view text);

}  // namespace tinwright::io

#endif
