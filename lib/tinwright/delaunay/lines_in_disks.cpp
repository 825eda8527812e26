#include "tinwright/delaunay/lines_in_disks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tinwright/delaunay/chord_ends.hpp"
#include "tinwright/geometry/constructions.hpp"

namespace tinwright {

namespace {

class Finder {
  public:
    Finder(const BlockingDisks& disks, std::span<const Key2> keys)
        : disks_(disks), keys_(keys), is_met_(disks.disks().size()) {}

    void add(VertexId p, VertexId q, bool is_left_alone) {
        LineInDisks edge;
        edge.p = p;
        edge.q = q;
        edge.length = std::sqrt(inner_product(keys_[q.value], keys_[p.value], keys_[q.value]));
        if (!is_left_alone) {
            edge.chords = disks_.find_chords(keys_, p, q);
        }
        lines_.edges.push_back(std::move(edge));
    }

    LinesInDisks finish(const std::vector<bool>& is_left_alone) {
        move_chord_ends(disks_, keys_, lines_.edges);
        for (std::uint32_t k = 0; k < lines_.edges.size(); ++k) {
            lines_.edges[k].first = unprotected_count();
            if (!is_left_alone[k]) {
                add_gaps(k);
            }
            lines_.edges[k].last = unprotected_count();
        }
        for (std::uint32_t disk = 1; disk < is_met_.size(); ++disk) {
            if (!disks_.disks()[disk].is_full && !is_met_[disk]) {
                lines_.touching.push_back(disk);
            }
        }
        return std::move(lines_);
    }

  private:
    [[nodiscard]] std::uint32_t unprotected_count() const {
        return static_cast<std::uint32_t>(lines_.unprotected.size());
    }

    void add_gaps(std::uint32_t line_edge) {
        const LineInDisks& edge = lines_.edges[line_edge];
        UnprotectedEdge gap;
        gap.line_edge = line_edge;
        gap.from_disk = disks_.disk_at(edge.p);
        for (gap.gap = 0; gap.gap <= edge.chords.size(); ++gap.gap) {
            const bool is_last = gap.gap == edge.chords.size();
            gap.to = is_last ? 1 : edge.chords[gap.gap].from;
            gap.to_disk = is_last ? disks_.disk_at(edge.q) : edge.chords[gap.gap].disk;
            if ((gap.to - gap.from) * edge.length >= 1) {
                lines_.unprotected.push_back(gap);
            } else {
                mark_met(gap.from_disk, gap.to_disk);
            }
            gap.from = is_last ? 1 : edge.chords[gap.gap].to;
            gap.from_disk = gap.to_disk;
        }
    }

    void mark_met(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t later = std::max(a, b);
        if (disks_.disks()[later].touched == std::min(a, b)) {
            is_met_[later] = true;
        }
    }

    const BlockingDisks& disks_;
    std::span<const Key2> keys_;
    LinesInDisks lines_;
    std::vector<bool> is_met_;  // of each disk: whether a line passes where it touches the earlier one
};

}  // namespace

LinesInDisks find_lines_in_disks(const BlockingDisks& disks, std::span<const Key2> keys,
                                 std::span<const std::pair<VertexId, VertexId>> line_edges,
                                 const std::vector<bool>& is_left_alone) {
    Finder finder(disks, keys);
    for (std::size_t k = 0; k < line_edges.size(); ++k) {
        finder.add(line_edges[k].first, line_edges[k].second, is_left_alone[k]);
    }
    return finder.finish(is_left_alone);
}

}  // namespace tinwright
