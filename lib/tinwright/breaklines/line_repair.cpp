#include "tinwright/breaklines/line_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "tinwright/breaklines/keyed_lines.hpp"
#include "tinwright/breaklines/line_segments.hpp"
#include "tinwright/breaklines/point_joining.hpp"
#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {
namespace {

using Kind = LineConflict::Kind;
using Chain = std::vector<std::uint32_t>;

/// A line at work: one that came in, or a part of one.
struct WorkLine {
    Breakline line;
    LineTraits traits;
    std::uint32_t source = 0;  ///< index of the line that came in
};

/// Leaves out of chains what earlier ones have already.
class StretchKeeper {
  public:
    StretchKeeper(std::span<const WorkLine> lines, std::span<const Chain> chains)
        : lines_(lines), chains_(chains), parts_(lines.size()) {}

    std::vector<std::vector<Chain>> run() {
        keep_polygons();
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (!lines_[i].traits.is_ring) {
                keep_line(i);
            }
        }
        return std::move(parts_);
    }

  private:
    using Piece = std::tuple<LineRole, std::uint32_t, std::uint32_t>;  // vertices, the smaller first
    using Polygon = std::pair<LineRole, std::uint32_t>;

    static Piece piece_of(LineRole role, std::uint32_t a, std::uint32_t b) {
        return {role, std::min(a, b), std::max(a, b)};
    }
    void keep_polygons();
    void keep_line(std::size_t line);

    std::span<const WorkLine> lines_;
    std::span<const Chain> chains_;
    std::vector<std::vector<Chain>> parts_;
    std::set<Piece> taken_;
};

/// Polygons share edges with each other: only one that is there as a whole is left out.
void StretchKeeper::keep_polygons() {
    std::map<Polygon, std::vector<std::size_t>> rings;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        const bool has_area = chains_[i].size() > 3 && chains_[i].front() == chains_[i].back();
        if (lines_[i].traits.is_ring && has_area) {
            rings[{lines_[i].line.role, lines_[i].traits.polygon}].push_back(i);
        }
    }
    std::set<std::vector<Piece>> known;
    for (const auto& [polygon, members] : rings) {
        std::vector<Piece> pieces;
        for (const std::size_t ring : members) {
            for (std::size_t p = 0; p + 1 < chains_[ring].size(); ++p) {
                pieces.push_back(piece_of(polygon.first, chains_[ring][p], chains_[ring][p + 1]));
            }
        }
        std::sort(pieces.begin(), pieces.end());
        if (!known.insert(pieces).second) {
            continue;
        }
        taken_.insert(pieces.begin(), pieces.end());
        for (const std::size_t ring : members) {
            parts_[ring] = {chains_[ring]};
        }
    }
}

void StretchKeeper::keep_line(std::size_t line) {
    const Chain& chain = chains_[line];
    std::vector<Chain>& parts = parts_[line];
    bool is_open = false;  // whether the last part goes on
    for (std::size_t p = 0; p + 1 < chain.size(); ++p) {
        const bool is_new = taken_.insert(piece_of(lines_[line].line.role, chain[p], chain[p + 1])).second;
        if (is_new && !is_open) {
            parts.push_back({chain[p]});
        }
        if (is_new) {
            parts.back().push_back(chain[p + 1]);
        }
        is_open = is_new;
    }
    // Of a closed line the place where it begins is no reason to cut it.
    if (parts.size() > 1 && chain.front() == chain.back() && parts.front().front() == chain.front() &&
        parts.back().back() == chain.back()) {
        parts.back().insert(parts.back().end(), parts.front().begin() + 1, parts.front().end());
        parts.erase(parts.begin());
    }
}

