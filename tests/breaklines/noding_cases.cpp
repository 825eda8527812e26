#include "breaklines/noding_cases.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

#include <tbb/task_arena.h>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/decimal.hpp"

#include "support/noding_oracle.hpp"

namespace tinwright_tests {

using namespace tinwright;
using oracle::KeySegment;

namespace {

std::vector<Key2> keys_along(const Breakline& line, const Lattice& lattice) {
    std::vector<Key2> keys;
    for (const Point3& point : line.points) {
        keys.push_back(lattice.key({point.x, point.y}));
    }
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

KeySegment segment_between(Key2 p, Key2 q) {
    return oracle::key_less(p, q) ? KeySegment{p, q} : KeySegment{q, p};
}

std::vector<KeySegment> segments_along(const KeyChain& keys) {
    std::vector<KeySegment> segments;
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
        segments.push_back(segment_between(keys[i], keys[i + 1]));
    }
    return segments;
}

using Edge = std::array<std::uint32_t, 2>;

std::vector<Edge> edges_of(const NodedLines& noded) {
    std::vector<Edge> edges;
    for (const NodedPiece& piece : noded.pieces) {
        edges.push_back({piece.a, piece.b});
    }
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// Whether a chain is, piece by piece, a way along the segments of a line.
bool follows(const KeyChain& chain, const KeyChain& line) {
    std::size_t at = 0;
    if (chain.empty() || line.empty() || chain.front() != line.front()) {
        return chain.empty() && line.empty();
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const KeySegment segment{line[i], line[i + 1]};
        while (chain[at] != line[i + 1]) {
            ++at;
            if (at == chain.size() || !oracle::is_within_half_step(chain[at], segment)) {
                return false;
            }
        }
    }
    return at + 1 == chain.size();
}

std::string text_of(const LineConflict& conflict) {
    return std::to_string(static_cast<int>(conflict.kind)) + " " +
           std::to_string(static_cast<int>(conflict.action)) + " " + location_text(conflict.location);
}

}  // namespace

NodingCase make_case(std::vector<Breakline> lines) {
    std::vector<Point3> points;
    for (const Breakline& line : lines) {
        points.insert(points.end(), line.points.begin(), line.points.end());
    }
    return {std::move(lines), find_lattice({}, points).lattice};
}

NodingCase make_case(const LineFamily& family, Random& random, std::size_t size) {
    NodingCase input = make_case(family.make(random, size).lines);
    double largest = 0;
    for (const Breakline& line : input.lines) {
        for (const Key2 key : keys_along(line, input.lattice)) {
            largest = std::max({largest, key.x, key.y});
        }
    }
    const int room = input.lattice.refinement_room(largest);
    const int bits = random.integer(0, 1) == 0 ? static_cast<int>(random.integer(0, room)) : 0;
    input.lattice = input.lattice.refined(bits);
    return input;
}

NodingOptions tolerant() {
    NodingOptions options;
    options.crossing_tolerance = 1;
    return options;
}

NodedLines node(const NodingCase& input, int threads, NodingOptions options) {
    options.keep_chains = true;
    if (threads == 0) {
        return node_lines(input.lines, input.lattice, options);
    }
    NodedLines noded;
    tbb::task_arena(threads).execute([&] { noded = node_lines(input.lines, input.lattice, options); });
    return noded;
}

ExpectedChains expected_chains(const NodingCase& input) {
    std::vector<KeySegment> segments;
    std::vector<Key2> points;
    std::vector<KeyChain> ways;
    for (const Breakline& line : input.lines) {
        ways.push_back(keys_along(line, input.lattice));
        points.insert(points.end(), ways.back().begin(), ways.back().end());
        const std::vector<KeySegment> own = segments_along(ways.back());
        segments.insert(segments.end(), own.begin(), own.end());
    }
    std::sort(segments.begin(), segments.end(), oracle::segment_less);
    segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
    const oracle::Noded noded = oracle::node(segments, points);
    ExpectedChains expected{noded.vertices, {}};
    for (const KeyChain& way : ways) {
        KeyChain chain;
        if (!way.empty()) {
            chain.push_back(way.front());
        }
        for (std::size_t i = 0; i + 1 < way.size(); ++i) {
            const auto found = std::lower_bound(segments.begin(), segments.end(),
                                                segment_between(way[i], way[i + 1]), oracle::segment_less);
            KeyChain part = noded.chains[static_cast<std::size_t>(found - segments.begin())];
            if (part.front() != way[i]) {
                std::reverse(part.begin(), part.end());
            }
            chain.insert(chain.end(), part.begin() + 1, part.end());
        }
        expected.chains.push_back(chain);
    }
    return expected;
}

std::vector<Key2> sorted_keys(const NodedLines& noded) {
    std::vector<Key2> keys = noded.keys;
    std::sort(keys.begin(), keys.end(), oracle::key_less);
    return keys;
}

std::vector<KeyChain> chains_of(const NodedLines& noded) {
    std::vector<KeyChain> chains;
    for (std::size_t line = 0; line + 1 < noded.chain_start.size(); ++line) {
        KeyChain chain;
        for (std::uint32_t i = noded.chain_start[line]; i < noded.chain_start[line + 1]; ++i) {
            chain.push_back(noded.keys[noded.chains[i]]);
        }
        chains.push_back(std::move(chain));
    }
    return chains;
}

std::string find_fault(const NodingCase& input, const NodedLines& noded) {
    for (std::size_t i = 0; i + 1 < noded.keys.size(); ++i) {
        if (!precedes_on_curve(noded.keys[i], noded.keys[i + 1])) {
            return "keys are not distinct and in curve order";
        }
    }
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> runs;
    const std::vector<KeyChain> chains = chains_of(noded);
    for (std::uint32_t line = 0; line < input.lines.size(); ++line) {
        if (!follows(chains[line], keys_along(input.lines[line], input.lattice))) {
            return "the chain of line " + std::to_string(line) + " is none, or leaves it";
        }
        for (std::uint32_t i = noded.chain_start[line]; i + 1 < noded.chain_start[line + 1]; ++i) {
            const auto [a, b] = std::minmax(noded.chains[i], noded.chains[i + 1]);
            ++runs[{a, b, line}];
        }
    }
    const bool are_equal = std::equal(
        runs.begin(), runs.end(), noded.pieces.begin(), noded.pieces.end(),
        [](const auto& run, const NodedPiece& piece) {
            return run.first == std::array{piece.a, piece.b, piece.line} && run.second == piece.runs;
        });
    if (!are_equal) {
        return "pieces are not the parts of the chains";
    }
    return find_improper_edge(noded);
}

std::string find_improper_edge(const NodedLines& noded) {
    std::vector<KeySegment> segments;
    for (const Edge& edge : edges_of(noded)) {
        segments.push_back({noded.keys[edge[0]], noded.keys[edge[1]]});
    }
    if (const auto found = oracle::find_improper(segments)) {
        return "edges " + std::to_string(found->first) + " and " + std::to_string(found->second) +
               " do not meet at ends";
    }
    return {};
}

bool has_same_geometry(const NodedLines& a, const NodedLines& b) {
    return a.keys == b.keys && edges_of(a) == edges_of(b) &&
           std::equal(a.z.begin(), a.z.end(), b.z.begin(), b.z.end(), [](double p, double q) {
               return std::bit_cast<std::uint64_t>(p) == std::bit_cast<std::uint64_t>(q);
           });
}

std::vector<Breakline> lines_of_pieces(const NodedLines& noded, const Lattice& lattice) {
    std::vector<Edge> edges = edges_of(noded);
    std::vector<bool> has_edge(noded.keys.size());
    for (const Edge& edge : edges) {
        has_edge[edge[0]] = has_edge[edge[1]] = true;
    }
    for (std::uint32_t v = 0; v < noded.keys.size(); ++v) {
        if (!has_edge[v]) {
            edges.push_back({v, v});
        }
    }
    std::vector<Breakline> lines;
    for (const Edge& edge : edges) {
        Breakline line;
        for (const std::uint32_t v : edge) {
            const Point2 at = lattice.position(noded.keys[v]);
            line.points.push_back({at.x, at.y, noded.z[v]});
        }
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> conflict_places(const NodedLines& noded) {
    std::vector<std::string> texts;
    std::transform(noded.conflicts.begin(), noded.conflicts.end(), std::back_inserter(texts), text_of);
    return texts;
}

std::vector<std::string> conflict_texts(const NodedLines& noded) {
    std::vector<std::string> texts;
    for (const LineConflict& conflict : noded.conflicts) {
        texts.push_back(text_of(conflict) + " " + std::to_string(conflict.line_a) + " " +
                        std::to_string(conflict.line_b) + " " + std::to_string(conflict.z_a) + " " +
                        std::to_string(conflict.z_b));
    }
    return texts;
}

}  // namespace tinwright_tests
