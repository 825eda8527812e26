#ifndef TINWRIGHT_TESTS_IO_TIN_EXAMPLES_HPP
#define TINWRIGHT_TESTS_IO_TIN_EXAMPLES_HPP

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tinwright/mesh/tin.hpp"

#include "support/point_sets.hpp"
#include "support/tins.hpp"

namespace tinwright_tests {

/// A Delaunay TIN of `count` seeded samples around (500000, 6700000): centimetres, or with `is_binary` any
/// fraction. A fifth of the edges is constrained, a few faces inside are void, one vertex is a Steiner one.
inline tinwright::Tin example_tin(std::uint64_t seed, int count, bool is_binary = false) {
    using namespace tinwright;
    Random random(seed);
    std::vector<Point3> samples;
    for (int i = 0; i < count; ++i) {
        if (is_binary) {
            samples.push_back({5e5 + 300 * random.real(), 6.7e6 + 300 * random.real(), 90 * random.real()});
        } else {
            samples.push_back({static_cast<double>(50000000 + random.integer(0, 30000)) / 100,
                               static_cast<double>(670000000 + random.integer(0, 30000)) / 100,
                               static_cast<double>(random.integer(-5000, 9000)) / 1000});
        }
    }
    Tin tin = tin_of_samples(samples, DuplicatePolicy::Max);
    tin.sample[tin.sample.size() / 2] = Tin::kNoSample;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        const std::int64_t choice = random.integer(0, 19);
        if (choice < 6) {
            tin.mesh.set_constrained(half_edge({f}, static_cast<unsigned>(choice % 3)), true);
        } else if (choice == 6 && !tin.mesh.is_ghost({f})) {
            tin.mesh.set_terrain({f}, false);
        }
    }
    return tin;
}

using Corner = std::array<double, 3>;

/// The terrain faces as positions, each from its least corner on, sorted.
inline std::vector<std::array<Corner, 3>> terrain_of(const tinwright::Tin& tin) {
    std::vector<std::array<Corner, 3>> faces;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            std::array<Corner, 3> face;
            for (unsigned i = 0; i < 3; ++i) {
                const tinwright::Point3 p = tin.position(tin.mesh.vertex({f}, i));
                face[i] = {p.x, p.y, p.z};
            }
            std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

/// The constrained edges of terrain faces as positions, sorted.
inline std::vector<std::pair<Corner, Corner>> constrained_of(const tinwright::Tin& tin) {
    std::vector<std::pair<Corner, Corner>> edges;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin.mesh.is_terrain({f}); ++i) {
            const tinwright::HalfEdgeId h = tinwright::half_edge({f}, i);
            if (tin.mesh.is_constrained(h)) {
                const tinwright::Point3 p = tin.position(tin.mesh.origin(h));
                const tinwright::Point3 q = tin.position(tin.mesh.destination(h));
                const Corner a = {p.x, p.y, p.z};
                const Corner b = {q.x, q.y, q.z};
                edges.emplace_back(std::min(a, b), std::max(a, b));
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace tinwright_tests

#endif
