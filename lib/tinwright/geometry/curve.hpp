#ifndef TINWRIGHT_GEOMETRY_CURVE_HPP
#define TINWRIGHT_GEOMETRY_CURVE_HPP

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/geometry/lattice.hpp"

/// The order in which vertices are numbered: along the Z-order curve of their keys [morton1966] (x's bit
/// before y's at each level). It is canonical, cheap, and close in the plane is mostly close in memory.
namespace tinwright {

/// Whether `a` comes before `b` on the curve.
bool precedes_on_curve(Key2 a, Key2 b);

/// Puts a key's place on the curve and an index in one word, so that sorting words sorts both. Where the two
/// do not fit, the lowest bits of the coordinates are left out.
class CurvePacking {
  public:
    /// For keys with coordinates up to `largest` and indices below `count` (at most 2^32).
    CurvePacking(double largest, std::size_t count);

    [[nodiscard]] std::uint64_t pack(Key2 key, std::size_t index) const;
    [[nodiscard]] std::uint32_t index(std::uint64_t word) const {
        return static_cast<std::uint32_t>(word & ((std::uint64_t{1} << index_bits_) - 1));
    }
    /// Whether two words are told apart by their keys.
    [[nodiscard]] bool is_same_place(std::uint64_t a, std::uint64_t b) const {
        return (a ^ b) >> index_bits_ == 0;
    }
    /// Whether different keys always have different places.
    [[nodiscard]] bool is_complete() const { return dropped_ == 0; }
    /// Bits of a word in use.
    [[nodiscard]] int bits() const { return index_bits_ + place_bits_; }

  private:
    int index_bits_;
    int place_bits_;
    int dropped_;
};

/// Sorts different words of at most `bits` bits. `scratch` has the same size; what it holds afterwards is
/// unspecified. Most significant digits first, O(n) a digit; parallel inside the caller's task arena.
void sort_words(std::span<std::uint64_t> words, std::span<std::uint64_t> scratch, int bits);

/// Sorts packed words of keys along the curve, equal keys by index: `sort_words`, then the runs that packing
/// could not tell apart by `key_of(index)`.
template <class KeyOf>
void sort_packed(std::span<std::uint64_t> words, std::span<std::uint64_t> scratch,
                 const CurvePacking& packing, const KeyOf& key_of) {
    sort_words(words, scratch, packing.bits());
    if (packing.is_complete()) {
        return;
    }
    for (auto first = words.begin(); first != words.end();) {
        auto last = first + 1;
        while (last != words.end() && packing.is_same_place(*first, *last)) {
            ++last;
        }
        if (last - first > 1) {
            std::sort(first, last, [&](std::uint64_t a, std::uint64_t b) {
                const Key2 p = key_of(packing.index(a));
                const Key2 q = key_of(packing.index(b));
                return p == q ? a < b : precedes_on_curve(p, q);
            });
        }
        first = last;
    }
}

/// Indices of `keys` (fewer than 2^32) sorted along the curve; equal keys by ascending index.
/// O(n) for scattered keys, parallel inside the caller's task arena. Scratch: 16 bytes a key.
std::vector<std::uint32_t> sort_along_curve(std::span<const Key2> keys);

/// Where the curve first divides a sorted range: the first index whose key lies in the upper half of the
/// smallest aligned cell that holds the whole range, and the axis (0: x, 1: y) that divides it.
struct CurveSplit {
    std::size_t middle = 0;
    int axis = 0;
};

/// `keys`: two or more distinct keys in curve order. O(log n).
CurveSplit find_curve_split(std::span<const Key2> keys);

}  // namespace tinwright

#endif
