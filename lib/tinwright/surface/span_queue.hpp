#ifndef TINWRIGHT_SURFACE_SPAN_QUEUE_HPP
#define TINWRIGHT_SURFACE_SPAN_QUEUE_HPP

#include <array>
#include <cstddef>
#include <cstdint>

#include "tinwright/surface/face_plane.hpp"

namespace tinwright {

/// Runs of cells waiting to be written, sorted by their length.
///
/// Most faces of a survey cover a few cells a row, and a loop over so few ends where no processor can
/// foretell, at the price of twenty cells each time. Runs of one length need no such loop.
template <class Value>
class SpanQueue {
  public:
    /// `column_x`: x of the centre of each column.
    explicit SpanQueue(const double* column_x) : column_x_(column_x) {}
    ~SpanQueue() { flush(); }
    SpanQueue(const SpanQueue&) = delete;
    SpanQueue& operator=(const SpanQueue&) = delete;

    /// Starts a face: what is pushed from now on lies in its plane.
    void start(const PlaneSection& plane) {
        if (planes_used_ == kPlanes) {
            flush();
        }
        plane_[planes_used_++] = plane;
    }
    /// Columns first..end - 1 of the row that starts at `row`. An empty run is no run.
    void push(Value* row, double row_value, std::int32_t first, std::int32_t end) {
        const std::int32_t length = end - first;
        if (length > kLongest) {
            write_long(plane_[planes_used_ - 1], row, row_value, first, end);
            return;
        }
        const std::size_t kind = length > 0 ? static_cast<std::size_t>(length) : 0;
        std::size_t& used = used_[kind];
        span_[kind][used] = {row, row_value, first, static_cast<std::uint32_t>(planes_used_ - 1)};
        used += kind != 0 ? 1 : 0;
        if (used == kSpans) {
            flush_spans();
        }
    }

  private:
    static constexpr std::int32_t kLongest = 8;
    static constexpr std::size_t kPlanes = 64;
    static constexpr std::size_t kSpans = 96;

    struct Span {
        Value* row;
        double row_value;
        std::int32_t first;
        std::uint32_t plane;
    };

    void write_long(const PlaneSection& plane, Value* row, double row_value, std::int32_t first,
                    std::int32_t end) const {
        for (std::int32_t column = first; column < end; ++column) {
            row[column] = static_cast<Value>(plane.value(row_value, column_x_[column]));
        }
    }
    template <std::int32_t length>
    void write_all() {
        for (std::size_t i = 0; i < used_[length]; ++i) {
            const Span& span = span_[length][i];
            const PlaneSection plane = plane_[span.plane];
            const double* const x = column_x_ + span.first;
            Value* const cell = span.row + span.first;
            for (std::int32_t c = 0; c < length; ++c) {
                cell[c] = static_cast<Value>(plane.value(span.row_value, x[c]));
            }
        }
        used_[length] = 0;
    }
    void flush_spans() {
        write_all<1>();
        write_all<2>();
        write_all<3>();
        write_all<4>();
        write_all<5>();
        write_all<6>();
        write_all<7>();
        write_all<8>();
    }
    void flush() {
        flush_spans();
        planes_used_ = 0;
    }

    const double* column_x_;
    std::size_t planes_used_ = 0;
    std::array<std::size_t, kLongest + 1> used_{};
    std::array<PlaneSection, kPlanes> plane_;
    std::array<std::array<Span, kSpans>, kLongest + 1> span_;
};

}  // namespace tinwright

#endif
