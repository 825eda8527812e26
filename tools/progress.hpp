#ifndef TINWRIGHT_TOOLS_PROGRESS_HPP
#define TINWRIGHT_TOOLS_PROGRESS_HPP

#include <ostream>

#include "tinwright/geometry/progress.hpp"

namespace tinwright::tools {

/// Progress as GDAL's tools show it: "0...10...20 ... 100 - done." on one line, never going back.
class ProgressLine {
  public:
    /// `out`: null shows nothing.
    explicit ProgressLine(std::ostream* out) : out_(out) {}
    /// Ends a line that was begun, so that what follows starts on its own.
    ~ProgressLine() { break_line(); }
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows that `fraction` (0 to 1) of the whole is done.
    void show(double fraction);
    /// Shows the end.
    void finish();
    /// Starts a new line if one was begun; the numbers go on there.
    void break_line();

    /// The progress of one stage, which is the share from `begin` to `end` of the whole. It asks to stop
    /// when the user did. The line must outlive it.
    [[nodiscard]] Progress stage(double begin, double end);
    /// That of a stage that may be left early with a usable result: the first Ctrl-C ends this stage alone.
    [[nodiscard]] Progress stage_to_leave(double begin, double end);

  private:
    std::ostream* out_;
    int ticks_ = 0;  // of 2.5 % each that are shown; 41 in all, 0 and 100 included
    bool line_is_open_ = false;
};

}  // namespace tinwright::tools

#endif
