#ifndef TINWRIGHT_IO_ATOMIC_OUTPUT_HPP
#define TINWRIGHT_IO_ATOMIC_OUTPUT_HPP

#include <string>

namespace tinwright::io {

/// An output that exists whole or not at all. Files are written under `path()`, inside a temporary folder
/// beside the target; `commit()` renames every file of it into place. Destroyed without a commit, it removes
/// what was written. A /vsi target is written directly and deleted on failure.
class AtomicOutput {
  public:
    /// Throws IoError when the target exists and `overwrite` is false, or its folder cannot be written.
    AtomicOutput(std::string target, bool overwrite);
    ~AtomicOutput();
    AtomicOutput(const AtomicOutput&) = delete;
    AtomicOutput& operator=(const AtomicOutput&) = delete;

    /// Where to write: same file name and extension as the target.
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& target() const { return target_; }
    /// Moves everything into place, side-car files included. Throws IoError.
    void commit();

  private:
    std::string target_;
    std::string path_;
    std::string folder_;  // empty for a /vsi target
    bool committed_ = false;
};

/// Removes the temporary files of every AtomicOutput alive: for a process about to exit on a signal.
void discard_unfinished_outputs();

/// Throws IoError when the file system of `target` has fewer than `bytes` free, naming both figures.
void require_free_space(const std::string& target, double bytes);

}  // namespace tinwright::io

#endif
