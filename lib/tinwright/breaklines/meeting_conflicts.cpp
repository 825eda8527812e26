#include "tinwright/breaklines/meeting_conflicts.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace tinwright {
namespace {

bool is_at(std::uint32_t neighbor, const LineVisit& visit) {
    return neighbor != kNoVertex && (neighbor == visit.before || neighbor == visit.after);
}

bool share_an_edge(const LineVisit& p, const LineVisit& q) { return is_at(p.before, q) || is_at(p.after, q); }

using Visits = std::vector<const LineVisit*>;

/// The visits, of those of one kind with the same neighbours the first two lines' only: no others are needed
/// to find a pair, and thousands of lines along one edge stay two.
Visits without_crowds(Visits visits) {
    const auto edges = [](const LineVisit* visit) {
        return std::tuple(visit->is_own, std::min(visit->before, visit->after),
                          std::max(visit->before, visit->after));
    };
    constexpr std::size_t kFew = 8;
    if (visits.size() <= kFew) {
        return visits;
    }
    std::stable_sort(visits.begin(), visits.end(),
                     [&](const LineVisit* p, const LineVisit* q) { return edges(p) < edges(q); });
    Visits kept;
    std::size_t lines_alike = 0;
    for (const LineVisit* visit : visits) {
        const bool is_alike = !kept.empty() && edges(kept.back()) == edges(visit);
        lines_alike = is_alike ? lines_alike : 0;
        if (lines_alike == 0 || (lines_alike == 1 && kept.back()->line != visit->line)) {
            kept.push_back(visit);
            ++lines_alike;
        }
    }
    std::sort(kept.begin(), kept.end());  // as they lie in memory, that is in the order of lines
    return kept;
}

/// The first pair of different lines that share no edge here.
void append_pair_of_lines(LineConflict::Kind kind, const Visits& from, const Visits& to,
                          std::vector<VisitPair>& meetings) {
    for (const LineVisit* p : from) {
        for (const LineVisit* q : to) {
            if (p->line != q->line && !share_an_edge(*p, *q)) {
                meetings.push_back({kind, std::min(p, q), std::max(p, q)});
                return;
            }
        }
    }
}

/// The first two visits of one line, not both its own points, that share no edge.
void append_pair_of_one_line(const Visits& visits, std::vector<VisitPair>& meetings) {
    for (std::size_t i = 0; i < visits.size(); ++i) {
        for (std::size_t j = i + 1; j < visits.size() && visits[j]->line == visits[i]->line; ++j) {
            if (!(visits[i]->is_own && visits[j]->is_own) && !share_an_edge(*visits[i], *visits[j])) {
                meetings.push_back({LineConflict::Kind::SelfCrossing, visits[i], visits[j]});
                return;
            }
        }
    }
}

}  // namespace

std::vector<VisitPair> find_meetings(std::span<const LineVisit> visits,
                                     std::span<const std::uint32_t> first_alike) {
    Visits own;
    Visits passing;
    Visits all;
    for (const LineVisit& visit : visits) {
        const bool has_edge = visit.before != kNoVertex || visit.after != kNoVertex;
        if (has_edge && first_alike[visit.line] == visit.line) {
            (visit.is_own ? own : passing).push_back(&visit);
            all.push_back(&visit);
        }
    }
    std::vector<VisitPair> meetings;
    if (!passing.empty() && all.size() > 1) {
        append_pair_of_one_line(all, meetings);
        const Visits few_passing = without_crowds(std::move(passing));
        append_pair_of_lines(LineConflict::Kind::Crossing, few_passing, few_passing, meetings);
        append_pair_of_lines(LineConflict::Kind::Touch, few_passing, without_crowds(std::move(own)),
                             meetings);
    }
    return meetings;
}

