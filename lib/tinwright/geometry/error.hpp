#ifndef TINWRIGHT_GEOMETRY_ERROR_HPP
#define TINWRIGHT_GEOMETRY_ERROR_HPP

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/point.hpp"

namespace tinwright {

/// Base of everything this project throws on purpose. `what()` is one line: what, where, what to try.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The data cannot be used as they are.
class InputError : public Error {
  public:
    /// `samples`: indices of the offending samples in the order they were handed in, may be empty.
    explicit InputError(const std::string& message, std::vector<std::size_t> samples = {})
        : Error(message), samples_(std::move(samples)) {}

    [[nodiscard]] const std::vector<std::size_t>& samples() const { return samples_; }

  private:
    std::vector<std::size_t> samples_;
};

/// Samples at one location with elevations that differ by more than the tolerance.
struct DuplicateConflict {
    Point2 location;                   ///< in CRS units
    std::vector<std::size_t> samples;  ///< ascending sample indices, two or more
    double z_min = 0;
    double z_max = 0;
};

/// Duplicates met under `DuplicatePolicy::Error`.
class DuplicateError : public InputError {
  public:
    /// `first`: the first conflicts in vertex order; `count`: how many locations conflict in all.
    DuplicateError(const std::string& message, std::vector<DuplicateConflict> first, std::size_t count)
        : InputError(message), first_(std::move(first)), count_(count) {}

    [[nodiscard]] const std::vector<DuplicateConflict>& first() const { return first_; }
    [[nodiscard]] std::size_t count() const { return count_; }

  private:
    std::vector<DuplicateConflict> first_;
    std::size_t count_;
};

/// Lines cannot be used as they are.
class BreaklineError : public InputError {
  public:
    /// `lines`: indices of the offending lines in the order they were handed in, may be empty; `samples`
    /// likewise.
    explicit BreaklineError(const std::string& message, std::vector<std::size_t> lines = {},
                            std::vector<std::size_t> samples = {})
        : InputError(message, std::move(samples)), lines_(std::move(lines)) {}

    [[nodiscard]] const std::vector<std::size_t>& lines() const { return lines_; }

  private:
    std::vector<std::size_t> lines_;
};

/// A file, folder or driver failed us.
class IoError : public Error {
    using Error::Error;
};

/// The command line (or an options value) asks for something that cannot be; exit status 2.
class UsageError : public Error {
    using Error::Error;
};

/// The progress callback asked to stop.
class Cancelled : public Error {
  public:
    Cancelled() : Error("cancelled") {}
};

}  // namespace tinwright

#endif
