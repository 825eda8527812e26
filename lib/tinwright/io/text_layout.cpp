#include "tinwright/io/text_layout.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/column_names.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_number.hpp"

namespace tinwright::io {
namespace {

constexpr std::size_t kRowsLookedAt = 50;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\v\f";
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// A CRLF file's line without its carriage return.
std::string_view without_return(std::string_view line) {
    return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

struct Line {
    std::string_view text;
    std::size_t offset;
    std::int64_t number;
};

/// The first lines that are neither blank nor comments, and the last comment before them.
struct Beginning {
    std::vector<Line> rows;
    std::optional<Line> comment;
};

Beginning find_beginning(std::string_view head) {
    Beginning beginning;
    std::size_t offset = head.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    for (std::int64_t number = 1; offset < head.size() && beginning.rows.size() <= kRowsLookedAt; ++number) {
        const std::size_t end = std::min(head.find('\n', offset), head.size());
        const Line line{without_return(head.substr(offset, end - offset)), offset, number};
        if (!is_blank_or_comment(line.text)) {
            beginning.rows.push_back(line);
        } else if (beginning.rows.empty() && !trimmed(line.text).empty()) {
            beginning.comment = line;
        }
        offset = end + 1;
    }
    return beginning;
}

std::vector<bool> numeric_columns(std::string_view line, const TextSplitting& splitting) {
    std::vector<bool> numeric;
    if (const auto row = split_row(line, splitting)) {
        for (const std::string& column : *row) {
            numeric.push_back(parse_number(column, splitting.point).has_value());
        }
    }
    return numeric;
}

std::size_t count_numeric(std::string_view line, const TextSplitting& splitting) {
    const std::vector<bool> numeric = numeric_columns(line, splitting);
    return static_cast<std::size_t>(std::count(numeric.begin(), numeric.end(), true));
}

/// The splitting under which most rows have `wanted` numbers; the first such one of the list.
TextSplitting find_splitting(const std::vector<Line>& rows, std::size_t wanted, std::size_t& good_rows) {
    constexpr std::array<TextSplitting, 9> kCandidates = {{{'\t', '.'},
                                                           {';', '.'},
                                                           {'|', '.'},
                                                           {',', '.'},
                                                           {' ', '.'},
                                                           {'\t', ','},
                                                           {';', ','},
                                                           {'|', ','},
                                                           {' ', ','}}};
    TextSplitting best = kCandidates[3];
    good_rows = 0;
    for (const TextSplitting& candidate : kCandidates) {
        const auto good =
            static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [&](const Line& row) {
                return count_numeric(row.text, candidate) >= wanted;
            }));
        if (good > good_rows) {
            good_rows = good;
            best = candidate;
        }
    }
    return best;
}

/// One find_text_layout(): what is known of the file on the way to its columns.
class LayoutFinder {
  public:
    LayoutFinder(std::string_view head, const Source& source, std::string file)
        : source_(source), where_(std::move(file)), beginning_(find_beginning(head)) {}

    TextLayout find() {
        if (beginning_.rows.empty()) {
            throw InputError(where_ + ": no rows with coordinates");
        }
        find_separator();
        find_header();
        find_columns();
        apply_keys();
        require_columns();
        find_regularity();
        return layout_;
    }

  private:
    [[nodiscard]] const Line& first_row() const { return beginning_.rows[has_header_ ? 1 : 0]; }

    void find_separator() {
        // A constant z leaves two columns to look for; so does a file that turns out to have no z.
        std::size_t good = 0;
        layout_.splitting = find_splitting(beginning_.rows, 3, good);
        if (good == 0) {
            layout_.splitting = find_splitting(beginning_.rows, 2, good);
        }
        if (good == 0) {
            const Line& row = beginning_.rows.front();
            throw InputError(where_ + ", line " + std::to_string(row.number) +
                             ": no rows of numbers follow " + quoted(std::string(row.text)) +
                             "; samples need x, y and z in columns");
        }
    }

    void find_header() {
        const Line& first = beginning_.rows.front();
        if (const auto names = split_row(first.text, layout_.splitting)) {
            const NamedColumns named = recognise_columns(*names);
            has_header_ = (named.x && named.y) || count_numeric(first.text, layout_.splitting) == 0;
            if (has_header_) {
                names_ = *names;
                header_line_ = first.number;
            }
        }
        has_header_ = has_header_ || is_count_of_pts();
        if (has_header_ && beginning_.rows.size() == 1) {
            throw InputError(where_ + ", line " + std::to_string(first.number) +
                             ": nothing follows the header");
        }
        if (!has_header_) {
            take_comment_for_header();
        }
        layout_.data_begin = first_row().offset;
        layout_.first_line = first_row().number;
    }

