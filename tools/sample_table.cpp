#include "sample_table.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include <cpl_vsi.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "console.hpp"
#include "point_layer.hpp"

namespace tinwright::tools {

namespace {

constexpr std::size_t kChunk = std::size_t{1} << 16U;  // bytes written at a time

bool is_csv(const OutputOptions& output) {
    return output.driver.empty() ? is_to_stdout(output) || output.path.ends_with(".csv")
                                 : output.driver == "CSV";
}

bool is_empty(const TableValue& value) {
    const auto* const number = std::get_if<double>(&value);
    return std::holds_alternative<std::monostate>(value) || (number != nullptr && !std::isfinite(*number));
}

/// Rows as text, handed on in chunks.
class CsvTable : public SampleTable {
  public:
    explicit CsvTable(std::span<const TableColumn> columns) {
        for (const TableColumn& column : columns) {
            text_ += text_.empty() ? "" : ",";
            text_ += column.name;
        }
        text_ += '\n';
    }

    void add(Point2 /*position*/, std::span<const TableValue> row) override {
        for (std::size_t i = 0; i < row.size(); ++i) {
            text_ += i == 0 ? "" : ",";
            append(row[i]);
        }
        text_ += '\n';
        if (text_.size() >= kChunk) {
            flush();
        }
    }
    void finish() override { flush(); }
    [[nodiscard]] std::string driver() const override { return "CSV"; }

  protected:
    virtual void write(const std::string& text) = 0;

  private:
    void append(const TableValue& value) {
        if (is_empty(value)) {
            return;
        }
        if (const auto* const number = std::get_if<double>(&value)) {
            text_ += decimal_text(*number);
        } else if (const auto* const whole = std::get_if<std::int64_t>(&value)) {
            text_ += std::to_string(*whole);
        } else {
            text_ += std::get<std::string>(value);  // our own words: no comma, no quote
        }
    }
    void flush() {
        write(text_);
        text_.clear();
    }

    std::string text_;
};

/// Prints at the end only: where a command fails, nothing is on standard output.
class PrintedTable final : public CsvTable {
  public:
    using CsvTable::CsvTable;

    void finish() override {
        CsvTable::finish();
        print_result(printed_);
    }

  private:
    void write(const std::string& text) override { printed_ += text; }

    std::string printed_;
};

class CsvFile final : public CsvTable {
  public:
    CsvFile(std::span<const TableColumn> columns, const std::string& target, bool overwrite)
        : CsvTable(columns), output_(target, overwrite), file_(VSIFOpenL(output_.path().c_str(), "wb")) {
        require(file_ != nullptr);
    }
    ~CsvFile() override {
        if (file_ != nullptr) {
            VSIFCloseL(file_);
        }
    }
    CsvFile(const CsvFile&) = delete;
    CsvFile& operator=(const CsvFile&) = delete;

    void finish() override {
        CsvTable::finish();
        const bool is_closed = VSIFCloseL(std::exchange(file_, nullptr)) == 0;
        require(is_closed);
        output_.commit();
    }

  private:
    void write(const std::string& text) override {
        require(VSIFWriteL(text.data(), 1, text.size(), file_) == text.size());
    }
    void require(bool is_good) const {
        if (!is_good) {
            throw IoError("cannot write " + io::quoted(output_.target()) + messages_.suffix());
        }
    }

    io::GdalMessages messages_;
    io::AtomicOutput output_;
    VSILFILE* file_;
};

std::vector<io::TinField> fields_of(std::span<const TableColumn> columns) {
    std::vector<io::TinField> fields;
    for (const TableColumn& column : columns) {
        fields.push_back({column.name, column.type == TableColumn::Type::Whole  ? OFTInteger64
                                       : column.type == TableColumn::Type::Real ? OFTReal
                                                                                : OFTString});
    }
    return fields;
}

class LayerTable final : public SampleTable {
  public:
    LayerTable(const OutputOptions& output, std::span<const TableColumn> columns, const io::Crs& crs,
               const io::TinMetadata& metadata)
        : layer_(output.path, output.driver, output.overwrite, "samples", fields_of(columns), crs,
                 PointLayer::Shape::Flat, metadata) {}

    void add(Point2 position, std::span<const TableValue> row) override {
        for (std::size_t i = 0; i < row.size(); ++i) {
            set(i, row[i]);
        }
        layer_.write({position.x, position.y, 0});
    }
    void finish() override { layer_.finish()->commit(); }
    [[nodiscard]] std::string driver() const override { return layer_.driver(); }

  private:
    void set(std::size_t i, const TableValue& value) {
        if (is_empty(value)) {
            layer_.set(i, std::optional<double>());
        } else if (const auto* const number = std::get_if<double>(&value)) {
            layer_.set(i, *number);
        } else if (const auto* const whole = std::get_if<std::int64_t>(&value)) {
            layer_.set(i, *whole);
        } else {
            layer_.set(i, std::get<std::string>(value));
        }
    }

    PointLayer layer_;
};

}  // namespace

bool is_to_stdout(const OutputOptions& output) {
    return output.path.empty() || output.path == "-" || output.is_stdout();
}

void check_table_target(const OutputOptions& output) {
    if (is_csv(output)) {
        return;
    }
    if (is_to_stdout(output)) {
        throw UsageError("only CSV goes to standard output, not " + output.driver +
                         ": name a file with -o FILE");
    }
    PointLayer::check_target(output.path, output.driver);
}

std::unique_ptr<SampleTable> make_sample_table(const OutputOptions& output,
                                               std::span<const TableColumn> columns, const io::Crs& crs,
                                               const io::TinMetadata& metadata) {
    if (is_to_stdout(output)) {
        return std::make_unique<PrintedTable>(columns);
    }
    if (is_csv(output)) {
        return std::make_unique<CsvFile>(columns, output.path, output.overwrite);
    }
    return std::make_unique<LayerTable>(output, columns, crs, metadata);
}

}  // namespace tinwright::tools
