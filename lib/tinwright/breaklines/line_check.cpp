#include "tinwright/breaklines/line_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>

#include "tinwright/breaklines/keyed_lines.hpp"
#include "tinwright/breaklines/line_overlaps.hpp"
#include "tinwright/breaklines/near_lines.hpp"
#include "tinwright/breaklines/polygon_cover.hpp"
#include "tinwright/breaklines/sample_hull.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {
namespace {

using Kind = LineConflict::Kind;

class LineAudit {
  public:
    LineAudit(std::span<const Breakline> lines, std::span<const Point3> samples,
              const LineCheckOptions& options)
        : lines_(lines),
          samples_(samples),
          options_(options),
          keyed_(key_lines(lines, shared_lattice(lines, samples), options)) {}

    LineCheckReport run() {
        list_faults();
        list_missing_z();
        list_noded();
        report_progress(options_.progress, 0.4);
        list_near();
        report_progress(options_.progress, 0.6);
        list_outside_boundary();
        list_samples();
        return finish();
    }

  private:
    void list_faults();
    void list_missing_z();
    void list_noded();
    void list_near();
    void list_outside_boundary();
    void list_samples();
    void list_clashing_samples(std::span<const Key2> keys);
    void list_outside_samples(std::span<const Key2> keys);
    LineCheckReport finish();

    void add(Kind kind, std::size_t line, Key2 key, double z) {
        FoundConflict found{{}, key};
        found.conflict.kind = kind;
        found.conflict.line_a = static_cast<std::uint32_t>(line);
        found.conflict.z_a = z;
        found_.push_back(found);
    }
    void add(std::vector<FoundConflict> found) { found_.insert(found_.end(), found.begin(), found.end()); }

    std::span<const Breakline> lines_;
    std::span<const Point3> samples_;
    const LineCheckOptions& options_;
    KeyedLines keyed_;
    NodedLines noded_;
    std::vector<FoundConflict> found_;
};

void LineAudit::list_faults() {
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        for (const LineFault& fault : keyed_.faults[line]) {
            add(fault.kind, line, fault.key, fault.z_a);
            found_.back().conflict.z_b = fault.z_b;
        }
    }
}

void LineAudit::list_missing_z() {
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        if (keyed_.traits[line].is_draped) {
            continue;
        }
        bool is_missing_before = false;
        for (const Point3& point : lines_[line].points) {
            const bool is_missing = std::isnan(point.z);
            if (is_missing && !is_missing_before) {
                add(Kind::MissingZ, line, keyed_.lattice.key({point.x, point.y}), kDraped);
            }
            is_missing_before = is_missing;
        }
    }
}

/// What `node_lines` finds, without what lines may share.
void LineAudit::list_noded() {
    const NodingOptions options{.crossing_z = CrossingPolicy::Mean,
                                .crossing_tolerance = options_.crossing_tolerance,
                                .progress = {}};
    noded_ = node_keyed_lines(keyed_, lines_, options);
    for (const LineConflict& conflict : noded_.conflicts) {
        if (conflict.kind != Kind::Overlap && conflict.kind != Kind::Duplicate) {
            found_.push_back({conflict, keyed_.lattice.key(conflict.location)});
        }
    }
    add(find_overlaps(keyed_, lines_, noded_));
}

void LineAudit::list_near() {
    const LineSegments segments(keyed_.lines);
    if (keyed_.snap > 0) {
        add(find_near_misses(keyed_.lines, segments, keyed_.snap));
    }
    if (keyed_.dangling > 0) {
        std::vector<Key2> near_misses;
        for (const FoundConflict& found : found_) {
            if (found.conflict.kind == Kind::NearMiss) {
                near_misses.push_back(found.key);
            }
        }
        std::sort(near_misses.begin(), near_misses.end(), precedes);
        std::vector<bool> is_ring(lines_.size());
        for (std::size_t line = 0; line < lines_.size(); ++line) {
            is_ring[line] = keyed_.traits[line].is_ring;
        }
        std::vector<FoundConflict> dangling =
            find_dangling_ends(keyed_.lines, is_ring, segments, keyed_.dangling);
        std::erase_if(dangling, [&](const FoundConflict& found) {
            return std::binary_search(near_misses.begin(), near_misses.end(), found.key, precedes);
        });
        add(std::move(dangling));
    }
}

/// Groups the pieces of one line that are outside by the vertices that they share.
class PieceGroups {
  public:
    std::uint32_t find(std::uint32_t vertex) {
        const auto at = parent_.try_emplace(vertex, vertex).first;
        return at->second == vertex ? vertex : at->second = find(at->second);
    }
    void join(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t first = find(a);
        const std::uint32_t second = find(b);
        parent_[std::max(first, second)] = std::min(first, second);
    }

  private:
    std::map<std::uint32_t, std::uint32_t> parent_;
};

