#include "tinwright/surface/contour.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/mesh/border.hpp"
#include "tinwright/surface/contour_sites.hpp"

namespace tinwright {

namespace {

/// The way of one level through one face: where it leaves the face, by the half-edge that rises through the
/// level, and which way comes next. Entering is the leaving of the way before.
struct Passage {
    double x;
    double y;
    std::uint64_t edge;  // the ends' ids of the edge it leaves by, the smaller first
    std::uint32_t next;

    static constexpr std::uint32_t kBorder = 0xFFFFFFFFU;  // of `next`: none, the terrain ends
    static constexpr std::uint32_t kTaken = 0xFFFFFFFEU;   // of `next`: this one is part of a line already
};

/// The places of a face's passages: one a level that crosses it, ascending, from `first` on.
struct FacePassages {
    LevelRange levels;
    std::uint32_t first;
};

std::uint64_t edge_name(VertexId a, VertexId b) {
    return static_cast<std::uint64_t>(std::min(a, b).value) << 32U | std::max(a, b).value;
}

class LineCutter {
  public:
    LineCutter(const TriangleMesh& mesh, const ContourSites& sites)
        : mesh_(mesh), sites_(sites), border_(find_border(mesh)), lines_(sites.levels().size()) {}

    std::vector<LevelLines> cut(const Progress& progress) {
        report_progress(progress, 0);
        list_starts();
        number_passages();
        report_progress(progress, 0.2);
        make_passages();
        report_progress(progress, 0.6);
        tbb::enumerable_thread_specific<Found> found;
        tbb::parallel_for(std::size_t{0}, lines_.size(), [&](std::size_t level) {
            follow_level(static_cast<std::uint32_t>(level), found.local());
        });
        report_progress(progress, 1);
        return std::move(lines_);
    }

  private:
    struct Line {
        std::uint64_t smallest_edge = ~std::uint64_t{0};
        std::size_t smallest_point = 0;  // of that edge
        std::size_t begin = 0;
        std::size_t end = 0;
        bool is_closed = false;
    };
    /// What a thread has found of a level.
    struct Found {
        std::vector<Point2> points;
        std::vector<Line> lines;
    };

    void list_starts() {
        std::vector<LevelRange> ranges;
        ranges.reserve(border_.size());
        for (const HalfEdgeId h : border_) {
            ranges.push_back({sites_.below(mesh_.destination(h)), sites_.below(mesh_.origin(h))});
        }
        starts_ = list_by_level(ranges, lines_.size());
    }

    /// Passages stand level by level, in the order of faces, so that a line is followed within a small part
    /// of memory; `places_` says where, face by face, so that faces find those of their neighbours nearby.
    void number_passages() {
        const LargeVector<LevelRange> ranges = crossed_levels(mesh_, sites_);
        std::vector<std::int64_t> change(lines_.size() + 1);
        faces_.resize(ranges.size());
        std::size_t count = 0;
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            faces_[f] = {ranges[f], static_cast<std::uint32_t>(count)};
            count += ranges[f].last - ranges[f].first;
            require_few_crossings(count);
            ++change[ranges[f].first];
            --change[ranges[f].last];
        }
        begins_.assign(lines_.size() + 1, 0);
        std::int64_t crossed = 0;
        for (std::size_t level = 0; level < lines_.size(); ++level) {
            crossed += change[level];
            begins_[level + 1] = begins_[level] + static_cast<std::uint32_t>(crossed);
        }
        std::vector<std::uint32_t> next(begins_.begin(), begins_.end());
        places_.resize(count);
        for (const FacePassages& face : faces_) {
            for (std::uint32_t level = face.levels.first; level < face.levels.last; ++level) {
                places_[face.first + (level - face.levels.first)] = next[level]++;
            }
        }
        passages_.resize(count);
    }

