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
    /// `geometry`, a field's name, a constant, or of lines `drape`. In text also a column's number from 1, so
    /// that z=3 is the third column of a file that has three; z=3.0 is the constant.
    std::optional<std::string> z;
    std::optional<std::string> x_field;  ///< a name; in text also a column's number from 1
    std::optional<std::string> y_field;
    bool vertices = false;  ///< vertices of lines and polygons are samples
    /// Lines: `sharp`, `smooth`, or the name of a field that holds these words.
    std::optional<std::string> across;
    std::optional<int> band;
    std::optional<int> stride;
    std::optional<std::string> crs;  ///< of this source, whatever the file says
    /// Text: `Xyz` takes the first three numeric columns where a header does not name them, `Pnezd` columns 2
    /// to 4 as y, x, z likewise, `Csv` asks for a header's names as without a format.
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
