#ifndef TINWRIGHT_TESTS_CRITERIA_FACES_HPP
#define TINWRIGHT_TESTS_CRITERIA_FACES_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "tinwright/criteria/criterion.hpp"

#include "support/oracles.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"

/// Single faces of all shapes and widths, and what rational numbers say of them.
namespace tinwright_tests {

using boost::multiprecision::cpp_rational;
using tinwright::Criterion;
using tinwright::Key2;
using tinwright::Lattice;
using tinwright::Tin;

struct Corner {
    Key2 key;
    double z = 0;
};
using Face = std::array<Corner, 3>;

/// Three vertices without a mesh, on a lattice of 10^-decimals.
inline Tin tin_of_face(const Face& face, int decimals = 0) {
    Tin tin = tin_of(std::vector<Key2>{face[0].key, face[1].key, face[2].key});
    tin.lattice = Lattice::decimal(decimals, {0, 0});
    for (std::size_t i = 0; i < 3; ++i) {
        tin.z[i] = face[i].z;
    }
    return tin;
}

/// Counter-clockwise, or nothing if the corners are collinear.
inline bool orient(Face& face) {
    const int side = oracle::orient2d(face[0].key, face[1].key, face[2].key);
    if (side < 0) {
        std::swap(face[1], face[2]);
    }
    return side != 0;
}

/// Faces of any width and shape: from the families of keys, needles, isosceles ones, right angles.
inline Face any_face(Random& random) {
    const auto families = key_families();
    const auto pick =
        static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(families.size()) + 3));
    const double limit = std::ldexp(1.0, static_cast<int>(random.integer(4, 43)));
    const auto any = [&] { return random.key(limit); };
    Face face{};
    const double u = any();
    const double v = any();
    if (pick < families.size()) {
        const std::vector<Key2> keys = without_repetitions(families[pick].make(random, 40));
        for (Corner& corner : face) {
            corner.key =
                keys[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(keys.size()) - 1))];
        }
    } else if (pick == families.size()) {  // isosceles, about an axis
        face = {{{{0, v}, 0}, {{2 * u, v}, 0}, {{u, any()}, 0}}};
    } else if (pick == families.size() + 1) {  // isosceles and right-angled
        face = {{{{limit, limit}, 0}, {{limit + u, limit + v}, 0}, {{limit - v, limit + u}, 0}}};
    } else {  // within some keys of a line, or of a right angle
        const double k = random.key(1024);
        const bool is_needle = pick == families.size() + 2;
        const double w = std::floor(limit / 1024);
        const Key2 step{std::floor(u / 1024), std::floor(v / 1024)};
        const Key2 turned = is_needle ? step : Key2{-step.y, step.x};
        const double base = 2 * limit + w;
        face = {{{{base, base}, 0},
                 {{base + 512 * step.x, base + 512 * step.y}, 0},
                 {{base + k * turned.x + random.key(3), base + k * turned.y + random.key(3)}, 0}}};
    }
    const int relief = static_cast<int>(random.integer(0, 2));
    for (Corner& corner : face) {
        corner.z = relief == 0   ? static_cast<double>(random.integer(0, 3))
                   : relief == 1 ? 1e4 * random.real()
                                 : 812.37 + 1e-9 * random.real();
    }
    return face;
}

struct Vector {
    cpp_rational x;
    cpp_rational y;
};
inline cpp_rational dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
inline cpp_rational cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }

/// What rational numbers say of a face: the largest angle's corner has the longest edge opposite.
struct Exact {
    std::array<Vector, 3> position;
    std::array<cpp_rational, 3> z;
    std::size_t corner = 0;
    cpp_rational longest;
    cpp_rational inner;
    cpp_rational area;
    Vector gradient;

    explicit Exact(const Face& face) {
        for (std::size_t i = 0; i < 3; ++i) {
            position[i] = {cpp_rational(face[i].key.x), cpp_rational(face[i].key.y)};
            z[i] = cpp_rational(face[i].z);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector opposite = edge((i + 1) % 3, (i + 2) % 3);
            if (dot(opposite, opposite) > longest) {
                longest = dot(opposite, opposite);
                corner = i;
            }
        }
        inner = dot(edge(corner, (corner + 1) % 3), edge(corner, (corner + 2) % 3));
        area = cross(edge(0, 1), edge(0, 2));
        const cpp_rational du = z[1] - z[0];
        const cpp_rational dv = z[2] - z[0];
        gradient = {(du * edge(0, 2).y - dv * edge(0, 1).y) / area,
                    (dv * edge(0, 1).x - du * edge(0, 2).x) / area};
    }
    [[nodiscard]] Vector edge(std::size_t from, std::size_t to) const {
        return {position[to].x - position[from].x, position[to].y - position[from].y};
    }
    /// Of length, the square.
    [[nodiscard]] cpp_rational measure(Criterion criterion) const {
        switch (criterion) {
            case Criterion::Angle:
                return -inner / area;
            case Criterion::Height:
                return longest / (area * area);
            case Criterion::Slope:
                return dot(gradient, gradient);
            case Criterion::Length:
                return longest;
            case Criterion::Eccentricity:
                break;
        }
        return inner >= 0 ? cpp_rational(0) : cpp_rational(longest * inner * inner / (area * area));
    }
    /// The corners whose line of steepest descent runs through the face; all three if it is level.
    [[nodiscard]] unsigned descent_corners() const {
        std::array<cpp_rational, 3> along;  // along a level line
        for (std::size_t i = 0; i < 3; ++i) {
            along[i] = cross(gradient, position[i]);
        }
        unsigned corners = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const cpp_rational left = along[(i + 1) % 3] - along[i];
            const cpp_rational right = along[(i + 2) % 3] - along[i];
            corners |= left * right <= 0 ? 1U << i : 0U;
        }
        return corners;
    }
};
}  // namespace tinwright_tests

#endif
