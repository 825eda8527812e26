#include "tinwright/io/read_text.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <string_view>

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <cpl_vsi_error.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/text_layout.hpp"
#include "tinwright/io/text_rows.hpp"

namespace tinwright::io {
namespace {

// A piece a thread parses at a time. Smaller ones stay in the second-level cache, larger ones cost fewer
// calls.
constexpr std::size_t kPieceBytes = std::size_t{1} << 20U;
constexpr std::size_t kLongestLine = std::size_t{16} << 20U;

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using File = std::unique_ptr<VSILFILE, CloseFile>;

/// One file on its way into rows.
class TextReader {
  public:
    TextReader(const SliceRequest& request, std::vector<Point3>& points)
        : request_(request), points_(points), slice_(SampleSlice::Kind::Text, request.options.skip_bad) {}

    RawSlice read() {
        file_.reset(VSIFOpenExL(request_.path.c_str(), "rb", TRUE));
        if (!file_) {
            const std::string why = VSIGetLastErrorMsg();
            throw IoError("cannot open " + request_.file +
                          (why.empty() ? messages_.suffix() : "; GDAL says: " + why));
        }
        // Never more than there are processors: oneTBB prints a warning of its own then.
        const int processors = tbb::this_task_arena::max_concurrency();
        const int asked = request_.options.threads;
        arena_.initialize(asked > 0 ? std::min(asked, processors) : processors);
        const auto threads = static_cast<std::size_t>(arena_.max_concurrency());
        batch_bytes_ = threads == 1 ? kPieceBytes : 4 * threads * kPieceBytes;
        total_bytes_ = known_size();
        bool is_first = true;
        while (fill()) {
            std::string_view text(buffer_.data(), whole_);
            if (is_first) {
                layout_ = find_text_layout(text, request_.source, request_.file);
                text.remove_prefix(layout_.data_begin);
                line_ = layout_.first_line;
                is_first = false;
            }
            parse(text);
            reserve();
            report_progress(request_.progress, fraction());
        }
        if (is_first) {
            throw InputError(request_.file + ": no rows with coordinates");
        }
        slice_.is_lon_lat = layout_.is_lon_lat;
        slice_.warnings = layout_.warnings;
        return std::move(slice_);
    }

  private:
    /// Size where it costs nothing to know, else 0: asking for that of a compressed file decompresses it.
    [[nodiscard]] double known_size() const {
        const bool is_plain = !request_.path.starts_with("/vsi") || request_.path.starts_with("/vsimem/");
        VSIStatBufL status;
        return is_plain && VSIStatL(request_.path.c_str(), &status) == 0 ? static_cast<double>(status.st_size)
                                                                         : 0.0;
    }

    [[nodiscard]] double fraction() const {
        // Without a total the fraction creeps towards 1: half way at 64 MiB.
        return total_bytes_ > 0 ? std::min(1.0, read_bytes_ / total_bytes_)
                                : read_bytes_ / (read_bytes_ + 67108864.0);
    }

    /// Room for all points, by the rows so far, as soon as it can be told: growing would copy them.
    void reserve() {
        if (total_bytes_ > 0 && read_bytes_ > 0 && slice_.ids.size() > 0 &&
            points_.size() == points_.capacity()) {
            const double rows = static_cast<double>(slice_.ids.size()) * total_bytes_ / read_bytes_;
            points_.reserve(points_.size() + static_cast<std::size_t>(1.02 * rows) + 1024);
        }
    }