class LineRepairer {
  public:
    LineRepairer(std::span<const Breakline> lines, std::span<const Point3> samples,
                 const LineRepairOptions& options)
        : lines_(lines), samples_(samples), options_(options), lattice_(shared_lattice(lines, samples)) {
        const std::vector<LineTraits> traits = complete_traits(lines, options.check.traits);
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            work_.push_back({lines[i], traits[i], i});
        }
    }

    LineRepair run() {
        constexpr std::size_t kMostRounds = 8;
        LineRepair repair;
        repair.found = check(lines_);
        found_snap_ = repair.found.snap;
        found_dangling_ = repair.found.dangling;
        refuse_clashes(repair.found);
        do {
            do_round(repair.rounds == 0);
            ++repair.rounds;
            repair.left = check_work();
        } while (repair.rounds < kMostRounds &&
                 std::any_of(repair.left.conflicts.begin(), repair.left.conflicts.end(), is_repairable));
        for (LineConflict& conflict : repair.left.conflicts) {
            for (std::uint32_t* const line : {&conflict.line_a, &conflict.line_b}) {
                *line = *line == LineConflict::kNone ? *line : work_[*line].source;
            }
        }
        repair.lines.resize(lines_.size());
        for (WorkLine& work : work_) {
            repair.lines[work.source].push_back(std::move(work.line.points));
        }
        return repair;
    }

  private:
    [[nodiscard]] LineCheckReport check(std::span<const Breakline> lines) const {
        return check_lines(lines, samples_, options_.check);
    }
    LineCheckReport check_work();
    void refuse_clashes(const LineCheckReport& found) const;
    void do_round(bool is_first);
    void add_samples_on_draped(KeyedLines& keyed) const;
    void snap(KeyedLines& keyed) const;
    static bool lacks_z(const CleanLine& line);
    void replace_work(const KeyedLines& keyed);
    [[nodiscard]] std::vector<Breakline> lines_at_work() const;
    [[nodiscard]] LineCheckOptions check_options() const;

    std::span<const Breakline> lines_;
    std::span<const Point3> samples_;
    const LineRepairOptions& options_;
    Lattice lattice_;
    std::vector<WorkLine> work_;
    double found_snap_ = 0;  // the distances of the first audit, CRS units
    double found_dangling_ = 0;
};

std::vector<Breakline> LineRepairer::lines_at_work() const {
    std::vector<Breakline> lines;
    for (const WorkLine& work : work_) {
        lines.push_back(work.line);
    }
    return lines;
}

LineCheckOptions LineRepairer::check_options() const {
    LineCheckOptions options = options_.check;
    options.progress = {};
    // Noding shortens segments; what was near, or dangling, before is judged by the same distances after.
    options.snap = found_snap_;
    options.dangling = found_dangling_;
    options.traits.clear();
    for (const WorkLine& work : work_) {
        options.traits.push_back(work.traits);
    }
    return options;
}

LineCheckReport LineRepairer::check_work() { return check_lines(lines_at_work(), samples_, check_options()); }

void LineRepairer::refuse_clashes(const LineCheckReport& found) const {
    if (options_.crossing_z != CrossingPolicy::Error) {
        return;
    }
    for (const LineConflict& conflict : found.conflicts) {
        const bool is_clash = (conflict.kind == Kind::ZeroLength || conflict.kind == Kind::ElevationClash) &&
                              conflict.line_a != LineConflict::kNone &&
                              std::abs(conflict.z_a - conflict.z_b) > options_.check.crossing_tolerance;
        if (is_clash) {
            std::vector<std::size_t> concerned{conflict.line_a};
            if (conflict.line_b != LineConflict::kNone) {
                concerned.push_back(conflict.line_b);
            }
            throw BreaklineError("lines with z " + decimal_text(conflict.z_a) + " and " +
                                     decimal_text(conflict.z_b) + " at " + location_text(conflict.location) +
                                     "; choose one with --crossing-z mean, first, min or max",
                                 concerned);
        }
    }
}

void LineRepairer::do_round(bool is_first) {
    const std::vector<Breakline> lines = lines_at_work();
    KeyedLines keyed = key_lines(lines, lattice_, check_options(), options_.crossing_z);
    if (is_first && options_.drape) {
        add_samples_on_draped(keyed);
    }
    snap(keyed);
    replace_work(keyed);
}

