#include "tinwright/breaklines/line_overlaps.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "tinwright/breaklines/meeting_conflicts.hpp"
#include "tinwright/geometry/curve.hpp"

namespace tinwright {
namespace {

using Kind = LineConflict::Kind;

/// Pieces along one edge, [first, last).
struct EdgePieces {
    std::size_t first;
    std::size_t last;
};

class OverlapFinder {
  public:
    OverlapFinder(const KeyedLines& keyed, std::span<const Breakline> lines, const NodedLines& noded)
        : keyed_(keyed), lines_(lines), noded_(noded), repeats_(lines.size()) {}

    std::vector<FoundConflict> run() {
        find_shared_edges();
        if (shared_.empty()) {
            return {};
        }
        find_partial();
        find_polygons();
        add_duplicates();
        add_overlaps();
        return std::move(found_);
    }

  private:
    using LinePair = std::pair<std::uint32_t, std::uint32_t>;  // the smaller first
    using PlainPiece = std::array<std::uint32_t, 3>;           // vertices, the smaller first, and line
    using Polygon = std::pair<LineRole, std::uint32_t>;        // role and number
    using Edge = std::pair<std::uint32_t, std::uint32_t>;      // vertices, the smaller first
    using Place = std::tuple<double, double, LinePair>;        // location and lines

    void find_shared_edges();
    void find_partial();
    void find_polygons();
    void add_duplicates();
    void add_overlaps();
    [[nodiscard]] std::optional<LinePair> first_harm(const EdgePieces& edge) const;
    [[nodiscard]] bool may_share(std::uint32_t line_a, std::uint32_t line_b) const;
    [[nodiscard]] bool are_harmless(std::uint32_t line_a, std::uint32_t line_b) const;
    [[nodiscard]] std::vector<PlainPiece> whole_segments() const;
    [[nodiscard]] Polygon polygon_of(std::uint32_t line) const {
        return {lines_[line].role, keyed_.traits[line].polygon};
    }