void LineAudit::list_outside_boundary() {
    std::vector<CleanLine> rings;
    std::vector<std::uint32_t> polygons;
    // Twice the keys, for the middle of a piece to have one.
    const auto doubled = [](Key2 key) { return Key2{2 * key.x, 2 * key.y}; };
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        if (lines_[line].role == LineRole::Boundary) {
            rings.push_back(keyed_.lines[line]);
            std::transform(rings.back().keys.begin(), rings.back().keys.end(), rings.back().keys.begin(),
                           doubled);
            polygons.push_back(lines_[line].polygon);
        }
    }
    if (rings.empty()) {
        return;
    }
    const PolygonCover cover(std::move(rings), std::move(polygons));
    const std::vector<NodedPiece>& pieces = noded_.pieces;
    std::vector<char> is_outside(pieces.size());
    tbb::parallel_for(std::size_t{0}, pieces.size(), [&](std::size_t i) {
        const Key2 a = noded_.keys[pieces[i].a];
        const Key2 b = noded_.keys[pieces[i].b];
        const bool counts = lines_[pieces[i].line].role != LineRole::Boundary;
        is_outside[i] = static_cast<char>(counts && !cover.covers({a.x + b.x, a.y + b.y}));
    });
    std::map<std::uint32_t, PieceGroups> groups;  // of each line
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_outside[i] != 0) {
            groups[pieces[i].line].join(pieces[i].a, pieces[i].b);
        }
    }
    // A part is named by the first of its vertices that is outside itself, or else the middle of a piece.
    struct Part {
        bool has_vertex;
        Key2 key;
        double z;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Part> parts;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_outside[i] == 0) {
            continue;
        }
        const std::uint32_t a = pieces[i].a;
        const std::uint32_t b = pieces[i].b;
        const Key2 middle = {std::floor((noded_.keys[a].x + noded_.keys[b].x) / 2),
                             std::floor((noded_.keys[a].y + noded_.keys[b].y) / 2)};
        Part& part = parts
                         .try_emplace({pieces[i].line, groups[pieces[i].line].find(a)},
                                      Part{false, middle, (noded_.z[a] + noded_.z[b]) / 2})
                         .first->second;
        for (const std::uint32_t vertex : {a, b}) {
            if (!part.has_vertex && !cover.covers(doubled(noded_.keys[vertex]))) {
                part = {true, noded_.keys[vertex], noded_.z[vertex]};
            }
        }
    }
    for (const auto& [where, part] : parts) {
        add(Kind::OutsideBoundary, where.first, part.key, part.z);
    }
}

void LineAudit::list_samples() {
    std::vector<Key2> keys(samples_.size());
    tbb::parallel_for(std::size_t{0}, samples_.size(), [&](std::size_t i) {
        keys[i] = keyed_.lattice.key({samples_[i].x, samples_[i].y});
    });
    list_clashing_samples(keys);
    const LineSegments segments(keyed_.lines);
    add(find_samples_at_lines(
        samples_, keys, segments,
        {options_.crossing_tolerance, options_.line_tolerance / keyed_.lattice.quantum()}));
    list_outside_samples(keys);
}

void LineAudit::list_clashing_samples(std::span<const Key2> keys) {
    const std::vector<std::uint32_t> order = sort_along_curve(keys);
    for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
        const std::uint32_t first = order[begin];
        for (end = begin + 1; end < order.size() && keys[order[end]] == keys[first]; ++end) {
            const std::uint32_t sample = order[end];
            if (std::abs(samples_[sample].z - samples_[first].z) > options_.crossing_tolerance) {
                FoundConflict found{{}, keys[first]};
                found.conflict.kind = Kind::ElevationClash;
                found.conflict.sample = sample;
                found.conflict.other_sample = first;
                found.conflict.z_a = samples_[first].z;
                found.conflict.z_b = samples_[sample].z;
                found_.push_back(found);
            }
        }
    }
}

void LineAudit::list_outside_samples(std::span<const Key2> keys) {
    const auto needs_samples = [&](std::size_t line) {
        return keyed_.traits[line].is_draped && !is_polygon_role(lines_[line].role);
    };
    std::vector<std::size_t> draped;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        if (needs_samples(line)) {
            draped.push_back(line);
        }
    }
    if (draped.empty() || keys.empty()) {
        return;
    }
    const SampleHull hull(keys);
    for (const std::size_t line : draped) {
        const CleanLine& points = keyed_.lines[line];
        for (std::size_t i = 0; i < points.keys.size(); ++i) {
            if (std::isnan(points.z[i]) && !hull.covers(points.keys[i])) {
                add(Kind::OutsideSamples, line, points.keys[i], kDraped);
                break;
            }
        }
    }
}

LineCheckReport LineAudit::finish() {
    std::vector<Key2> keys;
    keys.reserve(found_.size());
    for (const FoundConflict& found : found_) {
        keys.push_back(found.key);
    }
    const std::vector<std::uint32_t> order = sort_along_curve(keys);
    std::vector<std::uint32_t> rank(found_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        const bool is_same = i > 0 && keys[order[i]] == keys[order[i - 1]];
        rank[order[i]] = is_same ? rank[order[i - 1]] : i;
    }
    std::vector<std::uint32_t> sorted(found_.size());
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto place = [&](std::uint32_t i) {
            const LineConflict& conflict = found_[i].conflict;
            return std::tuple(conflict.kind, rank[i], conflict.line_a, conflict.line_b, conflict.sample, i);
        };
        return place(a) < place(b);
    });
    LineCheckReport report;
    for (const std::uint32_t i : sorted) {
        report.conflicts.push_back(found_[i].conflict);
        report.conflicts.back().action = LineConflict::Action::Reported;
        report.conflicts.back().location = keyed_.lattice.position(found_[i].key);
    }
    const double quantum = keyed_.lattice.quantum();
    report.snap = options_.snap.value_or(keyed_.snap * quantum);
    report.dangling = options_.dangling.value_or(keyed_.dangling * quantum);
    report_progress(options_.progress, 1);
    return report;
}

}  // namespace

LineCheckReport check_lines(std::span<const Breakline> lines, std::span<const Point3> samples,
                            const LineCheckOptions& options) {
    return LineAudit(lines, samples, options).run();
}

}  // namespace tinwright