    /// A .pts file begins with the number of its rows.
    [[nodiscard]] bool is_count_of_pts() const {
        const std::string_view first = trimmed(beginning_.rows.front().text);
        return (source_.path.ends_with(".pts") || source_.path.ends_with(".PTS")) &&
               first.find_first_not_of("0123456789") == std::string_view::npos;
    }

    /// "# x y z" above the first row is a header when it names all three of as many columns.
    void take_comment_for_header() {
        if (!beginning_.comment) {
            return;
        }
        std::string_view text = beginning_.comment->text;
        text = trimmed(text.substr(std::min(text.find_first_not_of("#/"), text.size())));
        const auto names = split_row(text, layout_.splitting);
        if (!names || names->size() != numeric_columns(first_row().text, layout_.splitting).size()) {
            return;
        }
        const NamedColumns named = recognise_columns(*names);
        if (named.x && named.y && named.z) {
            names_ = *names;
            header_line_ = beginning_.comment->number;
        }
    }

    void find_columns() {
        const NamedColumns named = recognise_columns(names_);
        if (named.x && named.y) {
            x_ = named.x;
            y_ = named.y;
            z_ = named.z;
            layout_.is_lon_lat = named.is_lon_lat;
            return;
        }
        if (source_.format == Source::Format::Pnezd) {
            y_ = 1;
            x_ = 2;
            z_ = 3;
            return;
        }
        if (!names_.empty() && source_.format != Source::Format::Xyz) {
            x_ = named.x;
            y_ = named.y;
            z_ = named.z;
            return;
        }
        const std::vector<bool> numeric = numeric_columns(first_row().text, layout_.splitting);
        for (std::size_t c = 0; c < numeric.size() && !z_; ++c) {
            if (numeric[c]) {
                (!x_ ? x_ : !y_ ? y_ : z_) = c;
            }
        }
        warn_of_point_numbers(numeric);
    }

    /// Rows that count 1, 2, 3, ... in front of three more numbers are rather PNEZD than XYZ.
    void warn_of_point_numbers(const std::vector<bool>& numeric) {
        const std::size_t first = has_header_ ? 1 : 0;
        if (numeric.size() < 4 || !numeric[0] || !numeric[1] || !numeric[2] || !numeric[3] ||
            beginning_.rows.size() < first + 3 || source_.x_field || source_.y_field ||
            source_.format == Source::Format::Xyz) {
            return;
        }
        double expected = NAN;
        for (std::size_t r = first; r < first + 3; ++r) {
            const auto row = split_row(beginning_.rows[r].text, layout_.splitting);
            const auto value =
                row && !row->empty() ? parse_number(row->front(), layout_.splitting.point) : std::nullopt;
            if (!value || (r > first && *value != expected)) {
                return;
            }
            expected = *value + 1;
        }
        layout_.warnings.push_back(where_ +
                                   ": columns 1 to 3 are read as x, y and z, but column 1 counts the rows; "
                                   "if it is point, northing, easting, elevation give format=pnezd");
    }

    /// A name, or a column number from 1.
    [[nodiscard]] std::optional<std::size_t> resolve(const std::string& key) const {
        if (const auto found = find_column(names_, key)) {
            return found;
        }
        std::size_t number = 0;
        const char* const end = key.data() + key.size();
        const auto [stop, error] = std::from_chars(key.data(), end, number);
        const std::size_t columns = numeric_columns(first_row().text, layout_.splitting).size();
        if (error == std::errc() && stop == end && number >= 1 && number <= columns) {
            return number - 1;
        }
        return std::nullopt;
    }

    [[nodiscard]] std::string columns_there() const {
        if (!names_.empty()) {
            return "the columns are " + quoted_list(names_);
        }
        return "the file has no header and " +
               std::to_string(numeric_columns(first_row().text, layout_.splitting).size()) +
               " columns, numbered from 1";
    }

    [[nodiscard]] std::size_t resolve_or_refuse(const char* key, const std::string& value) const {
        if (const auto found = resolve(value)) {
            return *found;
        }
        throw InputError(where_ + ": no column " + quoted(value) + " for " + key + "=; " + columns_there());
    }

