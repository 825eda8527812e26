#ifndef TINWRIGHT_TOOLS_LINE_POINTS_HPP
#define TINWRIGHT_TOOLS_LINE_POINTS_HPP

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"

namespace tinwright::tools {

/// Tells which line a point is of, points being counted through all lines.
class LinePoints {
  public:
    explicit LinePoints(std::span<const Breakline> lines) {
        ends_.reserve(lines.size());
        std::size_t count = 0;
        for (const Breakline& line : lines) {
            count += line.points.size();
            ends_.push_back(count);
        }
    }

    /// Nothing for a number that is no point's. O(log lines).
    [[nodiscard]] std::optional<std::size_t> find_line(std::size_t point) const {
        const auto end = std::upper_bound(ends_.begin(), ends_.end(), point);
        return end == ends_.end() ? std::nullopt
                                  : std::optional(static_cast<std::size_t>(end - ends_.begin()));
    }

  private:
    std::vector<std::size_t> ends_;
};

}  // namespace tinwright::tools

#endif