namespace {

/// The start of the rotation that comes first in lexicographic order, by comparing two candidates at a time.
std::size_t least_rotation(std::span<const std::uint32_t> ring) {
    const std::size_t n = ring.size();
    std::size_t i = 0;
    std::size_t j = 1;
    for (std::size_t equal = 0; i < n && j < n && equal < n;) {
        const std::uint32_t p = ring[(i + equal) % n];
        const std::uint32_t q = ring[(j + equal) % n];
        if (p == q) {
            ++equal;
            continue;
        }
        (p > q ? i : j) += equal + 1;
        j += i == j ? 1 : 0;
        equal = 0;
    }
    return std::min(i, j);
}

/// The sites of a line in the one order that does not depend on its direction, nor on where it begins if it
/// is closed.
std::vector<std::uint32_t> canonical_sites(std::span<const std::uint32_t> sites) {
    std::vector<std::uint32_t> way(sites.begin(), sites.end());
    way.erase(std::unique(way.begin(), way.end()), way.end());
    const bool is_closed = way.size() > 2 && way.front() == way.back();
    if (is_closed) {
        way.pop_back();
    }
    std::vector<std::uint32_t> back(way.rbegin(), way.rend());
    if (is_closed) {
        for (std::vector<std::uint32_t>* ring : {&way, &back}) {
            std::rotate(ring->begin(), ring->begin() + static_cast<std::ptrdiff_t>(least_rotation(*ring)),
                        ring->end());
        }
        way.push_back(way.front());
        back.push_back(back.front());
    }
    return std::min(way, back);
}

/// Bits of a segment's number stirred, so that sums of them tell sets of segments apart.
std::uint64_t stirred(std::uint64_t value) {
    value = (value + 1) * 0x9E3779B97F4A7C15U;
    value = (value ^ (value >> 32U)) * 0xD6E8FEB86659FD93U;
    return value ^ (value >> 32U);
}

struct SummedLine {
    std::uint64_t sum;
    std::uint32_t line;
    friend auto operator<=>(const SummedLine&, const SummedLine&) = default;
};

/// Lines that have a length, ascending by the sum of their segments: lines that repeat another have the same.
std::vector<SummedLine> summed_lines(const LinePoints& points, const LineNetwork& network) {
    std::vector<SummedLine> sums;
    for (std::uint32_t line = 0; line < points.line_count(); ++line) {
        SummedLine summed{0, line};
        bool has_length = false;
        for (std::uint32_t i = points.start[line]; i < points.start[line + 1]; ++i) {
            if (network.segment_at[i] != kNoSegment) {
                summed.sum += stirred(network.segment_at[i]);
                has_length = true;
            }
        }
        if (has_length) {
            sums.push_back(summed);
        }
    }
    std::sort(sums.begin(), sums.end());
    return sums;
}

/// Of lines with the same sum; nearly always they are the same.
void find_repeated(std::span<const SummedLine> lines, const LinePoints& points, const LineNetwork& network,
                   std::vector<std::uint32_t>& first) {
    std::vector<std::pair<std::vector<std::uint32_t>, std::uint32_t>> ways;
    for (const SummedLine& summed : lines) {
        const std::uint32_t begin = points.start[summed.line];
        const std::uint32_t count = points.start[summed.line + 1] - begin;
        ways.emplace_back(canonical_sites(std::span(network.site).subspan(begin, count)), summed.line);
    }
    std::sort(ways.begin(), ways.end());
    for (std::size_t i = 1; i < ways.size(); ++i) {
        if (ways[i].first == ways[i - 1].first) {
            first[ways[i].second] = first[ways[i - 1].second];
        }
    }
}

}  // namespace

std::vector<std::uint32_t> find_repeated_lines(const LinePoints& points, const LineNetwork& network) {
    std::vector<std::uint32_t> first(points.line_count());
    std::iota(first.begin(), first.end(), 0U);
    const std::vector<SummedLine> sums = summed_lines(points, network);
    for (std::size_t begin = 0; begin < sums.size();) {
        std::size_t end = begin + 1;
        while (end < sums.size() && sums[end].sum == sums[begin].sum) {
            ++end;
        }
        if (end - begin > 1) {
            find_repeated(std::span(sums).subspan(begin, end - begin), points, network, first);
        }
        begin = end;
    }
    return first;
}