    const KeyedLines& keyed_;
    std::span<const Breakline> lines_;
    const NodedLines& noded_;
    std::vector<EdgePieces> shared_;  // edges with several lines, or one several times
    std::set<LinePair> partial_;      // lines with a stretch in common that is no segment of both
    std::map<Polygon, std::vector<Edge>> polygons_;  // their edges, ascending
    std::vector<bool> repeats_;                      // of each line: whether it is listed as a duplicate
    std::vector<FoundConflict> found_;
};

void OverlapFinder::find_shared_edges() {
    const std::vector<NodedPiece>& pieces = noded_.pieces;
    for (std::size_t first = 0, last = 0; first < pieces.size(); first = last) {
        last = first + 1;
        while (last < pieces.size() && pieces[last].a == pieces[first].a &&
               pieces[last].b == pieces[first].b) {
            ++last;
        }
        if (last - first > 1 || pieces[first].runs > 1) {
            shared_.push_back({first, last});
        }
    }
}

/// The segments of clean lines as pieces between vertices, ascending.
std::vector<OverlapFinder::PlainPiece> OverlapFinder::whole_segments() const {
    const auto vertex_of = [&](Key2 key) {
        const auto at = std::lower_bound(noded_.keys.begin(), noded_.keys.end(), key, precedes_on_curve);
        return static_cast<std::uint32_t>(at - noded_.keys.begin());
    };
    std::vector<PlainPiece> segments;
    for (std::uint32_t line = 0; line < keyed_.lines.size(); ++line) {
        const std::vector<Key2>& keys = keyed_.lines[line].keys;
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            const auto [a, b] = std::minmax({vertex_of(keys[i]), vertex_of(keys[i + 1])});
            segments.push_back({a, b, line});
        }
    }
    std::sort(segments.begin(), segments.end());
    return segments;
}

void OverlapFinder::find_partial() {
    const std::vector<PlainPiece> segments = whole_segments();
    for (const EdgePieces& edge : shared_) {
        for (std::size_t i = edge.first; i < edge.last; ++i) {
            const NodedPiece& piece = noded_.pieces[i];
            if (std::binary_search(segments.begin(), segments.end(),
                                   PlainPiece{piece.a, piece.b, piece.line})) {
                continue;
            }
            for (std::size_t j = edge.first; j < edge.last; ++j) {
                const std::uint32_t other = noded_.pieces[j].line;
                if (other != piece.line && may_share(piece.line, other)) {
                    partial_.insert(std::minmax(piece.line, other));
                }
            }
        }
    }
}

void OverlapFinder::find_polygons() {
    for (const NodedPiece& piece : noded_.pieces) {
        if (keyed_.traits[piece.line].is_ring) {
            polygons_[polygon_of(piece.line)].emplace_back(piece.a, piece.b);
        }
    }
}

bool OverlapFinder::may_share(std::uint32_t line_a, std::uint32_t line_b) const {
    return lines_[line_a].role != lines_[line_b].role ||
           (keyed_.traits[line_a].is_ring && keyed_.traits[line_b].is_ring &&
            polygon_of(line_a) != polygon_of(line_b));
}

bool OverlapFinder::are_harmless(std::uint32_t line_a, std::uint32_t line_b) const {
    if (!may_share(line_a, line_b) || partial_.contains(std::minmax(line_a, line_b))) {
        return false;
    }
    const bool are_same_polygon = lines_[line_a].role == lines_[line_b].role &&
                                  polygons_.at(polygon_of(line_a)) == polygons_.at(polygon_of(line_b));
    return !are_same_polygon;
}

void OverlapFinder::add_duplicates() {
    for (const LineConflict& conflict : noded_.conflicts) {
        if (conflict.kind == Kind::Duplicate && !are_harmless(conflict.line_a, conflict.line_b)) {
            repeats_[conflict.line_b] = true;
            found_.push_back({conflict, keyed_.lattice.key(conflict.location)});
        }
    }
}

/// The first two lines, or the first one twice, that should not both be on an edge.
std::optional<OverlapFinder::LinePair> OverlapFinder::first_harm(const EdgePieces& edge) const {
    for (std::size_t i = edge.first; i < edge.last; ++i) {
        const NodedPiece& piece = noded_.pieces[i];
        if (repeats_[piece.line]) {
            continue;
        }
        if (piece.runs > 1) {
            return LinePair(piece.line, piece.line);
        }
        for (std::size_t j = i + 1; j < edge.last; ++j) {
            const std::uint32_t other = noded_.pieces[j].line;
            if (!repeats_[other] && !are_harmless(piece.line, other)) {
                return LinePair(piece.line, other);
            }
        }
    }
    return {};
}

void OverlapFinder::add_overlaps() {
    std::vector<NodedPiece> harmful;
    for (const EdgePieces& edge : shared_) {
        if (const auto pair = first_harm(edge)) {
            const NodedPiece& piece = noded_.pieces[edge.first];
            if (pair->first == pair->second) {
                harmful.push_back({piece.a, piece.b, pair->first, 2});
            } else {
                harmful.push_back({piece.a, piece.b, pair->first, 1});
                harmful.push_back({piece.a, piece.b, pair->second, 1});
            }
        }
    }
    std::map<Place, std::pair<double, double>> elevations;
    for (const LineConflict& conflict : noded_.conflicts) {
        if (conflict.kind == Kind::Overlap) {
            elevations[{conflict.location.x, conflict.location.y, {conflict.line_a, conflict.line_b}}] = {
                conflict.z_a, conflict.z_b};
        }
    }
    for (const SharedStretch& stretch : find_shared_stretches(harmful)) {
        FoundConflict found{{}, noded_.keys[stretch.vertex]};
        found.conflict.kind = Kind::Overlap;
        found.conflict.line_a = stretch.line_a;
        found.conflict.line_b = stretch.line_b;
        const Point2 at = keyed_.lattice.position(found.key);
        const auto z = elevations.find({at.x, at.y, {stretch.line_a, stretch.line_b}});
        if (z != elevations.end()) {
            std::tie(found.conflict.z_a, found.conflict.z_b) = z->second;
        }
        found_.push_back(found);
    }
}

}  // namespace

std::vector<FoundConflict> find_overlaps(const KeyedLines& keyed, std::span<const Breakline> lines,
                                         const NodedLines& noded) {
    return OverlapFinder(keyed, lines, noded).run();
}

}  // namespace tinwright
