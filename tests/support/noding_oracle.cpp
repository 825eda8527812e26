#include "support/noding_oracle.hpp"

#include <algorithm>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

namespace tinwright_tests::oracle {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;
using tinwright::Key2;

namespace {

struct BigKey {
    cpp_int x;
    cpp_int y;
};

cpp_int big(double value) { return {static_cast<std::int64_t>(value)}; }
BigKey big(Key2 key) { return {big(key.x), big(key.y)}; }

int side(Key2 a, Key2 b, Key2 c) {
    const BigKey p = big(a);
    const BigKey q = big(b);
    const BigKey r = big(c);
    const cpp_int area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool is_in_range(double value, double p, double q) {
    return std::min(p, q) <= value && value <= std::max(p, q);
}

bool boxes_meet(const KeySegment& p, const KeySegment& q) {
    return std::max(p[0].x, p[1].x) >= std::min(q[0].x, q[1].x) &&
           std::max(q[0].x, q[1].x) >= std::min(p[0].x, p[1].x) &&
           std::max(p[0].y, p[1].y) >= std::min(q[0].y, q[1].y) &&
           std::max(q[0].y, q[1].y) >= std::min(p[0].y, p[1].y);
}

bool is_end(Key2 key, const KeySegment& segment) { return key == segment[0] || key == segment[1]; }

bool cross_properly(const KeySegment& p, const KeySegment& q) {
    return boxes_meet(p, q) && side(p[0], p[1], q[0]) * side(p[0], p[1], q[1]) < 0 &&
           side(q[0], q[1], p[0]) * side(q[0], q[1], p[1]) < 0;
}

/// Part of a segment, as parameters from 0 to 1.
struct Part {
    cpp_rational from = 0;
    cpp_rational to = 1;
    bool has_from = true;
    bool has_to = true;

    /// Keeps what has low <= start + t * way, and less than `high` or, if `is_closed`, at most that.
    void clip(const cpp_int& start, const cpp_int& way, const cpp_rational& low, const cpp_rational& high,
              bool is_closed) {
        if (way == 0) {
            const cpp_rational at = start;
            if (at < low || at > high || (at == high && !is_closed)) {
                has_from = has_to = false;
                to = from;
            }
            return;
        }
        const cpp_rational t_low = (low - start) / way;
        const cpp_rational t_high = (high - start) / way;
        if (way > 0) {
            raise(t_low, true);
            lower(t_high, is_closed);
        } else {
            raise(t_high, is_closed);
            lower(t_low, true);
        }
    }
    [[nodiscard]] bool is_empty() const { return from > to || (from == to && !(has_from && has_to)); }

  private:
    void raise(const cpp_rational& t, bool is_in) {
        if (t > from || (t == from && !is_in)) {
            from = t;
            has_from = is_in;
        }
    }
    void lower(const cpp_rational& t, bool is_in) {
        if (t < to || (t == to && !is_in)) {
            to = t;
            has_to = is_in;
        }
    }
};

bool meets_square(const KeySegment& segment, Key2 center, bool is_closed) {
    const BigKey a = big(segment[0]);
    const BigKey b = big(segment[1]);
    const BigKey c = big(center);
    const cpp_rational half(1, 2);
    Part part;
    part.clip(a.x, b.x - a.x, c.x - half, c.x + half, is_closed);
    part.clip(a.y, b.y - a.y, c.y - half, c.y + half, is_closed);
    return !part.is_empty();
}

/// The integer from value - 1/2 (excluded) to value + 1/2.
cpp_int nearest(const cpp_rational& value) {
    const cpp_int up = 2 * numerator(value) + denominator(value);
    const cpp_int down = 2 * denominator(value);
    const cpp_int quotient = up / down;  // towards zero
    return quotient * down > up ? cpp_int(quotient - 1) : quotient;
}

/// How far along a segment a point is, in squared steps.
cpp_int along(const KeySegment& segment, Key2 point) {
    const BigKey a = big(segment[0]);
    const BigKey b = big(segment[1]);
    const BigKey p = big(point);
    return (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y);
}

/// The vertices that a segment goes through, in their order along it.
std::vector<Key2> chain_of(const KeySegment& segment, bool is_led, std::span<const Key2> vertices) {
    std::vector<Key2> chain;
    for (const Key2 vertex : vertices) {
        if (is_in_range(vertex.x, segment[0].x, segment[1].x) &&
            is_in_range(vertex.y, segment[0].y, segment[1].y) &&
            (is_led ? passes_square(segment, vertex) : is_on(vertex, segment))) {
            chain.push_back(vertex);
        }
    }
    std::sort(chain.begin(), chain.end(),
              [&](Key2 p, Key2 q) { return along(segment, p) < along(segment, q); });
    return chain;
}

bool do_chains_cross(const std::vector<Key2>& p, const std::vector<Key2>& q) {
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        for (std::size_t j = 0; j + 1 < q.size(); ++j) {
            if (cross_properly({p[i], p[i + 1]}, {q[j], q[j + 1]})) {
                return true;
            }
        }
    }
    return false;
}

/// Edges that go exactly through vertices become several.
std::vector<Key2> split_at(const std::vector<Key2>& chain, std::span<const Key2> vertices) {
    std::vector<Key2> split{chain.front()};
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const std::vector<Key2> edge = chain_of({chain[i], chain[i + 1]}, false, vertices);
        split.insert(split.end(), edge.begin() + 1, edge.end());
    }
    return split;
}

}  // namespace