    void make_passages() {
        constexpr std::size_t kGrain = 1024;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces_.size(), kGrain), [&](const auto& part) {
            for (std::size_t f = part.begin(); f < part.end(); ++f) {
                const LevelRange levels = faces_[f].levels;
                for (std::uint32_t level = levels.first; level < levels.last; ++level) {
                    const FaceId face{static_cast<std::uint32_t>(f)};
                    passages_[place(faces_[f], level)] = passage(face, level);
                }
            }
        });
    }

    [[nodiscard]] std::uint32_t place(const FacePassages& face, std::uint32_t level) const {
        return places_[face.first + (level - face.levels.first)];
    }

    /// Where the half-edge begins that rises through the level. Looked up: branches would be guessed wrongly.
    [[nodiscard]] unsigned rising_corner(FaceId f, std::uint32_t level) const {
        const auto bit = [&](unsigned corner) {
            return static_cast<unsigned>(sites_.is_above(mesh_.vertex(f, corner), level)) << corner;
        };
        constexpr std::array<std::uint8_t, 8> kCorners{0, 2, 0, 2, 1, 1, 0, 0};  // by corners above
        return kCorners[bit(0) | bit(1) | bit(2)];
    }

    [[nodiscard]] Passage passage(FaceId f, std::uint32_t level) const {
        const unsigned corner = rising_corner(f, level);
        const VertexId below = mesh_.vertex(f, corner);
        const VertexId above = mesh_.vertex(f, next_corner(corner));
        const Point2 p = sites_.crossing(below, above, level);
        // No level crosses what is not terrain.
        const FacePassages& behind = faces_[face_of(mesh_.twin(half_edge(f, corner))).value];
        const bool is_inside = behind.levels.first <= level && level < behind.levels.last;
        return {p.x, p.y, edge_name(below, above), is_inside ? place(behind, level) : Passage::kBorder};
    }

    void follow_level(std::uint32_t level, Found& found) {
        found.points.clear();
        found.lines.clear();
        // Lines begin where a half-edge of the border falls through the level.
        for (const std::uint32_t i : starts_.of(level)) {
            const HalfEdgeId h = border_[i];
            Line line;
            line.smallest_edge = edge_name(mesh_.origin(h), mesh_.destination(h));
            line.begin = found.points.size();
            found.points.push_back(sites_.crossing(mesh_.origin(h), mesh_.destination(h), level));
            follow(place(faces_[face_of(h).value], level), line, found);
        }
        for (std::uint32_t i = begins_[level]; i < begins_[level + 1]; ++i) {
            if (passages_[i].next != Passage::kTaken) {
                Line line;
                line.begin = found.points.size();
                line.is_closed = true;
                follow(i, line, found);
            }
        }
        std::sort(found.lines.begin(), found.lines.end(),
                  [](const Line& a, const Line& b) { return a.smallest_edge < b.smallest_edge; });
        LevelLines& result = lines_[level];
        result.points.reserve(found.points.size() + found.lines.size());
        for (const Line& line : found.lines) {
            take(line, found.points, result);
        }
    }

    /// From passage to passage to the border, or around. In every face a line enters by the half-edge that
    /// falls through the level and leaves by the one that rises, so that higher ground is on its left.
    void follow(std::uint32_t at, Line line, Found& found) {
        while (at != Passage::kBorder) {
            Passage& passage = passages_[at];
            at = passage.next;
            if (at == Passage::kTaken) {
                break;
            }
            if (passage.edge < line.smallest_edge) {
                line.smallest_edge = passage.edge;
                line.smallest_point = found.points.size() - line.begin;
            }
            found.points.push_back({passage.x, passage.y});
            passage.next = Passage::kTaken;
        }
        line.smallest_point += line.begin;
        line.end = found.points.size();
        found.lines.push_back(line);
    }

    /// Appends a line without repetitions, a closed one from its smallest edge on.
    static void take(const Line& line, const std::vector<Point2>& points, LevelLines& result) {
        const std::size_t begin = result.points.size();
        const auto append = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) {
                if (result.points.size() == begin || result.points.back() != points[i]) {
                    result.points.push_back(points[i]);
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
    std::vector<HalfEdgeId> border_;
    LargeVector<FacePassages> faces_;    // by slot
    LargeVector<std::uint32_t> places_;  // of passages, face by face
    std::vector<std::uint32_t> begins_;  // by level: of its passages
    LargeVector<Passage> passages_;      // level by level
    LevelLists starts_;                  // half-edges of the border, as indices, that fall through levels
    std::vector<LevelLines> lines_;
};

}  // namespace

std::vector<LevelLines> make_contours(const Tin& tin, std::span<const double> levels,
                                      const Progress& progress) {
    const ContourSites sites(tin, levels);
    return LineCutter(tin.mesh, sites).cut(progress);
}

std::vector<LevelLines> make_contours(const TriangleMesh& mesh, std::span<const Point3> vertices,
                                      std::span<const double> levels, const Progress& progress) {
    const ContourSites sites(vertices, levels);
    return LineCutter(mesh, sites).cut(progress);
}

}  // namespace tinwright
