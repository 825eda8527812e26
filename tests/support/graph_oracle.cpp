#include "support/graph_oracle.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <boost/multiprecision/cpp_int.hpp>

namespace tinwright_tests::oracle {

using boost::multiprecision::cpp_int;
using tinwright::HalfEdgeId;
using tinwright::Key2;
using tinwright::Norm;
using tinwright::Tin;
using tinwright::TriangleMesh;

namespace {

cpp_int power_of_length(Norm norm, Key2 a, Key2 b) {
    const cpp_int x = boost::multiprecision::abs(cpp_int(static_cast<std::int64_t>(a.x - b.x)));
    const cpp_int y = boost::multiprecision::abs(cpp_int(static_cast<std::int64_t>(a.y - b.y)));
    if (norm.is_maximum()) {
        return x < y ? y : x;
    }
    const auto p = static_cast<unsigned>(norm.power());
    return boost::multiprecision::pow(x, p) + boost::multiprecision::pow(y, p);
}

// Of the triangle scaled by two, so that the midpoint of two keys is a lattice point.
bool is_midpoint_inside(const std::array<Key2, 3>& face, Key2 a, Key2 b) {
    const auto twice = [](Key2 key) { return Key2{2 * key.x, 2 * key.y}; };
    const Key2 middle{a.x + b.x, a.y + b.y};
    for (std::size_t i = 0; i < 3; ++i) {
        if (turn(twice(face[i]), twice(face[(i + 1) % 3]), middle) < 0) {
            return false;
        }
    }
    return true;
}

bool sees(const Scene& scene, std::uint32_t a, std::uint32_t b) {
    const auto& keys = scene.keys;
    for (const Key2 key : keys) {
        if (is_inside_segment(key, keys[a], keys[b])) {
            return false;
        }
    }
    for (const Edge& wall : scene.walls) {
        if (wall == Edge{a, b} || wall == Edge{b, a}) {
            return true;
        }
    }
    return std::none_of(
               scene.walls.begin(), scene.walls.end(),
               [&](const Edge& wall) { return do_cross(keys[a], keys[b], keys[wall[0]], keys[wall[1]]); }) &&
           std::none_of(scene.voids.begin(), scene.voids.end(), [&](const std::array<Key2, 3>& face) {
               return is_midpoint_inside(face, keys[a], keys[b]);
           });
}

// Whether p q is a side of a void that lies towards x.
bool is_void_towards(const Scene& scene, Key2 p, Key2 q, Key2 x) {
    return std::any_of(scene.voids.begin(), scene.voids.end(), [&](const std::array<Key2, 3>& face) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::array<Key2, 2> side = {face[i], face[(i + 1) % 3]};
            if (side == std::array{p, q} || side == std::array{q, p}) {
                return turn(p, q, face[(i + 2) % 3]) == turn(p, q, x);
            }
        }
        return false;
    });
}

std::vector<Edge> all_pairs(std::size_t count) {
    std::vector<Edge> pairs;
    for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
            pairs.push_back({a, b});
        }
    }
    return pairs;
}

}  // namespace

Scene open_scene(const Tin& tin) { return {{tin.keys.begin(), tin.keys.end()}, {}, {}}; }

Scene scene_of(const Tin& tin) {
    Scene scene = open_scene(tin);
    const TriangleMesh& mesh = tin.mesh;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (mesh.is_ghost({f})) {
            continue;
        }
        const auto& corner = mesh.face({f}).vertex;
        if (!mesh.is_terrain({f})) {
            scene.voids.push_back({tin.key(corner[0]), tin.key(corner[1]), tin.key(corner[2])});
            continue;
        }
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = tinwright::half_edge({f}, i);
            if (mesh.is_constrained(h) || mesh.is_border(h)) {
                scene.walls.push_back({mesh.origin(h).value, mesh.destination(h).value});
            }
        }
    }
    return scene;
}

PairTable sights(const Scene& scene) {
    PairTable table(scene.keys.size());
    for (const auto& [a, b] : all_pairs(scene.keys.size())) {
        table.set(a, b, sees(scene, a, b) ? 1 : 0);
    }
    return table;
}

