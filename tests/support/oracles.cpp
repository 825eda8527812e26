#include "support/oracles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <boost/multiprecision/cpp_int.hpp>

namespace tinwright_tests::oracle {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;
using tinwright::Key2;

namespace {

struct BigPoint {
    cpp_int x;
    cpp_int y;
};

cpp_int big(double key) { return cpp_int(static_cast<std::int64_t>(key)); }
BigPoint big(Key2 key) { return {big(key.x), big(key.y)}; }

cpp_int cross(const BigPoint& a, const BigPoint& b, const BigPoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The determinant of rows (x, y, height, 1), expanded along the heights.
cpp_int lifted(const std::array<BigPoint, 4>& p, const std::array<cpp_int, 4>& height) {
    return height[0] * cross(p[1], p[2], p[3]) - height[1] * cross(p[0], p[2], p[3]) +
           height[2] * cross(p[0], p[1], p[3]) - height[3] * cross(p[0], p[1], p[2]);
}

cpp_int square(const BigPoint& p) { return p.x * p.x + p.y * p.y; }

bool is_before(Key2 a, Key2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

bool is_small(std::span<const Key2> keys) {
    return std::all_of(keys.begin(), keys.end(),
                       [](Key2 key) { return std::abs(key.x) <= 0x1p29 && std::abs(key.y) <= 0x1p29; });
}

/// `incircle` in 128 bits, for keys up to 2^29: the definition's inner loop would take too long otherwise.
int incircle_of_small(Key2 a, Key2 b, Key2 c, Key2 d) {
    __extension__ using Wide = __int128;
    const auto integer = [](double v) { return static_cast<std::int64_t>(v); };
    const Wide ax = integer(a.x - d.x);
    const Wide ay = integer(a.y - d.y);
    const Wide bx = integer(b.x - d.x);
    const Wide by = integer(b.y - d.y);
    const Wide cx = integer(c.x - d.x);
    const Wide cy = integer(c.y - d.y);
    const Wide det = ax * (by * (cx * cx + cy * cy) - cy * (bx * bx + by * by)) -
                     ay * (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) +
                     (ax * ax + ay * ay) * (bx * cy - by * cx);
    return det > 0 ? 1 : det < 0 ? -1 : 0;
}

/// What is compared instead of lengths: |x|^p + |y|^p, or the greater of |x| and |y|.
cpp_int power_of_length(tinwright::Norm norm, Key2 a, Key2 b) {
    const cpp_int x = abs(cpp_int(big(b.x) - big(a.x)));
    const cpp_int y = abs(cpp_int(big(b.y) - big(a.y)));
    if (norm.is_maximum()) {
        return std::max(x, y);
    }
    const auto p = static_cast<unsigned>(norm.power());
    return pow(x, p) + pow(y, p);
}

}  // namespace

int orient2d(Key2 a, Key2 b, Key2 c) { return cross(big(a), big(b), big(c)).sign(); }

int incircle(Key2 a, Key2 b, Key2 c, Key2 d) {
    const std::array<BigPoint, 4> p{big(a), big(b), big(c), big(d)};
    return lifted(p, {square(p[0]), square(p[1]), square(p[2]), square(p[3])}).sign();
}

int compare_distances(Key2 a, Key2 b, Key2 c, Key2 d) {
    const auto square_of = [](Key2 from, Key2 to) {
        return square({big(to.x) - big(from.x), big(to.y) - big(from.y)});
    };
    return cpp_int(square_of(a, b) - square_of(c, d)).sign();
}

int angle_sign(Key2 a, Key2 apex, Key2 b) {
    const BigPoint o = big(apex);
    const BigPoint p = big(a);
    const BigPoint q = big(b);
    return cpp_int((p.x - o.x) * (q.x - o.x) + (p.y - o.y) * (q.y - o.y)).sign();
}

int compare_lengths(tinwright::Norm norm, Key2 a, Key2 b, Key2 c, Key2 d) {
    return cpp_int(power_of_length(norm, a, b) - power_of_length(norm, c, d)).sign();
}

bool is_length(double length, double relative, tinwright::Norm norm, Key2 a, Key2 b) {
    const auto power = [norm](const cpp_rational& value) {
        cpp_rational product = 1;
        for (int i = 0; i < (norm.is_maximum() ? 1 : norm.power()); ++i) {
            product *= value;
        }
        return product;
    };
    const cpp_rational exact(power_of_length(norm, a, b));
    return power(cpp_rational(length) * (1 - cpp_rational(relative))) <= exact &&
           power(cpp_rational(length) * (1 + cpp_rational(relative))) >= exact;
}

int incircle_perturbed(Key2 a, Key2 b, Key2 c, Key2 d) {
    const std::array<Key2, 4> keys{a, b, c, d};
    std::array<BigPoint, 4> p;
    std::array<cpp_int, 4> height;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto rank = static_cast<unsigned>(
            std::count_if(keys.begin(), keys.end(), [&](Key2 other) { return is_before(other, keys[i]); }));
        p[i] = big(keys[i]);
        height[i] = (square(p[i]) << 4000U) + (cpp_int(1) << (400U * rank));
    }
    return lifted(p, height).sign();
}

std::string twice_area(std::span<const Key2> polygon) {
    cpp_int sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const BigPoint p = big(polygon[i]);
        const BigPoint q = big(polygon[(i + 1) % polygon.size()]);
        sum += p.x * q.y - p.y * q.x;
    }
    return sum.str();
}

std::string twice_area_of_faces(std::span<const std::array<Key2, 3>> faces) {
    cpp_int sum = 0;
    for (const auto& face : faces) {
        sum += cross(big(face[0]), big(face[1]), big(face[2]));
    }
    return sum.str();
}

std::vector<Key2> convex_hull(std::vector<Key2> keys) {
    std::sort(keys.begin(), keys.end(), is_before);
    std::vector<Key2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Key2 key : keys) {
            while (hull.size() >= start + 2 && orient2d(hull[hull.size() - 2], hull.back(), key) <= 0) {
                hull.pop_back();
            }
            hull.push_back(key);
        }
        hull.pop_back();
        std::reverse(keys.begin(), keys.end());
    }
    return hull;
}

