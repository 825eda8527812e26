#include "tinwright/surface/contour.hpp"

#include <algorithm>
#include <cstdint>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/mesh/border.hpp"
#include "tinwright/surface/contour_sites.hpp"

namespace tinwright {

namespace {

/// The levels that a terrain's border half-edges fall through: there lines begin.
LevelLists list_starts(const TriangleMesh& mesh, const ContourSites& sites,
                       std::span<const HalfEdgeId> border) {
    std::vector<LevelRange> ranges;
    ranges.reserve(border.size());
    for (const HalfEdgeId h : border) {
        ranges.push_back({sites[mesh.destination(h)].below, sites[mesh.origin(h)].below});
    }
    return list_by_level(ranges, sites.levels().size());
}

/// Follows the lines of one level after the other, on one thread.
class LineWalker {
  public:
    LineWalker(const TriangleMesh& mesh, const ContourSites& sites)
        : mesh_(mesh), sites_(sites), visited_(mesh.slot_count(), 0) {}

    /// `starts`: half-edges of the border that fall through the level. `faces`: those that the level crosses.
    LevelLines walk(std::uint32_t level, std::span<const HalfEdgeId> border,
                    std::span<const std::uint32_t> starts, std::span<const std::uint32_t> faces) {
        level_ = level;
        points_.clear();
        lines_.clear();
        for (const std::uint32_t start : starts) {
            follow(border[start], false);
        }
        for (const std::uint32_t face : faces) {
            if (visited_[face] != level_ + 1) {
                follow(falling(FaceId{face}), true);
            }
        }
        std::sort(lines_.begin(), lines_.end(),
                  [](const Line& a, const Line& b) { return a.smallest_edge < b.smallest_edge; });
        LevelLines result;
        result.points.reserve(points_.size() + lines_.size());
        for (const Line& line : lines_) {
            take(line, result);
        }
        return result;
    }

  private:
    struct Line {
        std::uint64_t smallest_edge = ~std::uint64_t{0};
        std::size_t smallest_point = 0;  // of that edge
        std::size_t begin = 0;
        std::size_t end = 0;
        bool is_closed = false;
    };

    /// The half-edge of a crossed face that falls through the level.
    [[nodiscard]] HalfEdgeId falling(FaceId f) const {
        unsigned corner = 0;
        while (!(sites_.is_above(mesh_.vertex(f, corner), level_) &&
                 !sites_.is_above(mesh_.vertex(f, next_corner(corner)), level_))) {
            ++corner;
        }
        return half_edge(f, corner);
    }

    void add(Line& line, VertexId above, VertexId below) {
        const std::uint64_t low = std::min(above, below).value;
        const std::uint64_t edge = low << 32U | std::max(above, below).value;
        if (edge < line.smallest_edge) {
            line.smallest_edge = edge;
            line.smallest_point = points_.size();
        }
        points_.push_back(sites_.crossing(above, below, level_));
    }

    /// In every face a line enters by the half-edge that falls through the level and leaves by the one that
    /// rises, so that higher ground is on its left.
    void follow(HalfEdgeId start, bool is_closed) {
        Line line;
        line.begin = points_.size();
        line.is_closed = is_closed;
        VertexId above = mesh_.origin(start);
        VertexId below = mesh_.destination(start);
        if (!is_closed) {
            add(line, above, below);
        }
        HalfEdgeId h = start;
        do {
            visited_[face_of(h).value] = level_ + 1;
            const VertexId apex = mesh_.origin(previous(h));
            if (sites_.is_above(apex, level_)) {
                above = apex;
                h = next(h);
            } else {
                below = apex;
                h = previous(h);
            }
            add(line, above, below);
            h = mesh_.twin(h);
        } while (h != start && mesh_.is_terrain(face_of(h)));
        line.end = points_.size();
        lines_.push_back(line);
    }

    /// Appends a line without repetitions, a closed one from its smallest edge on.
    void take(const Line& line, LevelLines& result) const {
        const std::size_t begin = result.points.size();
        const auto append = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) {
                if (result.points.size() == begin || result.points.back() != points_[i]) {
                    result.points.push_back(points_[i]);
                }
            }
        };
        if (line.is_closed) {
            append(line.smallest_point, line.end);
            append(line.begin, line.smallest_point + 1);
        } else {
            append(line.begin, line.end);
        }
        if (result.points.size() < begin + 2) {
            result.points.resize(begin);
        } else {
            result.ends.push_back(result.points.size());
        }
    }

    const TriangleMesh& mesh_;
    const ContourSites& sites_;
    std::vector<std::uint32_t> visited_;  // by face: the last level it was visited for, plus one
    std::uint32_t level_ = 0;
    std::vector<Point2> points_;
    std::vector<Line> lines_;
};

std::vector<LevelLines> cut(const TriangleMesh& mesh, const ContourSites& sites, const Progress& progress) {
    const std::size_t levels = sites.levels().size();
    report_progress(progress, 0);
    const LevelLists faces = list_by_level(crossed_levels(mesh, sites), levels);
    const std::vector<HalfEdgeId> border = find_border(mesh);
    const LevelLists starts = list_starts(mesh, sites, border);
    report_progress(progress, 0.3);
    std::vector<LevelLines> lines(levels);
    tbb::enumerable_thread_specific<LineWalker> walkers([&] { return LineWalker(mesh, sites); });
    tbb::parallel_for(std::size_t{0}, levels, [&](std::size_t level) {
        lines[level] = walkers.local().walk(static_cast<std::uint32_t>(level), border, starts.of(level),
                                            faces.of(level));
    });
    report_progress(progress, 1);
    return lines;
}

}  // namespace

std::vector<LevelLines> make_contours(const Tin& tin, std::span<const double> levels,
                                      const Progress& progress) {
    return cut(tin.mesh, ContourSites(tin, levels), progress);
}

std::vector<LevelLines> make_contours(const TriangleMesh& mesh, std::span<const Point3> vertices,
                                      std::span<const double> levels, const Progress& progress) {
    return cut(mesh, ContourSites(vertices, levels), progress);
}

}  // namespace tinwright
