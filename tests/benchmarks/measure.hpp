#ifndef TINWRIGHT_TESTS_BENCHMARKS_MEASURE_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_MEASURE_HPP

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tinwright_benchmarks {

/// What a piece of work took.
struct Measured {
    double cpu_seconds = 0;  ///< user and system time of all threads
    double wall_seconds = 0;
    double peak_bytes = 0;  ///< resident memory at the peak, less what was resident when it began
    double note = 0;        ///< whatever the work counted
};

/// Handed to a piece of work, which prepares, calls `start`, does what is measured and calls `stop`.
class Meter {
  public:
    void start();
    void stop();
    /// Something to tell the parent process: a count of faces, cells or rows.
    void note(double value) { measured_.note = value; }
    [[nodiscard]] const Measured& measured() const { return measured_; }

  private:
    Measured measured_;
    double cpu_at_start_ = 0;
    double wall_at_start_ = 0;
    double resident_at_start_ = 0;
};

using Work = std::function<void(Meter&)>;

/// Runs `work` in a child process, so that it meets a fresh heap and has a peak of its own. The calling
/// process must not have started threads. Throws std::runtime_error when the child fails.
Measured measure_in_child(const Work& work);

/// Does `work` in a child process that is not measured: its memory is gone afterwards.
void do_in_child(const std::function<void()>& work);

/// Runs a program, its output discarded; measures the whole process, start included. Throws
/// std::runtime_error when it cannot be run or does not return 0.
Measured measure_program(const std::vector<std::string>& arguments);

/// The median of each figure over `rounds` rounds; each round measures all contenders in turn, so that a
/// change of the machine's speed meets all of them alike.
std::vector<Measured> measure_in_turn(std::span<const std::function<Measured()>> contenders, int rounds);

}  // namespace tinwright_benchmarks

#endif