std::vector<std::size_t> keys_on_hull(std::span<const Key2> keys) {
    std::vector<bool> is_on(keys.size(), false);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        for (std::size_t j = 0; j < keys.size(); ++j) {
            if (i != j && std::all_of(keys.begin(), keys.end(),
                                      [&](Key2 key) { return orient2d(keys[i], keys[j], key) >= 0; })) {
                is_on[i] = is_on[j] = true;
            }
        }
    }
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (is_on[i]) {
            indices.push_back(i);
        }
    }
    return indices;
}

bool do_interiors_meet(const std::array<Key2, 3>& a, const std::array<Key2, 3>& b) {
    using boost::multiprecision::cpp_rational;
    struct Point {
        cpp_rational x;
        cpp_rational y;
    };
    const auto point = [](Key2 key) { return Point{cpp_rational(big(key.x)), cpp_rational(big(key.y))}; };
    const auto turn = [](const Point& p, const Point& q, const Point& r) {
        return cpp_rational((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    };
    std::vector<Point> part{point(a[0]), point(a[1]), point(a[2])};
    for (std::size_t i = 0; i < 3; ++i) {
        const Point p = point(b[i]);
        const Point q = point(b[(i + 1) % 3]);
        std::vector<Point> rest;
        for (std::size_t k = 0; k < part.size(); ++k) {
            const Point& from = part[k];
            const Point& to = part[(k + 1) % part.size()];
            const cpp_rational h = turn(p, q, from);
            const cpp_rational g = turn(p, q, to);
            if (h >= 0) {
                rest.push_back(from);
            }
            if (h.sign() * g.sign() < 0) {
                const cpp_rational t = h / (h - g);
                rest.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
            }
        }
        part = rest;
    }
    cpp_rational area = 0;
    for (std::size_t k = 2; k < part.size(); ++k) {
        area += turn(part[0], part[k - 1], part[k]);
    }
    return area > 0;
}

std::vector<Triple> delaunay(std::span<const Key2> keys) {
    const bool small = is_small(keys);
    const auto is_inside = [&](Key2 a, Key2 b, Key2 c, Key2 d) {
        const int side = small ? incircle_of_small(a, b, c, d) : incircle(a, b, c, d);
        return (side != 0 ? side : incircle_perturbed(a, b, c, d)) > 0;
    };
    const auto n = static_cast<std::uint32_t>(keys.size());
    std::vector<Triple> faces;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = i + 1; j < n; ++j) {
            for (std::uint32_t k = i + 1; k < n; ++k) {
                if (k == j || orient2d(keys[i], keys[j], keys[k]) <= 0) {
                    continue;
                }
                bool is_empty = true;
                for (std::uint32_t other = 0; other < n && is_empty; ++other) {
                    is_empty = other == i || other == j || other == k ||
                               !is_inside(keys[i], keys[j], keys[k], keys[other]);
                }
                if (is_empty) {
                    faces.push_back({i, j, k});
                }
            }
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

std::string curve_code(Key2 key) {
    const auto x = static_cast<std::uint64_t>(key.x);
    const auto y = static_cast<std::uint64_t>(key.y);
    std::string code;
    for (int bit = 52; bit >= 0; --bit) {
        code += (x >> static_cast<unsigned>(bit) & 1U) != 0 ? '1' : '0';
        code += (y >> static_cast<unsigned>(bit) & 1U) != 0 ? '1' : '0';
    }
    return code;
}

double decimal_value(std::int64_t steps, int decimals) {
    const std::string text = std::to_string(steps) + "e-" + std::to_string(decimals);
    return std::strtod(text.c_str(), nullptr);
}

}  // namespace tinwright_tests::oracle