PairTable ranks(std::span<const Key2> keys, Norm norm, Ties ties) {
    using Weight = std::tuple<cpp_int, cpp_int, Edge>;
    std::vector<Weight> weights;
    for (const Edge& pair : all_pairs(keys.size())) {
        const Key2 a = keys[pair[0]];
        const Key2 b = keys[pair[1]];
        weights.emplace_back(power_of_length(norm, a, b), power_of_length(Norm(), a, b), pair);
    }
    std::sort(weights.begin(), weights.end());
    PairTable table(keys.size());
    int rank = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const bool is_equal = i > 0 && std::get<0>(weights[i]) == std::get<0>(weights[i - 1]);
        rank += ties == Ties::Equal && is_equal ? 0 : 1;
        const Edge& pair = std::get<2>(weights[i]);
        table.set(pair[0], pair[1], rank);
    }
    return table;
}

std::vector<Edge> relative_neighbors(const Scene& scene, Norm norm, Ties ties) {
    const PairTable sight = sights(scene);
    const PairTable rank = ranks(scene.keys, norm, ties);
    std::vector<Edge> edges;
    for (const auto& [p, q] : all_pairs(scene.keys.size())) {
        bool is_edge = sight(p, q) == 1;
        for (std::uint32_t x = 0; x < scene.keys.size() && is_edge; ++x) {
            is_edge = x == p || x == q || sight(p, x) == 0 || sight(q, x) == 0 || rank(p, x) >= rank(p, q) ||
                      rank(q, x) >= rank(p, q) ||
                      is_void_towards(scene, scene.keys[p], scene.keys[q], scene.keys[x]);
        }
        if (is_edge) {
            edges.push_back({p, q});
        }
    }
    return edges;
}

std::vector<Edge> gabriel_neighbors(std::span<const Key2> keys) {
    std::vector<Edge> edges;
    for (const auto& [p, q] : all_pairs(keys.size())) {
        bool is_empty = true;
        for (std::uint32_t x = 0; x < keys.size() && is_empty; ++x) {
            is_empty = x == p || x == q || angle_sign(keys[p], keys[x], keys[q]) > 0;
        }
        if (is_empty) {
            edges.push_back({p, q});
        }
    }
    return edges;
}

std::vector<Edge> minimum_spanning_tree(std::span<const Key2> keys, Norm norm) {
    const PairTable rank = ranks(keys, norm, Ties::Ordered);
    std::vector<std::uint32_t> outside(keys.size() - 1);
    std::iota(outside.begin(), outside.end(), 1U);
    std::vector<std::uint32_t> nearest(keys.size(), 0);  // in the tree
    std::vector<Edge> tree;
    while (!outside.empty()) {
        const auto added = std::min_element(
            outside.begin(), outside.end(),
            [&](std::uint32_t u, std::uint32_t v) { return rank(u, nearest[u]) < rank(v, nearest[v]); });
        const std::uint32_t v = *added;
        outside.erase(added);
        tree.push_back({std::min(v, nearest[v]), std::max(v, nearest[v])});
        for (const std::uint32_t u : outside) {
            nearest[u] = rank(u, v) < rank(u, nearest[u]) ? v : nearest[u];
        }
    }
    std::sort(tree.begin(), tree.end());
    return tree;
}

bool is_plane(std::span<const Key2> keys, std::span<const Edge> edges) {
    for (const Edge& e : edges) {
        for (const Edge& f : edges) {
            if (do_cross(keys[e[0]], keys[e[1]], keys[f[0]], keys[f[1]])) {
                return false;
            }
        }
    }
    return true;
}

std::size_t count_components(std::size_t vertex_count, std::span<const Edge> edges) {
    std::vector<std::uint32_t> label(vertex_count);
    std::iota(label.begin(), label.end(), 0U);
    std::size_t count = vertex_count;
    for (const Edge& edge : edges) {
        const std::uint32_t from = label[edge[0]];
        const std::uint32_t to = label[edge[1]];
        count -= from != to ? 1 : 0;
        std::replace(label.begin(), label.end(), from, to);
    }
    return count;
}

}  // namespace tinwright_tests::oracle
