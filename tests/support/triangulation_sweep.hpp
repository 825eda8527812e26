#ifndef TINWRIGHT_TESTS_SUPPORT_TRIANGULATION_SWEEP_HPP
#define TINWRIGHT_TESTS_SUPPORT_TRIANGULATION_SWEEP_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "support/triangulation_oracle.hpp"

/// How the oracles find the best of all triangulations without listing them.
namespace tinwright_tests::oracle {

/// Sites in lexicographic order, and which of their triples may be faces.
class FaceTable {
  public:
    explicit FaceTable(const Sites& sites);

    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] Site point(std::size_t rank) const { return points_[rank]; }
    [[nodiscard]] std::uint32_t site(std::size_t rank) const { return order_[rank]; }
    [[nodiscard]] bool do_edges_cross(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
        return do_cross(points_[a].key, points_[b].key, points_[c].key, points_[d].key);
    }
    /// Side of c of the line a b, by rank.
    [[nodiscard]] int side(std::size_t a, std::size_t b, std::size_t c) const {
        return side_[(a * size() + b) * size() + c];
    }
    /// Whether the triangle of these three, a < b < c, has no other point in it or on its edges and crosses
    /// no constraint.
    [[nodiscard]] bool is_face(std::size_t a, std::size_t b, std::size_t c) const {
        return is_face_[(a * size() + b) * size() + c];
    }

  private:
    void tabulate();
    [[nodiscard]] bool is_empty(std::size_t a, std::size_t b, std::size_t c) const;

    std::vector<std::uint32_t> order_;
    std::vector<Site> points_;
    std::vector<std::array<std::size_t, 2>> constraints_;
    std::vector<int> side_;
    std::vector<bool> is_face_;
};

/// Tabulates the best completions above monotone paths, which are sets of ranks as bits.
///
/// `Cost` has a type `Value`, default for no faces and less for better, and `with_face(value, a, b, c)`: the
/// value with one more face, its corners ascending by rank; it must keep the order of values.
template <class Cost>
class Sweep {
  public:
    using Path = std::uint32_t;
    using Value = typename Cost::Value;

    Sweep(const FaceTable& table, const Cost& cost)
        : table_(table),
          cost_(cost),
          best_(std::size_t{1} << table.size()),
          is_known_(std::size_t{1} << table.size()) {}

    /// The whole of it, from the lower hull.
    const Value& best() {
        Path lower = 0;
        upper_ = 0;
        for (std::size_t p = 0; p < table_.size(); ++p) {
            lower |= is_on_hull(p, 1) ? bit(p) : 0;
            upper_ |= is_on_hull(p, -1) ? bit(p) : 0;
        }
        return *complete(lower);
    }

  private:
    static Path bit(std::size_t p) { return Path{1} << p; }

    [[nodiscard]] bool is_on_hull(std::size_t p, int inner_side) const {
        for (std::size_t a = 0; a < p; ++a) {
            for (std::size_t c = p + 1; c < table_.size(); ++c) {
                if (table_.side(a, c, p) == inner_side) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Empty if no triangulation contains the path.
    const std::optional<Value>& complete(Path path) {
        if (is_known_[path]) {
            return best_[path];
        }
        is_known_[path] = true;
        if (path == upper_) {
            best_[path] = Value{};
            return best_[path];
        }
        std::vector<std::size_t> on_path;
        for (std::size_t p = 0; p < table_.size(); ++p) {
            if ((path & bit(p)) != 0) {
                on_path.push_back(p);
            }
        }
        for (std::size_t i = 1; i < on_path.size(); ++i) {
            const std::size_t a = on_path[i - 1];
            const std::size_t c = on_path[i];
            for (std::size_t p = a + 1; p < c; ++p) {
                if (table_.side(a, c, p) > 0 && table_.is_face(a, p, c)) {
                    advance(path, path | bit(p), a, p, c);
                }
            }
            if (i + 1 < on_path.size()) {
                const std::size_t after = on_path[i + 1];
                if (table_.side(a, c, after) > 0 && table_.is_face(a, c, after)) {
                    advance(path, path & ~bit(c), a, c, after);
                }
            }
        }
        return best_[path];
    }

    /// Takes the completion by the triangle a b c and then the best above `next`, if it is better.
    void advance(Path path, Path next, std::size_t a, std::size_t b, std::size_t c) {
        const std::optional<Value>& rest = complete(next);
        if (!rest) {
            return;
        }
        Value value = cost_.with_face(*rest, a, b, c);
        if (!best_[path] || value < *best_[path]) {
            best_[path] = std::move(value);
        }
    }

    const FaceTable& table_;
    const Cost& cost_;
    std::vector<std::optional<Value>> best_;
    std::vector<bool> is_known_;
    Path upper_ = 0;
};

}  // namespace tinwright_tests::oracle

#endif
