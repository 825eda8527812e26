#ifndef TINWRIGHT_IO_TEXT_ROWS_HPP
#define TINWRIGHT_IO_TEXT_ROWS_HPP

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/sample_ids.hpp"
#include "tinwright/io/text_layout.hpp"

namespace tinwright::io {

/// What a piece of a text file holds; lines count from 0 within the piece.
struct TextRows {
    std::vector<Point3> points;
    SampleIds lines;  ///< of each point
    std::int64_t line_count = 0;
    std::size_t skipped = 0;
    std::string error;  ///< of the first unusable row, empty when there was none
    std::int64_t error_line = 0;

    /// Empty again; keeps the memory of the points.
    void clear() {
        std::vector<Point3> memory = std::move(points);
        *this = TextRows();
        points = std::move(memory);
        points.clear();
    }
};

/// Parses whole lines, the last one ended by '\n'. Appends to `rows`; stops at the first unusable row unless
/// `skip_bad`. Pure, so pieces may be parsed at the same time.
void parse_rows(std::string_view text, const TextLayout& layout, bool skip_bad, TextRows& rows);

}  // namespace tinwright::io

#endif
