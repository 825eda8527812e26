#include "support/ring_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/triangulation_oracle.hpp"

namespace tinwright_tests {

using tinwright::Key2;

namespace {

using Keys = std::vector<Key2>;

/// The point at an angle (radians) and distance from (centre, centre), rounded.
Key2 polar(double centre, double angle, double radius) {
    return {centre + std::round(radius * std::cos(angle)), centre + std::round(radius * std::sin(angle))};
}

bool is_on(Key2 p, Key2 a, Key2 b) { return p == a || p == b || oracle::is_inside_segment(p, a, b); }

bool do_touch(Key2 a, Key2 b, Key2 c, Key2 d) {
    return oracle::do_cross(a, b, c, d) || is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) ||
           is_on(d, a, b);
}

/// Whether a ring is counter-clockwise and does not touch itself.
bool is_simple(const Keys& ring) {
    const std::size_t n = ring.size();
    const auto at = [&](std::size_t i) { return ring[i % n]; };
    double area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (is_on(at(i), at(i + 1), at(i + 2)) || is_on(at(i + 2), at(i), at(i + 1))) {
            return false;
        }
        for (std::size_t j = i + 2; j < std::min(n, n + i - 1); ++j) {
            if (do_touch(at(i), at(i + 1), at(j), at(j + 1))) {
                return false;
            }
        }
        area += (at(i).x - at(0).x) * (at(i + 1).y - at(0).y) - (at(i).y - at(0).y) * (at(i + 1).x - at(0).x);
    }
    return n > 2 && area > 0;
}

/// Repeats `make` until it gives a simple polygon, turning clockwise ones round.
template <class Make>
Keys simple_ring(const Make& make) {
    while (true) {
        Keys ring = make();
        if (is_simple(ring)) {
            return ring;
        }
        std::reverse(ring.begin(), ring.end());
        if (is_simple(ring)) {
            return ring;
        }
    }
}

Keys near_circle(Random& random, std::size_t sides) {
    const double rough = random.integer(0, 1) == 0 ? 0 : 0.02;
    return simple_ring([&] {
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double turn = (static_cast<double>(i) + 0.4 * random.real()) / static_cast<double>(sides);
            ring.push_back(polar(20000, 2 * std::numbers::pi * turn, 10000 * (1 - rough * random.real())));
        }
        return ring;
    });
}

/// What is left when a third of a circle, more or less, is cut off: of two points on it that are farther
/// apart than the cut is long, Delaunay joins some.
Keys cut_circle(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double cut = 1.8 + 1.4 * random.real();
        const double rough = 0.1 * random.real() * random.real();
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double way = (static_cast<double>(i) + 0.5 * random.real()) / static_cast<double>(sides);
            const double angle = cut + (2 * std::numbers::pi - cut) * way;
            ring.push_back(polar(20000, angle, 10000 * (1 - rough * random.real())));
        }
        return ring;
    });
}

/// An arc of somewhat less than a third of a circle and one vertex opposite, farther from the arc's middle
/// than from its ends.
Keys fan(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double width = 1.7 + 0.5 * random.real();
        const double rough = 0.1 * random.real() * random.real();
        Keys ring{polar(20000, std::numbers::pi, 10000 * (1 - rough * random.real()))};
        for (std::size_t i = 1; i < sides; ++i) {
            const double way = (static_cast<double>(i) + 0.5 * random.real()) / static_cast<double>(sides);
            ring.push_back(polar(20000, width * (way - 0.5), 10000 * (1 - rough * random.real())));
        }
        return ring;
    });
}

/// All sides of a regular polygon; lengths tie as far as keys allow.
Keys regular(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double radius = random.integer(0, 1) == 0 ? 1e6 : 3.0 * static_cast<double>(sides);
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double turn = static_cast<double>(i) / static_cast<double>(sides);
            ring.push_back(polar(2e6, 2 * std::numbers::pi * turn, radius));
        }
        return ring;
    });
}

