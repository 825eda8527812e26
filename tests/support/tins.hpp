#ifndef TINWRIGHT_TESTS_SUPPORT_TINS_HPP
#define TINWRIGHT_TESTS_SUPPORT_TINS_HPP

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/mesh/tin.hpp"

#include "support/point_sets.hpp"

/// Short ways to meshes and TINs for tests.
namespace tinwright_tests {

inline tinwright::TriangleMesh mesh_of(std::size_t vertex_count, std::span<const std::uint32_t> corners) {
    std::vector<tinwright::VertexId> ids;
    for (const std::uint32_t v : corners) {
        ids.push_back({v});
    }
    return tinwright::make_mesh(vertex_count, ids);
}
inline tinwright::TriangleMesh mesh_of(std::size_t vertex_count,
                                       std::initializer_list<std::uint32_t> corners) {
    return mesh_of(vertex_count, std::span<const std::uint32_t>(corners.begin(), corners.size()));
}

/// A TIN of these keys with elevation zero and no mesh yet.
inline tinwright::Tin tin_of(std::span<const tinwright::Key2> keys) {
    tinwright::Tin tin;
    tin.z.assign(keys.size(), 0.0);
    tin.sample.assign(keys.size(), tinwright::Tin::kNoSample);
    tin.keys.assign(keys.begin(), keys.end());
    return tin;
}

/// The Delaunay TIN of samples; duplicates by `policy`.
inline tinwright::Tin tin_of_samples(const std::vector<tinwright::Point3>& samples,
                                     tinwright::DuplicatePolicy policy = tinwright::DuplicatePolicy::Error) {
    tinwright::SampleVertices vertices = tinwright::make_sample_vertices(samples, {.policy = policy});
    tinwright::Tin tin;
    tin.mesh = tinwright::make_delaunay(vertices.keys);
    tin.lattice = vertices.lattice;
    tin.keys = std::move(vertices.keys);
    tin.z = std::move(vertices.z);
    tin.sample = std::move(vertices.sample);
    return tin;
}

/// `keys` without repetitions, in curve order.
inline std::vector<tinwright::Key2> in_curve_order(std::vector<tinwright::Key2> keys) {
    keys = without_repetitions(std::move(keys));
    std::vector<tinwright::Key2> sorted;
    for (const std::uint32_t i : tinwright::sort_along_curve(keys)) {
        sorted.push_back(keys[i]);
    }
    return sorted;
}

/// The Delaunay TIN of two or more distinct keys.
inline tinwright::Tin delaunay_tin(std::vector<tinwright::Key2> keys) {
    tinwright::Tin tin = tin_of(in_curve_order(std::move(keys)));
    tin.mesh = tinwright::make_delaunay(tin.keys);
    return tin;
}

/// Corners of the terrain faces, least first, sorted.
inline std::vector<std::array<std::uint32_t, 3>> terrain_of(const tinwright::TriangleMesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (mesh.is_terrain({f})) {
            const auto& v = mesh.face({f}).vertex;
            std::array<std::uint32_t, 3> face{v[0].value, v[1].value, v[2].value};
            std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
            faces.push_back(face);
        }
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

/// Everything a TIN holds but the numbers of its samples, as words.
inline std::vector<std::uint64_t> words_of(const tinwright::Tin& tin) {
    std::vector<std::uint64_t> words;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const tinwright::Point3 p = tin.position({v});
        for (const double number : {p.x, p.y, p.z}) {
            words.push_back(std::bit_cast<std::uint64_t>(number));
        }
    }
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        const tinwright::TriangleMesh::Face& face = tin.mesh.face({f});
        for (unsigned i = 0; i < 3; ++i) {
            words.push_back(face.vertex[i].value);
            words.push_back(face.twin[i].value);
        }
        words.push_back(face.marks);
    }
    return words;
}

/// The same faces in another order, each turned so that it begins at any of its corners.
inline std::vector<std::uint32_t> shuffled_faces(Random& random, std::span<const std::uint32_t> corners) {
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::size_t c = 0; c < corners.size(); c += 3) {
        const auto start = static_cast<std::size_t>(random.integer(0, 2));
        faces.push_back({corners[c + start], corners[c + (start + 1) % 3], corners[c + (start + 2) % 3]});
    }
    std::vector<std::uint32_t> result;
    for (const auto& face : shuffled(random, faces)) {
        result.insert(result.end(), face.begin(), face.end());
    }
    return result;
}

}  // namespace tinwright_tests

#endif