    /// Moves the unfinished line to the front and reads on, until there is at least one whole line. False at
    /// the end of the file.
    bool fill() {
        if (used_ > whole_) {
            std::memmove(buffer_.data(), buffer_.data() + whole_, used_ - whole_);
        }
        used_ -= whole_;
        whole_ = 0;
        while (whole_ == 0 && !is_at_end_) {
            if (used_ > kLongestLine) {
                throw InputError(request_.file + ", line " + std::to_string(line_) +
                                 ": longer than 16 MiB; this is no text with one sample a line");
            }
            const std::size_t wanted = batch_bytes_;
            buffer_.resize(used_ + wanted + 1);  // one more: a last line without its end gets one
            const std::size_t got = VSIFReadL(buffer_.data() + used_, 1, wanted, file_.get());
            read_bytes_ += static_cast<double>(got);
            is_at_end_ = got < wanted;
            if (is_at_end_ && !messages_.last_error().empty()) {
                throw IoError("cannot read " + request_.file + messages_.suffix());
            }
            clean(used_, used_ + got);
            used_ += got;
            if (is_at_end_ && used_ > 0 && buffer_[used_ - 1] != '\n') {
                buffer_[used_++] = '\n';
            }
            whole_ = used_;
            while (whole_ > 0 && buffer_[whole_ - 1] != '\n') {
                --whole_;
            }
        }
        return whole_ > 0;
    }

    /// Refuses what is no text and turns the line ends of files that have only '\r' into '\n'.
    void clean(std::size_t begin, std::size_t end) {
        char* const first = buffer_.data() + begin;
        const std::size_t size = end - begin;
        if (std::memchr(first, '\0', size) != nullptr) {
            throw InputError(request_.file +
                             ": has bytes that no text has; if it is UTF-16 save it as UTF-8");
        }
        if (!are_line_ends_known_ && size > 0) {
            are_line_ends_known_ = true;
            has_bare_returns_ =
                std::memchr(first, '\n', size) == nullptr && std::memchr(first, '\r', size) != nullptr;
        }
        if (has_bare_returns_) {
            std::replace(first, first + size, '\r', '\n');
        }
    }

    void parse(std::string_view text) {
        const bool skip = request_.options.skip_bad;
        const std::vector<std::string_view> pieces = cut(text);
        if (pieces.size() == 1) {
            TextRows rows;
            rows.points.swap(points_);  // straight behind what is there
            parse_rows(text, layout_, skip, rows);
            rows.points.swap(points_);
            take(rows);
            return;
        }
        rows_.resize(std::max(rows_.size(), pieces.size()));
        arena_.execute([&] {
            tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
                rows_[i].clear();
                parse_rows(pieces[i], layout_, skip, rows_[i]);
            });
        });
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            points_.insert(points_.end(), rows_[i].points.begin(), rows_[i].points.end());
            take(rows_[i]);
        }
    }

    /// Adds up what a piece says beside its points.
    void take(const TextRows& rows) {
        slice_.ids.append(rows.lines, line_);
        if (!rows.error.empty()) {
            slice_.bad.add(
                request_.file + ", line " + std::to_string(line_ + rows.error_line) + ": " + rows.error,
                rows.skipped);
        }
        line_ += rows.line_count;
    }

    static std::vector<std::string_view> cut(std::string_view text) {
        std::vector<std::string_view> pieces;
        while (text.size() > 2 * kPieceBytes) {
            const std::size_t end = text.find('\n', kPieceBytes) + 1;
            pieces.push_back(text.substr(0, end));
            text.remove_prefix(end);
        }
        pieces.push_back(text);
        return pieces;
    }

    const SliceRequest& request_;
    std::vector<Point3>& points_;
    RawSlice slice_;
    GdalMessages messages_;
    File file_;
    tbb::task_arena arena_;
    TextLayout layout_;
    std::vector<char> buffer_;
    std::vector<TextRows> rows_;  // one a piece; their memory serves every batch
    std::size_t batch_bytes_ = kPieceBytes;
    std::size_t used_ = 0;   // bytes in the buffer
    std::size_t whole_ = 0;  // of them, whole lines
    bool is_at_end_ = false;
    bool are_line_ends_known_ = false;
    bool has_bare_returns_ = false;
    double read_bytes_ = 0;
    double total_bytes_ = 0;
    std::int64_t line_ = 1;
};

}  // namespace

RawSlice read_text(const SliceRequest& request, std::vector<Point3>& points) {
    return TextReader(request, points).read();
}

std::string read_head(const std::string& path, std::size_t size) {
    const GdalMessages messages;
    const File file(VSIFOpenL(path.c_str(), "rb"));
    std::string head(file ? size : 0, '\0');
    head.resize(file ? VSIFReadL(head.data(), 1, size, file.get()) : 0);
    return head;
}

}  // namespace tinwright::io