/// A sample on a line without z is a point of the line, since the surface has its elevation there.
void LineRepairer::add_samples_on_draped(KeyedLines& keyed) const {
    const LineSegments segments(keyed.lines);
    std::vector<PointInsertion> insertions;
    for (const Point3& sample : samples_) {
        const Key2 key = lattice_.key({sample.x, sample.y});
        segments.visit_meeting({key, key}, [&](const LineSegments::Segment& segment) {
            const Key2 a = segments.start(segment);
            const Key2 b = segments.end(segment);
            const bool has_z = !std::isnan(segments.elevation(segment, 0.5));
            if (keyed.traits[segment.line].is_draped || has_z || !is_on_segment(key, a, b)) {
                return;
            }
            if (key == a || key == b) {
                double& z = keyed.lines[segment.line].z[segment.index + (key == b ? 1U : 0U)];
                z = std::isnan(z) ? sample.z : z;
            } else {
                insertions.push_back(
                    {segment.line, segment.index, measure_distance(key, a, b).fraction, key, sample.z});
            }
        });
    }
    insert_points(keyed.lines, std::move(insertions));
}

void LineRepairer::snap(KeyedLines& keyed) const {
    constexpr int kMostSteps = 32;
    for (int step = 0; step < kMostSteps && snap_near_misses(keyed); ++step) {
        for (std::size_t i = 0; i < keyed.lines.size(); ++i) {
            std::vector<Point3> points;
            for (std::size_t p = 0; p < keyed.lines[i].keys.size(); ++p) {
                const Point2 at = lattice_.position(keyed.lines[i].keys[p]);
                points.push_back({at.x, at.y, keyed.lines[i].z[p]});
            }
            const CleanOptions clean{keyed.snap, keyed.traits[i].is_ring, options_.crossing_z};
            keyed.lines[i] = clean_line(points, lattice_, clean, keyed.faults[i]);
        }
    }
}

bool LineRepairer::lacks_z(const CleanLine& line) {
    return std::any_of(line.z.begin(), line.z.end(), [](double z) { return std::isnan(z); });
}

/// Nodes the lines and makes their parts the lines to go on with.
void LineRepairer::replace_work(const KeyedLines& keyed) {
    const NodedLines noded = node_keyed_lines(keyed, lines_at_work(),
                                              {.crossing_z = options_.crossing_z,
                                               .crossing_tolerance = options_.check.crossing_tolerance,
                                               .keep_chains = true,
                                               .progress = {}});
    std::vector<WorkLine> old = std::move(work_);
    for (std::size_t i = 0; i < old.size(); ++i) {
        old[i].traits = keyed.traits[i];
    }
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < old.size(); ++i) {
        chains.emplace_back(noded.chains.begin() + noded.chain_start[i],
                            noded.chains.begin() + noded.chain_start[i + 1]);
    }
    const std::vector<std::vector<Chain>> parts = StretchKeeper(old, chains).run();
    work_.clear();
    for (std::size_t i = 0; i < old.size(); ++i) {
        // With z in some places a line to be draped would be one that lacks z elsewhere.
        const bool stays_draped = old[i].traits.is_draped && lacks_z(keyed.lines[i]);
        for (const Chain& part : parts[i]) {
            WorkLine work = old[i];
            work.line.points.clear();
            for (const std::uint32_t vertex : part) {
                const Point2 at = lattice_.position(noded.keys[vertex]);
                double z = noded.z[vertex];
                if (stays_draped) {
                    z = kDraped;
                } else if (options_.drape && std::isnan(z)) {
                    z = options_.drape(at);
                }
                work.line.points.push_back({at.x, at.y, z});
            }
            work_.push_back(std::move(work));
        }
    }
}

}  // namespace

bool is_repairable(const LineConflict& conflict) {
    switch (conflict.kind) {
        case Kind::Crossing:
        case Kind::SelfCrossing:
        case Kind::Touch:
        case Kind::Overlap:
        case Kind::Duplicate:
        case Kind::ZeroLength:
        case Kind::NearMiss:
        case Kind::Spike:
        case Kind::OpenRing:
            return true;
        case Kind::ElevationClash:
            return conflict.line_a != LineConflict::kNone;
        default:
            return false;
    }
}

LineRepair repair_lines(std::span<const Breakline> lines, std::span<const Point3> samples,
                        const LineRepairOptions& options) {
    return LineRepairer(lines, samples, options).run();
}

}  // namespace tinwright
