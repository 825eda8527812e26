#ifndef TINWRIGHT_IO_ATOMIC_OUTPUT_HPP
#define TINWRIGHT_IO_ATOMIC_OUTPUT_HPP

#include <string>
#include <vector>

namespace tinwright::io {

/// An output that exists whole or not at all. Files are written under `path()`, inside a temporary folder
/// beside the target; `commit()` renames every file of it into place. Destroyed without a commit, it removes
/// what was written and leaves an older target as it was. A /vsi target is written directly and deleted on
/// failure (an older one is deleted first).
class AtomicOutput {
  public:
    /// Throws IoError when the target exists and `overwrite` is false, is a folder or a device, or when its
    /// folder is missing or cannot be written; UsageError for an empty target and for standard output.
    AtomicOutput(std::string target, bool overwrite);
    ~AtomicOutput();
    AtomicOutput(const AtomicOutput&) = delete;
    AtomicOutput& operator=(const AtomicOutput&) = delete;

    /// Where to write: same file name and extension as the target. Everything in its folder belongs to the
    /// output, side-car files too.
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] const std::string& target() const { return target_; }
    /// Moves everything into place, the target itself last, side-car files included, and deletes the side-car
    /// files of an overwritten target. Close every dataset first. Throws IoError, for instance when the
    /// disk turns out to be full, and then leaves nothing.
    void commit();

  private:
    void prepare_local();
    void prepare_virtual();
    void discard() noexcept;

    std::string target_;
    std::string destination_;  // the target, symbolic links followed
    std::string path_;
    std::string folder_;                 // empty for a /vsi target
    std::vector<std::string> siblings_;  // of a /vsi target: files with its stem that were there before
    bool overwrite_ = false;
    bool committed_ = false;
};

/// Removes the temporary files of every AtomicOutput alive: for a process about to exit on a signal. Takes a
/// lock and allocates, so call it from a thread, not from a signal handler.
void discard_unfinished_outputs();

/// Throws IoError when the file system of `target` has fewer than `bytes` free, naming both figures. Does
/// nothing for /vsi targets.
void require_free_space(const std::string& target, double bytes);

}  // namespace tinwright::io

#endif
