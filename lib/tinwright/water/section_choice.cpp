#include "tinwright/water/section_choice.hpp"

#include <algorithm>
#include <cstddef>

namespace tinwright {

namespace {

// Runs of edges that share their end on one bank.
class BankRuns {
  public:
    BankRuns(std::span<const RowEdge> row, VertexId RowEdge::*end)
        : first_(row.size()), shortest_(row.size()) {
        for (std::size_t begin = 0; begin < row.size();) {
            std::size_t last = begin;
            double shortest = row[begin].length;
            while (last < row.size() && row[last].*end == row[begin].*end) {
                shortest = std::min(shortest, row[last++].length);
            }
            std::fill(first_.begin() + static_cast<std::ptrdiff_t>(begin),
                      first_.begin() + static_cast<std::ptrdiff_t>(last), begin);
            std::fill(shortest_.begin() + static_cast<std::ptrdiff_t>(begin),
                      shortest_.begin() + static_cast<std::ptrdiff_t>(last), shortest);
            begin = last;
        }
    }

    [[nodiscard]] std::size_t first(std::size_t edge) const { return first_[edge]; }
    [[nodiscard]] double shortest(std::size_t edge) const { return shortest_[edge]; }

  private:
    std::vector<std::size_t> first_;  // edge of the run that an edge is in
    std::vector<double> shortest_;    // length in it
};

}  // namespace

std::vector<std::uint32_t> choose_sections(std::span<const RowEdge> row) {
    const BankRuns left(row, &RowEdge::left);
    const BankRuns right(row, &RowEdge::right);
    // Edges before this one share no end with it: ends once left do not come back.
    const auto apart = [&](std::size_t i) { return std::min(left.first(i), right.first(i)); };
    std::vector<double> best(row.size() + 1, 0);  // worth, of the first so many edges
    std::vector<bool> is_taken(row.size(), false);
    for (std::size_t i = 0; i < row.size(); ++i) {
        const double ratio = row[i].length / std::min(left.shortest(i), right.shortest(i));
        const double worth = 3 - 2 * ratio * ratio;
        const double with = best[apart(i)] + worth;
        is_taken[i] = row[i].is_free && worth > 0 && with > best[i];
        best[i + 1] = is_taken[i] ? with : best[i];
    }
    std::vector<std::uint32_t> chosen;
    for (std::size_t i = row.size(); i > 0;) {
        if (is_taken[i - 1]) {
            chosen.push_back(static_cast<std::uint32_t>(i - 1));
            i = apart(i - 1);
        } else {
            --i;
        }
    }
    std::reverse(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace tinwright
