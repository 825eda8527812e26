#include "tinwright/breaklines/noding.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include "tinwright/breaklines/crossing_elevations.hpp"
#include "tinwright/breaklines/line_network.hpp"
#include "tinwright/breaklines/line_snapping.hpp"
#include "tinwright/breaklines/line_visits.hpp"
#include "tinwright/breaklines/meeting_conflicts.hpp"
#include "tinwright/breaklines/segment_crossings.hpp"
#include "tinwright/breaklines/snap_rounding.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {
namespace {

using Kind = LineConflict::Kind;
using Action = LineConflict::Action;

/// A conflict before its location is written out.
struct PlacedConflict {
    std::uint32_t vertex;
    Kind kind;
    Action action;
    std::uint32_t line_a;
    std::uint32_t line_b;
    double z_a;
    double z_b;
    bool is_settled;  ///< an ElevationClash that no policy needs to decide
};

constexpr double kNoZ = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBlock = 4096;  // vertices a task

class Noding {
  public:
    Noding(std::span<const Breakline> lines, const Lattice& lattice, const NodingOptions& options)
        : lines_(lines), lattice_(lattice), options_(options) {}

    NodedLines make() {
        points_ = gather_points(lines_, lattice_);
        SnappedLines snapped;
        if (options_.snap > 0) {
            snapped = snap_lines(points_, options_.snap / lattice_.quantum());
        }
        network_ = make_network(points_);
        report_progress(options_.progress, 0.1);
        round(snapped);
        report_progress(options_.progress, 0.6);
        first_alike_ = find_repeated_lines(points_, network_);
        visits_ = gather_visits(walk(), lines_.size(), rounded_.vertices.size());
        meet();
        out_.keys = rounded_.vertices;
        report_progress(options_.progress, 0.8);
        make_pieces();
        add_conflicts_of_lines(snapped);
        write_conflicts();
        if (options_.keep_chains) {
            make_chains();
        }
        report_progress(options_.progress, 1);
        return std::move(out_);
    }

  private:
    void round(const SnappedLines& snapped) {
        std::vector<std::uint32_t> led;
        for (const std::uint32_t point : snapped.led_from) {
            if (network_.segment_at[point] != kNoSegment) {
                led.push_back(network_.segment_at[point]);
            }
        }
        rounded_ = round_segments(network_, find_crossings(network_), led);
        out_.is_rounded = rounded_.is_rounded;
    }

    [[nodiscard]] LineWalk walk() const { return {points_, network_, rounded_}; }