Keys star(Random& random, std::size_t sides) {
    return simple_ring([&] {
        Keys ring;
        for (std::size_t i = 0; i < sides; ++i) {
            const double turn = (static_cast<double>(i) + 0.9 * random.real()) / static_cast<double>(sides);
            ring.push_back(polar(20000, 2 * std::numbers::pi * turn, 2000 + random.key(8000)));
        }
        return ring;
    });
}

/// Between two arcs around one centre.
Keys bow(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const double width = 0.3 + 4 * random.real();
        const double inner = 1 - 0.5 * random.real() * random.real();
        Keys ring;
        const std::size_t half = sides / 2;
        for (std::size_t i = 0; i < sides; ++i) {
            const bool is_outer = i < half;
            const double at = static_cast<double>(is_outer ? i : sides - 1 - i) + 0.5 * random.real();
            const double angle = width * at / static_cast<double>(half);
            ring.push_back(polar(200000, angle, is_outer ? 100000 : inner * 100000));
        }
        return ring;
    });
}

/// Teeth that stand close to each other.
Keys comb(Random& random, std::size_t sides) {
    return simple_ring([&] {
        Keys ring{{0, 0}, {100.0 * static_cast<double>(sides), 0}};
        for (std::size_t i = sides - 2; i > 0; --i) {
            const double x = 100.0 * static_cast<double>(i) + random.key(90);
            ring.push_back({x, i % 2 == 0 ? 100 + random.key(200) : 900 + random.key(1500)});
        }
        return ring;
    });
}

/// Turns parts of a closed way through `keys` round until it does not cross itself.
void uncross(Keys& keys) {
    const std::size_t n = keys.size();
    for (std::size_t round = 0; round < 100 * n; ++round) {
        bool is_clean = true;
        for (std::size_t i = 0; i + 2 < n; ++i) {
            for (std::size_t j = i + 2; j < n; ++j) {
                if (oracle::do_cross(keys[i], keys[i + 1], keys[j], keys[(j + 1) % n])) {
                    std::reverse(keys.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 keys.begin() + static_cast<std::ptrdiff_t>(j) + 1);
                    is_clean = false;
                }
            }
        }
        if (is_clean) {
            return;
        }
    }
}

template <int kSize>
Keys tangle(Random& random, std::size_t sides) {
    return simple_ring([&] {
        std::vector<Key2> keys(kSize < 100 ? std::min(sides, std::size_t{2} * kSize) : sides);
        std::generate(keys.begin(), keys.end(), [&] { return Key2{random.key(kSize), random.key(kSize)}; });
        keys = shuffled(random, without_repetitions(keys));
        uncross(keys);
        return keys;
    });
}

/// A polygon with few corners whose sides are divided, so that they are all of about one length.
Keys dense(Random& random, std::size_t sides) {
    return simple_ring([&] {
        const Keys corners =
            random.integer(0, 1) == 0 ? star(random, 3 + sides / 12) : tangle<20000>(random, 4 + sides / 12);
        double way = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Key2 to = corners[(i + 1) % corners.size()];
            way += std::hypot(to.x - corners[i].x, to.y - corners[i].y);
        }
        Keys ring;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Key2 from = corners[i];
            const Key2 to = corners[(i + 1) % corners.size()];
            const double length = std::hypot(to.x - from.x, to.y - from.y);
            const double parts = std::max(1.0, std::round(static_cast<double>(sides) * length / way));
            for (double t = 0; t < parts; ++t) {
                ring.push_back({std::round(from.x + (to.x - from.x) * t / parts),
                                std::round(from.y + (to.y - from.y) * t / parts)});
            }
        }
        return ring;
    });
}

constexpr std::array kRingFamilies{
    RingFamily{"near a circle", near_circle},
    RingFamily{"fan", fan},
    RingFamily{"regular", regular},
    RingFamily{"cut circle", cut_circle},
    RingFamily{"star", star},
    RingFamily{"bow", bow},
    RingFamily{"comb", comb},
    RingFamily{"tangle", tangle<20000>},
    RingFamily{"tangle of 8", tangle<8>},
    RingFamily{"dense", dense},
};

}  // namespace

std::span<const RingFamily> ring_families() { return kRingFamilies; }

}  // namespace tinwright_tests
