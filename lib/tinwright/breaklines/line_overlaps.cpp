#include "tinwright/breaklines/line_overlaps.hpp"

#include <algorithm>
#include <cstddef>

#include "tinwright/geometry/curve.hpp"

namespace tinwright {
namespace {

using PlainPiece = SharedStretches::PlainPiece;

/// The segments of clean lines as pieces between vertices, ascending.
std::vector<PlainPiece> list_whole_segments(const KeyedLines& keyed, const NodedLines& noded) {
    const auto vertex_of = [&](Key2 key) {
        const auto at = std::lower_bound(noded.keys.begin(), noded.keys.end(), key, precedes_on_curve);
        return static_cast<std::uint32_t>(at - noded.keys.begin());
    };
    std::vector<PlainPiece> segments;
    for (std::uint32_t line = 0; line < keyed.lines.size(); ++line) {
        const std::vector<Key2>& keys = keyed.lines[line].keys;
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            const auto [a, b] = std::minmax({vertex_of(keys[i]), vertex_of(keys[i + 1])});
            segments.push_back({a, b, line});
        }
    }
    std::sort(segments.begin(), segments.end());
    return segments;
}

}  // namespace

SharedStretches::SharedStretches(const KeyedLines& keyed, std::span<const Breakline> lines,
                                 const NodedLines& noded)
    : keyed_(keyed), lines_(lines) {
    const bool has_overlaps =
        std::any_of(noded.conflicts.begin(), noded.conflicts.end(), [](const LineConflict& conflict) {
            return conflict.kind == LineConflict::Kind::Overlap ||
                   conflict.kind == LineConflict::Kind::Duplicate;
        });
    if (has_overlaps) {
        find_partial(noded);
        find_polygons(noded);
    }
}

void SharedStretches::find_partial(const NodedLines& noded) {
    const std::vector<PlainPiece> segments = list_whole_segments(keyed_, noded);
    const std::span<const NodedPiece> pieces = noded.pieces;
    for (std::size_t begin = 0, end = 0; begin < pieces.size(); begin = end) {
        end = begin + 1;
        while (end < pieces.size() && pieces[end].a == pieces[begin].a && pieces[end].b == pieces[begin].b) {
            ++end;
        }
        if (end - begin > 1) {
            add_partial(pieces.subspan(begin, end - begin), segments);
        }
    }
}

void SharedStretches::add_partial(std::span<const NodedPiece> group,
                                  const std::vector<PlainPiece>& segments) {
    for (const NodedPiece& piece : group) {
        if (std::binary_search(segments.begin(), segments.end(), PlainPiece{piece.a, piece.b, piece.line})) {
            continue;
        }
        for (const NodedPiece& other : group) {
            if (other.line != piece.line && may_share(piece.line, other.line)) {
                partial_.insert(std::minmax(piece.line, other.line));
            }
        }
    }
}

void SharedStretches::find_polygons(const NodedLines& noded) {
    for (const NodedPiece& piece : noded.pieces) {
        if (keyed_.traits[piece.line].is_ring) {
            polygons_[polygon_of(piece.line)].emplace_back(piece.a, piece.b);
        }
    }
}

bool SharedStretches::may_share(std::uint32_t line_a, std::uint32_t line_b) const {
    return lines_[line_a].role != lines_[line_b].role ||
           (keyed_.traits[line_a].is_ring && keyed_.traits[line_b].is_ring &&
            polygon_of(line_a) != polygon_of(line_b));
}

bool SharedStretches::are_harmless(std::uint32_t line_a, std::uint32_t line_b) const {
    if (line_a == line_b || !may_share(line_a, line_b) || partial_.contains(std::minmax(line_a, line_b))) {
        return false;
    }
    const bool are_same_polygon = lines_[line_a].role == lines_[line_b].role &&
                                  polygons_.at(polygon_of(line_a)) == polygons_.at(polygon_of(line_b));
    return !are_same_polygon;
}

}  // namespace tinwright