    /// Elevations, origins, and the conflicts of lines that meet at a vertex.
    void meet() {
        const std::size_t count = rounded_.vertices.size();
        out_.z.resize(count);
        out_.origin.resize(count);
        std::vector<std::vector<PlacedConflict>> found((count + kBlock - 1) / kBlock);
        tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t block) {
            CrossingElevations elevations(lines_, points_, network_, rounded_, options_);
            const std::size_t end = std::min(count, (block + 1) * kBlock);
            for (std::size_t v = block * kBlock; v < end; ++v) {
                meet_at(static_cast<std::uint32_t>(v), elevations, found[block]);
            }
        });
        for (const std::vector<PlacedConflict>& part : found) {
            conflicts_.insert(conflicts_.end(), part.begin(), part.end());
        }
        if (options_.crossing_z == CrossingPolicy::Error) {
            refuse_clashes();
        }
    }

    void meet_at(std::uint32_t vertex, CrossingElevations& elevations, std::vector<PlacedConflict>& found) {
        const std::span<const LineVisit> visits = visits_.at(vertex);
        const auto own =
            std::find_if(visits.begin(), visits.end(), [](const LineVisit& visit) { return visit.is_own; });
        out_.origin[vertex] = own != visits.end() ? own->point : NodedLines::kCrossing;
        const MeetingElevation met = elevations.meet(visits, vertex);
        out_.z[vertex] = met.z;
        if (met.is_clash) {
            add_pair({Kind::ElevationClash, Action::Chosen, met.is_settled}, vertex,
                     {met.low->line, met.z_low}, {met.high->line, met.z_high}, found);
        }
        if (visits.size() > 1) {
            for (const VisitPair& pair : find_meetings(visits, first_alike_)) {
                add_pair({pair.kind, Action::Noded, true}, vertex,
                         {pair.a->line, elevations.elevation(*pair.a, vertex)},
                         {pair.b->line, elevations.elevation(*pair.b, vertex)}, found);
            }
        }
    }

    struct Sort {
        Kind kind;
        Action action;
        bool is_settled;
    };
    struct LineThere {
        std::uint32_t line;
        double z;
    };
    static void add_pair(Sort sort, std::uint32_t vertex, LineThere a, LineThere b,
                         std::vector<PlacedConflict>& found) {
        if (a.line > b.line) {
            std::swap(a, b);
        }
        found.push_back({vertex, sort.kind, sort.action, a.line, b.line, a.z, b.z, sort.is_settled});
    }

    void refuse_clashes() const {
        const PlacedConflict* first = nullptr;
        std::size_t count = 0;
        for (const PlacedConflict& conflict : conflicts_) {  // still in the order of vertices
            if (!conflict.is_settled) {
                first = first == nullptr ? &conflict : first;
                ++count;
            }
        }
        if (first == nullptr) {
            return;
        }
        throw BreaklineError(
            "lines have different elevations at " + std::to_string(count) +
                (count == 1 ? " place, " : " places, the first ") +
                location_text(lattice_.position(rounded_.vertices[first->vertex])) + " with z " +
                decimal_text(first->z_a) + " and " + decimal_text(first->z_b) +
                "; say which to take with --crossing-z mean|first|min|max, or allow for the difference with "
                "--crossing-tolerance",
            {first->line_a, first->line_b});
    }

    /// Sorted by first vertex in buckets, each of which is short.
    void make_pieces() {
        const auto for_each_piece = [&](const auto& visit) {
            for (std::uint32_t line = 0; line < lines_.size(); ++line) {
                std::uint32_t last = kNoVertex;
                walk().for_each_stop(line, [&](const LineStop& stop) {
                    if (last != kNoVertex && last != stop.vertex) {
                        visit(NodedPiece{std::min(last, stop.vertex), std::max(last, stop.vertex), line});
                    }
                    last = stop.vertex;
                });
            }
        };
        std::vector<std::uint32_t> next(out_.keys.size() + 1);
        for_each_piece([&](const NodedPiece& piece) { ++next[piece.a + 1]; });
        for (std::size_t v = 0; v < out_.keys.size(); ++v) {
            next[v + 1] += next[v];
        }
        out_.pieces.resize(next.back());
        for_each_piece([&](const NodedPiece& piece) { out_.pieces[next[piece.a]++] = piece; });
        std::uint32_t first = 0;
        for (std::size_t v = 0; v < out_.keys.size(); ++v) {
            std::sort(out_.pieces.begin() + first, out_.pieces.begin() + next[v]);
            first = next[v];
        }
        count_runs();
    }

    /// Repeated pieces become one each.
    void count_runs() {
        std::size_t count = 0;
        for (const NodedPiece& piece : out_.pieces) {
            NodedPiece* const last = count > 0 ? &out_.pieces[count - 1] : nullptr;
            if (last != nullptr && last->a == piece.a && last->b == piece.b && last->line == piece.line) {
                ++last->runs;
            } else {
                out_.pieces[count++] = piece;
            }
        }
        out_.pieces.resize(count);
    }

    void add_overlaps() {
        std::vector<NodedPiece> of_first_lines;
        of_first_lines.reserve(out_.pieces.size());
        std::copy_if(out_.pieces.begin(), out_.pieces.end(), std::back_inserter(of_first_lines),
                     [&](const NodedPiece& piece) { return first_alike_[piece.line] == piece.line; });
        for (const SharedStretch& stretch : find_shared_stretches(of_first_lines)) {
            add_at(Kind::Overlap, Action::Merged, stretch.vertex, stretch.line_a, stretch.line_b);
        }
    }

    void add_conflicts_of_lines(const SnappedLines& snapped) {
        add_overlaps();
        for (const NearMiss& miss : snapped.misses) {
            add_at(Kind::NearMiss, Action::Snapped, vertex_of(miss.point), miss.line_a, miss.line_b);
        }
        for (std::uint32_t line = 0; line < lines_.size(); ++line) {
            const std::uint32_t first = points_.start[line];
            const std::uint32_t end = points_.start[line + 1];
            if (first == end) {
                continue;
            }
            if (first_alike_[line] != line) {
                std::uint32_t lowest = vertex_of(first);
                for (std::uint32_t i = first; i < end; ++i) {
                    lowest = std::min(lowest, vertex_of(i));
                }
                add_at(Kind::Duplicate, Action::Merged, lowest, first_alike_[line], line);
            }
            const auto segments = std::span(network_.segment_at).subspan(first, end - first);
            const bool has_length = std::any_of(segments.begin(), segments.end(),
                                                [](std::uint32_t s) { return s != kNoSegment; });
            if (!has_length) {
                add_at(Kind::ZeroLength, Action::Dropped, vertex_of(first), line, LineConflict::kNone);
            }
            for (std::uint32_t i = first; has_length && i + 1 < end; ++i) {
                if (network_.segment_at[i] == kNoSegment) {
                    add_at(Kind::ZeroLength, Action::Merged, vertex_of(i), line, LineConflict::kNone);
                }
            }
        }
    }

    [[nodiscard]] std::uint32_t vertex_of(std::uint32_t point) const {
        return rounded_.of_site[network_.site[point]];
    }

    /// With what the lines, which come by there, say of the elevation.
    void add_at(Kind kind, Action action, std::uint32_t vertex, std::uint32_t line_a, std::uint32_t line_b) {
        const CrossingElevations elevations(lines_, points_, network_, rounded_, options_);
        const auto z_of = [&](std::uint32_t line, bool is_second) {
            const std::span<const LineVisit> visits = visits_.of_line(line, vertex);
            return visits.empty() ? kNoZ
                                  : elevations.elevation(is_second ? visits.back() : visits.front(), vertex);
        };
        const double z_b = line_b == LineConflict::kNone ? kNoZ : z_of(line_b, line_a == line_b);
        conflicts_.push_back({vertex, kind, action, line_a, line_b, z_of(line_a, false), z_b, true});
    }

    /// Conflicts of the same place are one, named after the smallest line numbers.
    void write_conflicts() {
        const auto names_each_line = [](Kind kind) {
            return kind == Kind::ZeroLength || kind == Kind::Duplicate;
        };
        std::stable_sort(conflicts_.begin(), conflicts_.end(),
                         [](const PlacedConflict& p, const PlacedConflict& q) {
                             return std::tuple(p.vertex, p.kind, p.action, p.line_a, p.line_b) <
                                    std::tuple(q.vertex, q.kind, q.action, q.line_a, q.line_b);
                         });
        conflicts_.erase(std::unique(conflicts_.begin(), conflicts_.end(),
                                     [&](const PlacedConflict& p, const PlacedConflict& q) {
                                         return p.vertex == q.vertex && p.kind == q.kind &&
                                                (!names_each_line(p.kind) ||
                                                 (p.line_a == q.line_a && p.line_b == q.line_b));
                                     }),
                         conflicts_.end());
        out_.conflicts.reserve(conflicts_.size());
        for (const PlacedConflict& placed : conflicts_) {
            LineConflict conflict;
            conflict.kind = placed.kind;
            conflict.action = placed.action;
            conflict.line_a = placed.line_a;
            conflict.line_b = placed.line_b;
            conflict.location = lattice_.position(out_.keys[placed.vertex]);
            conflict.z_a = placed.z_a;
            conflict.z_b = placed.z_b;
            out_.conflicts.push_back(conflict);
        }
    }

    void make_chains() {
        for (std::size_t line = 0; line < lines_.size(); ++line) {
            out_.chain_start.push_back(static_cast<std::uint32_t>(out_.chains.size()));
            walk().for_each_stop(line, [&](const LineStop& stop) {
                if (!stop.is_repeated) {
                    out_.chains.push_back(stop.vertex);
                }
            });
        }
        out_.chain_start.push_back(static_cast<std::uint32_t>(out_.chains.size()));
    }

    std::span<const Breakline> lines_;
    const Lattice& lattice_;
    const NodingOptions& options_;
    LinePoints points_;
    LineNetwork network_;
    RoundedSegments rounded_;
    std::vector<std::uint32_t> first_alike_;  // for each line the first that it repeats
    LineVisits visits_;
    std::vector<PlacedConflict> conflicts_;
    NodedLines out_;
};

}  // namespace

NodedLines node_lines(std::span<const Breakline> lines, const Lattice& lattice,
                      const NodingOptions& options) {
    return Noding(lines, lattice, options).make();
}

}  // namespace tinwright