bool key_less(Key2 p, Key2 q) { return p.x < q.x || (p.x == q.x && p.y < q.y); }

bool segment_less(const KeySegment& p, const KeySegment& q) {
    return p[0] == q[0] ? key_less(p[1], q[1]) : key_less(p[0], q[0]);
}

bool is_on(Key2 point, const KeySegment& segment) {
    return is_in_range(point.x, segment[0].x, segment[1].x) &&
           is_in_range(point.y, segment[0].y, segment[1].y) && side(segment[0], segment[1], point) == 0;
}

bool meet_improperly(const KeySegment& p, const KeySegment& q) {
    if (!boxes_meet(p, q)) {
        return false;
    }
    const auto has_foreign_end = [](const KeySegment& from, const KeySegment& on) {
        return std::any_of(from.begin(), from.end(),
                           [&](Key2 end) { return !is_end(end, on) && is_on(end, on); });
    };
    const bool are_equal = is_end(p[0], q) && is_end(p[1], q);
    return are_equal || has_foreign_end(p, q) || has_foreign_end(q, p) || cross_properly(p, q);
}

std::optional<std::pair<std::size_t, std::size_t>> find_improper(std::span<const KeySegment> segments) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
        for (std::size_t j = i + 1; j < segments.size(); ++j) {
            if (meet_improperly(segments[i], segments[j])) {
                return std::pair{i, j};
            }
        }
    }
    return std::nullopt;
}

bool is_within_half_step(Key2 point, const KeySegment& segment) { return meets_square(segment, point, true); }

bool passes_square(const KeySegment& segment, Key2 center) { return meets_square(segment, center, false); }

std::optional<Crossing> crossing(const KeySegment& p, const KeySegment& q) {
    if (!cross_properly(p, q)) {
        return std::nullopt;
    }
    const BigKey a = big(p[0]);
    const BigKey b = big(p[1]);
    const BigKey c = big(q[0]);
    const BigKey d = big(q[1]);
    const cpp_int num = (c.x - a.x) * (d.y - c.y) - (c.y - a.y) * (d.x - c.x);
    const cpp_int den = (b.x - a.x) * (d.y - c.y) - (b.y - a.y) * (d.x - c.x);
    const cpp_rational t = cpp_rational(num) / cpp_rational(den);
    const cpp_rational x = a.x + t * (b.x - a.x);
    const cpp_rational y = a.y + t * (b.y - a.y);
    const cpp_int key_x = nearest(x);
    const cpp_int key_y = nearest(y);
    return Crossing{{key_x.convert_to<double>(), key_y.convert_to<double>()}, x == key_x && y == key_y};
}

namespace {

/// Vertices, and segments with a crossing that is rounded.
Noded find_vertices(std::span<const KeySegment> segments, std::span<const Key2> points) {
    Noded noded;
    noded.vertices.assign(points.begin(), points.end());
    noded.is_led.assign(segments.size(), false);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        noded.vertices.insert(noded.vertices.end(), segments[i].begin(), segments[i].end());
        for (std::size_t j = i + 1; j < segments.size(); ++j) {
            const std::optional<Crossing> met = crossing(segments[i], segments[j]);
            if (met) {
                noded.vertices.push_back(met->key);
            }
            if (met && !met->is_exact) {
                noded.is_led[i] = noded.is_led[j] = true;
            }
        }
    }
    std::sort(noded.vertices.begin(), noded.vertices.end(), key_less);
    noded.vertices.erase(std::unique(noded.vertices.begin(), noded.vertices.end()), noded.vertices.end());
    return noded;
}

/// Leads the segments whose chains cross that of another; whether there was one not yet led.
bool lead_crossed(std::span<const KeySegment> segments, Noded& noded) {
    bool has_led = false;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        for (std::size_t j = i + 1; j < segments.size(); ++j) {
            if ((noded.is_led[i] && noded.is_led[j]) || !do_chains_cross(noded.chains[i], noded.chains[j])) {
                continue;
            }
            has_led = true;
            for (const std::size_t s : {i, j}) {
                noded.is_led[s] = true;
                noded.chains[s] = chain_of(segments[s], true, noded.vertices);
            }
        }
    }
    return has_led;
}

}  // namespace

Noded node(std::span<const KeySegment> segments, std::span<const Key2> points) {
    Noded noded = find_vertices(segments, points);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        noded.chains.push_back(chain_of(segments[i], noded.is_led[i], noded.vertices));
    }
    while (lead_crossed(segments, noded)) {
    }
    for (std::vector<Key2>& chain : noded.chains) {
        chain = split_at(chain, noded.vertices);
    }
    return noded;
}

}  // namespace tinwright_tests::oracle
