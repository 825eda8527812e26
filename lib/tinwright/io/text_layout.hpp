#ifndef TINWRIGHT_IO_TEXT_LAYOUT_HPP
#define TINWRIGHT_IO_TEXT_LAYOUT_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tinwright/io/source.hpp"

namespace tinwright::io {

/// How the rows of a text file are cut into columns.
struct TextSplitting {
    char separator = ',';  ///< a blank: any run of blanks and tabs
    char point = '.';      ///< decimal mark
    friend bool operator==(const TextSplitting&, const TextSplitting&) = default;
};

/// Where the samples of a text file are.
struct TextLayout {
    TextSplitting splitting;
    std::size_t columns = 0;  ///< every row has as many; 0: a text at the end of the row may hold separators
    std::size_t x = 0;        ///< columns, from 0
    std::size_t y = 1;
    std::size_t z = 2;
    std::optional<double> z_constant;  ///< takes the place of column z
    bool is_lon_lat = false;
    std::size_t data_begin = 0;   ///< offset of the first row's line, or of a comment before it
    std::int64_t first_line = 1;  ///< number of that line
    std::vector<std::string> warnings;
};

/// Whether the line has neither sample nor header: blank, or a comment that starts with "#" or "//".
bool is_blank_or_comment(std::string_view line);

/// Cuts a row. Columns are trimmed; double quotes around one are taken off and doubled ones inside halved
/// (not when blanks separate). Nothing when a quote is left open.
std::optional<std::vector<std::string>> split_row(std::string_view line, const TextSplitting& splitting);

/// Finds separator, decimal mark, header and columns from the beginning of a file, which ends with a whole
/// line ('\n'); a byte order mark is skipped. `file` names it in messages, as in `file "a.csv"`.
/// Throws InputError when there are no rows or the columns cannot be told; UsageError for keys of the source
/// that do not fit.
TextLayout find_text_layout(std::string_view head, const Source& source, const std::string& file);

/// Whether text looks like rows of two or more numbers, with or without a header.
bool looks_like_rows(std::string_view head);

}  // namespace tinwright::io

#endif
