#include "tinwright/io/text_rows.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_number.hpp"

namespace tinwright::io {
namespace {

/// The columns to read, from left to right.
struct Wanted {
    std::array<std::size_t, 3> column{};
    std::array<std::size_t, 3> axis{};  // 0 x, 1 y, 2 z
    std::size_t count = 3;
};

Wanted find_wanted(const TextLayout& layout) {
    std::vector<std::pair<std::size_t, std::size_t>> order = {{layout.x, 0}, {layout.y, 1}};
    if (!layout.z_constant) {
        order.emplace_back(layout.z, 2);
    }
    std::sort(order.begin(), order.end());
    Wanted wanted;
    wanted.count = order.size();
    for (std::size_t i = 0; i < order.size(); ++i) {
        wanted.column[i] = order[i].first;
        wanted.axis[i] = order[i].second;
    }
    return wanted;
}

/// The '\n' at or after `p`, which must be there.
const char* line_end(const char* p, const char* end) {
    const void* const found = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
    assert(found != nullptr);
    return static_cast<const char*>(found);
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// The short way: a row of plain numbers where they are expected. Anything else is left to ReadRow, which
/// either reads the row or says what is wrong with it.
template <bool is_blank_separated>
class FastRow {
  public:
    /// Rows end before `end`, with '\n'.
    FastRow(const TextLayout& layout, const Wanted& wanted, const char* end)
        : end_(end),
          wanted_(wanted),
          columns_(layout.columns),
          separator_(layout.splitting.separator),
          point_(layout.splitting.point),
          z_constant_(layout.z_constant.value_or(0)) {}

    /// Reads the row at `p` and moves `p` behind its line; false, `p` unmoved, when this way cannot.
    bool read(const char*& p, Point3& sample) const {
        std::array<double, 3> value = {0, 0, z_constant_};
        const char* q = skip_blanks(p);
        if (*q == '#' || *q == '/') {
            return false;
        }
        std::size_t column = 0;
        for (std::size_t w = 0; w < wanted_.count; ++w) {
            for (; column < wanted_.column[w]; ++column) {
                if (!skip_column(q)) {
                    return false;
                }
            }
            if (!read_short_decimal(q, point_, value[wanted_.axis[w]])) {
                return false;
            }
            if (!end_column(q)) {
                return false;
            }
        }
        if (!end_row(q, column)) {
            return false;
        }
        sample = {value[0], value[1], value[2]};
        p = q;
        return true;
    }

  private:
    [[nodiscard]] bool is_skipped(char c) const {
        return c == ' ' || (c == '\t' && (is_blank_separated || separator_ != '\t')) || c == '\r';
    }

    const char* skip_blanks(const char* q) const {
        while (is_skipped(*q)) {
            ++q;
        }
        return q;
    }

    /// After a number: up to the separator or the line's end, which stay.
    bool end_column(const char*& q) const {
        if (is_blank_separated) {
            return is_blank(*q) || *q == '\n';
        }
        q = skip_blanks(q);
        return *q == separator_ || *q == '\n';
    }

    /// From the start of a column, or the end of one that was read, to the start of the next.
    bool skip_column(const char*& q) const {
        if (is_blank_separated) {
            while (!is_blank(*q) && *q != '\n') {
                ++q;
            }
            q = skip_blanks(q);
            return *q != '\n';
        }
        while (*q != separator_) {
            if (*q == '\n' || *q == '"') {
                return false;
            }
            ++q;
        }
        q = skip_blanks(q + 1);
        return true;
    }

    /// From the end of the last wanted column behind the line's end; the number of columns must be right.
    bool end_row(const char*& q, std::size_t column) const {
        if (columns_ == 0) {
            q = line_end(q, end_) + 1;
            return true;
        }
        if (is_blank_separated) {
            for (q = skip_blanks(q); *q != '\n'; q = skip_blanks(q)) {
                ++column;
                while (!is_blank(*q) && *q != '\n') {
                    ++q;
                }
            }
        } else {
            for (; *q != '\n'; ++q) {
                if (*q == '"') {
                    return false;
                }
                column += *q == separator_ ? 1 : 0;
            }
        }
        ++q;
        return column + 1 == columns_;
    }

    const char* end_;
    Wanted wanted_;
    std::size_t columns_;
    char separator_;
    char point_;
    double z_constant_;
};

/// What is wrong with a column, or nothing.
std::string read_column(const std::vector<std::string>& row, std::size_t column, char point, const char* axis,
                        double& value) {
    const std::string name = std::string(axis) + " (column " + std::to_string(column + 1) + ")";
    if (column >= row.size() || row[column].empty()) {
        return name + " is missing";
    }
    const auto number = parse_number(row[column], point);
    if (!number) {
        return name + " is no number: " + quoted(row[column]);
    }
    if (!std::isfinite(*number)) {
        return name + " is not finite: " + quoted(row[column]);
    }
    value = *number;
    return {};
}

/// The long way: any row. Returns what is wrong with it, or nothing.
std::string read_row(std::string_view line, const TextLayout& layout, Point3& sample) {
    const auto row = split_row(line, layout.splitting);
    if (!row) {
        return "a quoted column does not end on its line";
    }
    for (const auto& [column, axis, value] :
         {std::tuple{layout.x, "x", &sample.x}, std::tuple{layout.y, "y", &sample.y}}) {
        std::string error = read_column(*row, column, layout.splitting.point, axis, *value);
        if (!error.empty()) {
            return error;
        }
    }
    if (layout.z_constant) {
        sample.z = *layout.z_constant;
    } else {
        std::string error = read_column(*row, layout.z, layout.splitting.point, "z", sample.z);
        if (!error.empty()) {
            return error;
        }
    }
    if (layout.columns != 0 && row->size() != layout.columns) {
        return std::to_string(row->size()) + " columns where the rows before have " +
               std::to_string(layout.columns);
    }
    return {};
}

template <bool is_blank_separated>
void parse(std::string_view text, const TextLayout& layout, bool skip_bad, TextRows& rows) {
    const FastRow<is_blank_separated> fast(layout, find_wanted(layout), text.data() + text.size());
    const char* p = text.data();
    const char* const end = p + text.size();
    std::int64_t line = rows.line_count;
    std::int64_t run_first = line;  // lines [run_first, line) are one sample each
    const auto close_run = [&](std::int64_t next) {
        rows.lines.add_run(run_first, static_cast<std::size_t>(line - run_first));
        run_first = next;
    };
    for (; p != end; ++line) {
        Point3 sample;
        if (fast.read(p, sample)) {
            rows.points.push_back(sample);
            continue;
        }
        const char* const stop = line_end(p, end);
        const std::string_view row(p, static_cast<std::size_t>(stop - p));
        p = stop + 1;
        if (is_blank_or_comment(row)) {
            close_run(line + 1);
            continue;
        }
        std::string error = read_row(row, layout, sample);
        if (error.empty()) {
            rows.points.push_back(sample);
            continue;
        }
        close_run(line + 1);
        ++rows.skipped;
        if (rows.error.empty()) {
            rows.error = std::move(error);
            rows.error_line = line;
        }
        if (!skip_bad) {
            ++line;
            break;
        }
    }
    close_run(line);
    rows.line_count = line;
}

}  // namespace

void parse_rows(std::string_view text, const TextLayout& layout, bool skip_bad, TextRows& rows) {
    if (layout.splitting.separator == ' ') {
        parse<true>(text, layout, skip_bad, rows);
    } else {
        parse<false>(text, layout, skip_bad, rows);
    }
}

}  // namespace tinwright::io
