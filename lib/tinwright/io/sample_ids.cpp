#include "tinwright/io/sample_ids.hpp"

namespace tinwright::io {

void SampleIds::append(const SampleIds& other, std::int64_t offset) {
    for (std::size_t r = 0; r < other.runs_.size(); ++r) {
        const std::size_t end = r + 1 < other.runs_.size() ? other.runs_[r + 1].first : other.size_;
        const Run& run = other.runs_[r];
        add_run(static_cast<std::int64_t>(run.first) + run.shift + offset, end - run.first);
    }
}

void SampleIds::erase(const std::vector<std::size_t>& positions) {
    if (positions.empty()) {
        return;
    }
    const std::vector<std::int64_t> before = all();
    *this = SampleIds();
    std::size_t next = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (next < positions.size() && positions[next] == i) {
            ++next;
        } else {
            add(before[i]);
        }
    }
}

std::vector<std::int64_t> SampleIds::all() const {
    std::vector<std::int64_t> ids(size_);
    for (std::size_t r = 0; r < runs_.size(); ++r) {
        const std::size_t end = r + 1 < runs_.size() ? runs_[r + 1].first : size_;
        for (std::size_t i = runs_[r].first; i < end; ++i) {
            ids[i] = static_cast<std::int64_t>(i) + runs_[r].shift;
        }
    }
    return ids;
}

}  // namespace tinwright::io