namespace {

/// Pieces [first, last) along one edge.
struct SharedEdge {
    std::size_t first;
    std::size_t last;
};

class StretchSearch {
  public:
    explicit StretchSearch(std::span<const NodedPiece> pieces) : pieces_(pieces) {}

    std::vector<SharedStretch> find() {
        std::vector<SharedEdge> edges = shared_edges();
        std::stable_sort(edges.begin(), edges.end(), [&](const SharedEdge& p, const SharedEdge& q) {
            return std::lexicographical_compare(
                pieces_.begin() + index(p.first), pieces_.begin() + index(p.last),
                pieces_.begin() + index(q.first), pieces_.begin() + index(q.last), is_earlier_line);
        });
        std::vector<SharedStretch> stretches;
        for (std::size_t begin = 0; begin < edges.size();) {
            std::size_t end = begin + 1;
            while (end < edges.size() && have_same_lines(edges[begin], edges[end])) {
                ++end;
            }
            append_stretches(std::span(edges).subspan(begin, end - begin), stretches);
            begin = end;
        }
        return stretches;
    }

  private:
    static std::ptrdiff_t index(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }
    static bool is_earlier_line(const NodedPiece& p, const NodedPiece& q) { return p.line < q.line; }

    [[nodiscard]] std::vector<SharedEdge> shared_edges() const {
        std::vector<SharedEdge> edges;
        for (std::size_t first = 0; first < pieces_.size();) {
            std::size_t last = first + 1;
            while (last < pieces_.size() && pieces_[last].a == pieces_[first].a &&
                   pieces_[last].b == pieces_[first].b) {
                ++last;
            }
            if (last - first > 1 || pieces_[first].runs > 1) {
                edges.push_back({first, last});
            }
            first = last;
        }
        return edges;
    }

    [[nodiscard]] bool have_same_lines(const SharedEdge& p, const SharedEdge& q) const {
        return std::equal(pieces_.begin() + index(p.first), pieces_.begin() + index(p.last),
                          pieces_.begin() + index(q.first), pieces_.begin() + index(q.last),
                          [](const NodedPiece& a, const NodedPiece& b) { return a.line == b.line; });
    }

    /// Edges with the same lines, joined where they share a vertex. Each stretch is named by its first
    /// vertex.
    void append_stretches(std::span<const SharedEdge> edges, std::vector<SharedStretch>& stretches) {
        std::vector<std::uint32_t> vertices;
        for (const SharedEdge& edge : edges) {
            vertices.push_back(pieces_[edge.first].a);
            vertices.push_back(pieces_[edge.first].b);
        }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        std::vector<std::size_t> parent(vertices.size());
        std::iota(parent.begin(), parent.end(), std::size_t{0});
        const auto root_of = [&](std::uint32_t vertex) {
            auto place = static_cast<std::size_t>(std::lower_bound(vertices.begin(), vertices.end(), vertex) -
                                                  vertices.begin());
            while (parent[place] != place) {
                parent[place] = parent[parent[place]];
                place = parent[place];
            }
            return place;
        };
        for (const SharedEdge& edge : edges) {
            const std::size_t p = root_of(pieces_[edge.first].a);
            const std::size_t q = root_of(pieces_[edge.first].b);
            parent[std::max(p, q)] = std::min(p, q);
        }
        const NodedPiece& first = pieces_[edges.front().first];
        const bool has_other = edges.front().last - edges.front().first > 1;
        const std::uint32_t other = has_other ? pieces_[edges.front().first + 1].line : first.line;
        for (std::size_t place = 0; place < vertices.size(); ++place) {
            if (parent[place] == place) {
                stretches.push_back({vertices[place], first.line, other});
            }
        }
    }

    std::span<const NodedPiece> pieces_;
};

}  // namespace

std::vector<SharedStretch> find_shared_stretches(std::span<const NodedPiece> pieces) {
    return StretchSearch(pieces).find();
}

}  // namespace tinwright
