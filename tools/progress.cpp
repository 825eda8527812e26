#include "progress.hpp"

#include <algorithm>

#include "interrupt.hpp"

namespace tinwright::tools {

namespace {

constexpr int kTicks = 40;

}  // namespace

void ProgressLine::show(double fraction) {
    if (out_ == nullptr) {
        return;
    }
    const int reached = 1 + static_cast<int>(kTicks * std::clamp(fraction, 0.0, 1.0));
    if (reached <= ticks_) {
        return;
    }
    for (; ticks_ < reached; ++ticks_) {
        if (ticks_ % 4 == 0) {
            *out_ << ticks_ / 4 * 10;
        } else {
            *out_ << '.';
        }
    }
    line_is_open_ = true;
    out_->flush();
}

void ProgressLine::finish() {
    if (out_ == nullptr) {
        return;
    }
    show(1);
    if (line_is_open_) {
        *out_ << " - done.\n";
        out_->flush();
        line_is_open_ = false;
    }
}

void ProgressLine::break_line() {
    if (line_is_open_) {
        *out_ << '\n';
        line_is_open_ = false;
    }
}

Progress ProgressLine::stage(double begin, double end) {
    return [this, begin, end](double fraction) {
        show(begin + (end - begin) * std::clamp(fraction, 0.0, 1.0));
        return !is_interrupted();
    };
}

Progress ProgressLine::stage_to_leave(double begin, double end) {
    return [go_on = stage(begin, end)](double fraction) { return go_on(fraction) || !take_interrupt(); };
}

}  // namespace tinwright::tools
