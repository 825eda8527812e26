#ifndef TINWRIGHT_IO_SAMPLE_IDS_HPP
#define TINWRIGHT_IO_SAMPLE_IDS_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tinwright::io {

/// Ids of the samples of a slice, kept as runs of consecutive numbers: line numbers, cell numbers and most
/// feature ids need a handful of bytes in all.
class SampleIds {
  public:
    void add(std::int64_t id) { add_run(id, 1); }

    /// Ids first, first + 1, ..., first + count - 1.
    void add_run(std::int64_t first, std::size_t count) {
        if (count == 0) {
            return;
        }
        const std::int64_t shift = first - static_cast<std::int64_t>(size_);
        if (runs_.empty() || runs_.back().shift != shift) {
            runs_.push_back({size_, shift});
        }
        size_ += count;
    }

    /// The ids of `other`, each raised by `offset`, after ours.
    void append(const SampleIds& other, std::int64_t offset);
    /// Leaves out the samples at these ascending positions.
    void erase(const std::vector<std::size_t>& positions);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool is_one_run() const { return runs_.size() <= 1; }
    [[nodiscard]] std::int64_t front() const { return runs_.empty() ? 0 : runs_.front().shift; }
    /// All ids, one a sample.
    [[nodiscard]] std::vector<std::int64_t> all() const;

  private:
    struct Run {
        std::size_t first;
        std::int64_t shift;  // id - position
    };
    std::vector<Run> runs_;
    std::size_t size_ = 0;
};

}  // namespace tinwright::io

#endif