    void apply_keys() {
        if (source_.x_field) {
            x_ = resolve_or_refuse("xfield", *source_.x_field);
        }
        if (source_.y_field) {
            y_ = resolve_or_refuse("yfield", *source_.y_field);
        }
        if (source_.x_field || source_.y_field) {
            is_lon_lat_by_fields();
        }
        if (!source_.z || *source_.z == "geometry") {
            return;
        }
        if (const auto column = resolve(*source_.z)) {
            z_ = column;
        } else if (const auto constant = parse_number(*source_.z); constant && std::isfinite(*constant)) {
            layout_.z_constant = constant;
            z_ = x_;
        } else {
            z_ = resolve_or_refuse("z", *source_.z);
        }
    }

    /// xfield= and yfield= may point to longitude and latitude as well as away from them.
    void is_lon_lat_by_fields() {
        if (names_.empty() || !x_ || !y_ || *x_ >= names_.size() || *y_ >= names_.size()) {
            return;
        }
        layout_.is_lon_lat = recognise_columns({names_[*x_], names_[*y_]}).is_lon_lat;
    }

    void require_columns() {
        if (!x_ || !y_) {
            if (names_.empty()) {
                throw InputError(where_ + ", line " + std::to_string(first_row().number) + ": " +
                                 quoted(std::string(first_row().text)) + " has fewer than three numbers");
            }
            throw InputError(where_ + ", line " + std::to_string(header_line_) +
                             ": the header names no x and y; give xfield=, yfield= and z= (" +
                             columns_there() + ")");
        }
        if (!z_) {
            throw InputError(where_ + ": no column with z; give z=COLUMN or z=NUMBER (" + columns_there() +
                             ")");
        }
        layout_.x = *x_;
        layout_.y = *y_;
        layout_.z = *z_;
        if (*x_ == *y_ || (!layout_.z_constant && (*x_ == *z_ || *y_ == *z_))) {
            throw UsageError(where_ +
                             ": x, y and z must be different columns; check xfield=, yfield= and z=");
        }
    }

    /// Every row must have as many columns as the header or the first row, unless rows end with free text
    /// that may hold separators.
    void find_regularity() {
        const std::vector<bool> numeric = numeric_columns(first_row().text, layout_.splitting);
        const std::size_t last = std::max({layout_.x, layout_.y, layout_.z});
        const bool ends_with_text = numeric.size() > last + 1 && !numeric.back();
        const bool has_text_column =
            layout_.splitting.separator != ' ' && names_.size() > last + 1 && numeric.size() != names_.size();
        if (source_.format == Source::Format::Pnezd || ends_with_text || has_text_column) {
            layout_.columns = 0;
            return;
        }
        layout_.columns = names_.empty() ? numeric.size() : names_.size();
    }

    const Source& source_;
    std::string where_;
    Beginning beginning_;
    TextLayout layout_;
    bool has_header_ = false;
    std::vector<std::string> names_;
    std::int64_t header_line_ = 0;
    std::optional<std::size_t> x_;
    std::optional<std::size_t> y_;
    std::optional<std::size_t> z_;
};

}  // namespace

bool is_blank_or_comment(std::string_view line) {
    line = trimmed(line);
    return line.empty() || line.front() == '#' || line.starts_with("//");
}

std::optional<std::vector<std::string>> split_row(std::string_view line, const TextSplitting& splitting) {
    std::vector<std::string> columns;
    if (splitting.separator == ' ') {
        line = trimmed(line);
        while (!line.empty()) {
            const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
            columns.emplace_back(line.substr(0, end));
            line = trimmed(line.substr(end));
        }
        return columns;
    }
    line = without_return(line);
    std::string column;
    bool is_open = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (is_open && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
            column += '"';
            ++i;
        } else if (c == '"' && (is_open || trimmed(column).empty())) {
            is_open = !is_open;  // a quote inside an unquoted column is a plain character: 5" pipe
        } else if (c == splitting.separator && !is_open) {
            columns.emplace_back(trimmed(column));
            column.clear();
        } else {
            column += c;
        }
    }
    if (is_open) {
        return std::nullopt;
    }
    columns.emplace_back(trimmed(column));
    return columns;
}

TextLayout find_text_layout(std::string_view head, const Source& source, const std::string& file) {
    return LayoutFinder(head, source, file).find();
}

bool looks_like_rows(std::string_view head) {
    if (head.find('\0') != std::string_view::npos) {
        return false;
    }
    const Beginning beginning = find_beginning(head);
    std::size_t good = 0;
    if (beginning.rows.empty() || trimmed(beginning.rows.front().text).find_first_of("{[<") == 0) {
        return false;  // JSON and XML have rows of numbers, too
    }
    find_splitting(beginning.rows, 2, good);
    return 2 * good >= beginning.rows.size() && good >= 1;
}

}  // namespace tinwright::io
