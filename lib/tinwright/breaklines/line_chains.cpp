#include "tinwright/breaklines/line_chains.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {
namespace {

/// The way from one vertex of a line to a neighbour on it.
struct Step {
    std::uint32_t from;
    std::uint32_t to;
    friend auto operator<=>(const Step&, const Step&) = default;
};

/// The pieces of one line, and the ways along them.
class LineWalker {
  public:
    LineWalker(const NodedLines& noded, std::vector<Step> steps) : noded_(noded), steps_(std::move(steps)) {
        std::sort(steps_.begin(), steps_.end());
        steps_.erase(std::unique(steps_.begin(), steps_.end()), steps_.end());
    }

    /// Appends the vertices after the one at `from`, up to the one at `to`, along the straight line that the
    /// segment was before rounding moved its vertices by less than a step.
    void walk(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& chain) const;

  private:
    struct Option {
        double along;  // squared keys: inner product with the segment
        std::uint32_t vertex;
        friend auto operator<=>(const Option&, const Option&) = default;
    };
    [[nodiscard]] std::vector<Option> options_at(std::uint32_t vertex, Key2 from, Key2 to) const;

    const NodedLines& noded_;
    std::vector<Step> steps_;
};

/// Neighbours that are on the segment, but for rounding, and further along it: the furthest first.
std::vector<LineWalker::Option> LineWalker::options_at(std::uint32_t vertex, Key2 from, Key2 to) const {
    const double here = inner_product(noded_.keys[vertex], from, to);
    std::vector<Option> options;
    for (auto step = std::lower_bound(steps_.begin(), steps_.end(), Step{vertex, 0});
         step != steps_.end() && step->from == vertex; ++step) {
        const Key2 key = noded_.keys[step->to];
        const double along = inner_product(key, from, to);
        if (along > here && measure_distance(key, from, to).squared <= 1) {
            options.push_back({along, step->to});
        }
    }
    std::sort(options.rbegin(), options.rend());
    return options;
}

void LineWalker::walk(std::uint32_t from, std::uint32_t to, std::vector<std::uint32_t>& chain) const {
    const Key2 start = noded_.keys[from];
    const Key2 end = noded_.keys[to];
    // Mostly there is one option at each vertex. Where a line nearly doubles back on itself there may be
    // more, of which the nearest is tried first and given up when it leads nowhere.
    std::vector<std::vector<Option>> open{{{0, from}}};
    const std::size_t before = chain.size();
    while (!open.empty()) {
        if (open.back().empty()) {
            open.pop_back();
            if (chain.size() > before) {
                chain.pop_back();
            }
            continue;
        }
        const std::uint32_t vertex = open.back().back().vertex;
        open.back().pop_back();
        if (open.size() > 1) {
            chain.push_back(vertex);
        }
        if (vertex == to) {
            return;
        }
        open.push_back(options_at(vertex, start, end));
    }
    throw BreaklineError("the parts of a line do not lead from one of its points to the next");
}

}  // namespace

std::vector<std::vector<std::uint32_t>> find_line_chains(std::span<const CleanLine> lines,
                                                         const NodedLines& noded) {
    std::vector<std::vector<Step>> steps(lines.size());
    for (const NodedPiece& piece : noded.pieces) {
        steps[piece.line].push_back({piece.a, piece.b});
        steps[piece.line].push_back({piece.b, piece.a});
    }
    const auto vertex_of = [&](Key2 key) {
        const auto at = std::lower_bound(noded.keys.begin(), noded.keys.end(), key, precedes_on_curve);
        return static_cast<std::uint32_t>(at - noded.keys.begin());
    };
    std::vector<std::vector<std::uint32_t>> chains(lines.size());
    for (std::size_t line = 0; line < lines.size(); ++line) {
        const std::vector<Key2>& keys = lines[line].keys;
        if (keys.size() < 2) {
            continue;
        }
        const LineWalker walker(noded, std::move(steps[line]));
        std::uint32_t vertex = vertex_of(keys[0]);
        chains[line].push_back(vertex);
        for (std::size_t i = 1; i < keys.size(); ++i) {
            const std::uint32_t next = vertex_of(keys[i]);
            walker.walk(vertex, next, chains[line]);
            vertex = next;
        }
    }
    return chains;
}

}  // namespace tinwright
