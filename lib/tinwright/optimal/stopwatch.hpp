#ifndef TINWRIGHT_OPTIMAL_STOPWATCH_HPP
#define TINWRIGHT_OPTIMAL_STOPWATCH_HPP

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

#include "tinwright/optimal/optimize.hpp"

namespace tinwright::internal {

/// Asks now and then whether to stop: for time, or because the caller says so.
class Stopwatch {
  public:
    explicit Stopwatch(const OptimizeOptions& options)
        : start_(Clock::now()), budget_(options.budget_seconds), progress_(options.progress) {}

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }
    [[nodiscard]] StoppedBy stopped_by() const { return stopped_by_; }
    [[nodiscard]] bool has_stopped() const { return stopped_by_ != StoppedBy::Finished; }
    /// What follows takes the progress from `begin` to `end`.
    void set_stage(double begin, double end) {
        begin_ = begin;
        end_ = end;
    }
    /// Whether to stop; `done` of `all` is what the stage has come to, `work` the steps taken since the
    /// start.
    bool is_over(std::size_t done, std::size_t all, std::size_t work) {
        // A clock is slow next to most tries.
        constexpr unsigned kTriesBetween = 64;
        constexpr std::size_t kWorkBetween = 1U << 16U;
        if (stopped_by_ == StoppedBy::Finished &&
            (calls_++ % kTriesBetween == 0 || work - work_before_ > kWorkBetween)) {
            work_before_ = work;
            return is_over_now(done, all);
        }
        return stopped_by_ != StoppedBy::Finished;
    }
    /// The same, asked at once: after what may have taken long.
    bool is_over_now(std::size_t done, std::size_t all) {
        if (stopped_by_ != StoppedBy::Finished) {
            return true;
        }
        if (budget_ && seconds() >= *budget_) {
            stopped_by_ = StoppedBy::Budget;
        } else if (progress_) {
            const double part = static_cast<double>(std::min(done, all)) / static_cast<double>(all);
            const bool goes_on = progress_(begin_ + (end_ - begin_) * part);
            stopped_by_ = goes_on ? StoppedBy::Finished : StoppedBy::Interrupt;
        }
        return stopped_by_ != StoppedBy::Finished;
    }

  private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point start_;
    std::optional<double> budget_;
    const Progress& progress_;
    double begin_ = 0;
    double end_ = 1;
    unsigned calls_ = 0;
    std::size_t work_before_ = 0;
    StoppedBy stopped_by_ = StoppedBy::Finished;
};

}  // namespace tinwright::internal

#endif
