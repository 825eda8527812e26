#include "support/triangulation_sweep.hpp"

#include <algorithm>
#include <numeric>

namespace tinwright_tests::oracle {

using tinwright::Key2;

namespace {

bool is_before(Key2 a, Key2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

}  // namespace

FaceTable::FaceTable(const Sites& sites) : order_(sites.keys.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return is_before(sites.keys[a], sites.keys[b]); });
    std::vector<std::size_t> rank(order_.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
        rank[order_[i]] = i;
        points_.push_back({sites.keys[order_[i]], sites.z[order_[i]]});
    }
    for (const Edge& edge : sites.constraints) {
        constraints_.push_back({rank[edge[0]], rank[edge[1]]});
    }
    tabulate();
}

void FaceTable::tabulate() {
    const std::size_t n = size();
    side_.assign(n * n * n, 0);
    is_face_.assign(n * n * n, false);
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
            for (std::size_t c = 0; c < n; ++c) {
                side_[(a * n + b) * n + c] = turn(points_[a].key, points_[b].key, points_[c].key);
            }
        }
    }
    std::vector<bool> is_allowed(n * n, true);
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = 0; b < n; ++b) {
            for (const auto& [from, to] : constraints_) {
                is_allowed[a * n + b] = is_allowed[a * n + b] && !do_edges_cross(a, b, from, to);
            }
        }
    }
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t b = a + 1; b < n; ++b) {
            for (std::size_t c = b + 1; c < n; ++c) {
                is_face_[(a * n + b) * n + c] = is_allowed[a * n + b] && is_allowed[b * n + c] &&
                                                is_allowed[a * n + c] && is_empty(a, b, c);
            }
        }
    }
}

bool FaceTable::is_empty(std::size_t a, std::size_t b, std::size_t c) const {
    const int sense = side(a, b, c);
    if (sense == 0) {
        return false;
    }
    for (std::size_t p = 0; p < size(); ++p) {
        if (p != a && p != b && p != c && side(a, b, p) * sense >= 0 && side(b, c, p) * sense >= 0 &&
            side(c, a, p) * sense >= 0) {
            return false;
        }
    }
    return true;
}

}  // namespace tinwright_tests::oracle
