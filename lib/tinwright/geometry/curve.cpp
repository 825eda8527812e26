#include "tinwright/geometry/curve.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include <tbb/parallel_for.h>

namespace tinwright {

namespace {

using Bits = std::uint64_t;

Bits bits_of(double key) { return static_cast<Bits>(key); }

int width_of(Bits value) { return static_cast<int>(std::bit_width(value)); }

// Whether the highest set bit of `a` is below that of `b`.
bool has_lower_top_bit(Bits a, Bits b) { return a < b && a < (a ^ b); }

// Moves the low 32 bits of `value` to the even bit positions.
Bits spread(Bits value) {
    value &= 0xFFFFFFFFU;
    value = (value | value << 16U) & 0x0000FFFF0000FFFFU;
    value = (value | value << 8U) & 0x00FF00FF00FF00FFU;
    value = (value | value << 4U) & 0x0F0F0F0F0F0F0F0FU;
    value = (value | value << 2U) & 0x3333333333333333U;
    return (value | value << 1U) & 0x5555555555555555U;
}

// Most significant digit first; each level moves the words to the other buffer, so that `words` holds the
// result when `in_place`, else `other` does.
void sort_digits(Bits* words, Bits* other, std::size_t count, bool in_place) {
    constexpr std::size_t kSmall = 32;
    if (count <= kSmall) {
        Bits* const sorted = in_place ? words : other;
        for (std::size_t i = 0; i < count; ++i) {
            const Bits word = words[i];
            std::size_t hole = i;
            for (; hole > 0 && word < sorted[hole - 1]; --hole) {
                sorted[hole] = sorted[hole - 1];
            }
            sorted[hole] = word;
        }
        return;
    }
    Bits differing = 0;
    for (std::size_t i = 1; i < count; ++i) {
        differing |= words[i] ^ words[0];
    }
    const int top = width_of(differing);
    const int width = std::min({8, top, width_of(count) - 2});
    const int shift = top - width;
    const std::size_t mask = (std::size_t{1} << width) - 1;
    std::array<std::uint32_t, 257> start{};
    for (std::size_t i = 0; i < count; ++i) {
        ++start[((words[i] >> shift) & mask) + 1];
    }
    for (std::size_t digit = 0; digit <= mask; ++digit) {
        start[digit + 1] += start[digit];
    }
    std::array<std::uint32_t, 256> next{};
    std::copy_n(start.begin(), mask + 1, next.begin());
    for (std::size_t i = 0; i < count; ++i) {
        other[next[(words[i] >> shift) & mask]++] = words[i];
    }
    for (std::size_t digit = 0; digit <= mask; ++digit) {
        const std::size_t first = start[digit];
        const std::size_t size = start[digit + 1] - first;
        if (size != 0) {
            sort_digits(other + first, words + first, size, !in_place);
        }
    }
}

constexpr std::size_t kBlock = 1U << 16U;  // words a task

}  // namespace

bool precedes_on_curve(Key2 a, Key2 b) {
    const Bits x = bits_of(a.x) ^ bits_of(b.x);
    const Bits y = bits_of(a.y) ^ bits_of(b.y);
    return has_lower_top_bit(x, y) ? a.y < b.y : a.x < b.x;
}

CurvePacking::CurvePacking(double largest, std::size_t count) : index_bits_(width_of(count)) {
    const int key_bits = width_of(bits_of(largest));
    const int kept = std::min({key_bits, (64 - index_bits_) / 2, 32});
    place_bits_ = 2 * kept;
    dropped_ = key_bits - kept;
}

std::uint64_t CurvePacking::pack(Key2 key, std::size_t index) const {
    const Bits place = spread(bits_of(key.x) >> dropped_) << 1U | spread(bits_of(key.y) >> dropped_);
    return place << index_bits_ | index;
}

// Distributes by the top digit in parallel (counts by block of input, so the result does not depend on
// the schedule), then sorts the buckets in parallel.
void sort_words(std::span<std::uint64_t> words, std::span<std::uint64_t> scratch, int bits) {
    const std::size_t count = words.size();
    const int width = std::min(11, bits);
    const int shift = bits - width;
    const std::size_t buckets = std::size_t{1} << width;
    const std::size_t blocks = (count + kBlock - 1) / kBlock;
    std::vector<std::size_t> next(blocks * buckets);
    const auto for_blocks = [&](const auto& visit) {
        tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
            std::size_t* mine = next.data() + block * buckets;
            for (const Bits word : words.subspan(block * kBlock, std::min(kBlock, count - block * kBlock))) {
                visit(mine[word >> shift], word);
            }
        });
    };
    for_blocks([](std::size_t& size, Bits /*word*/) { ++size; });
    std::vector<std::size_t> start(buckets + 1);
    std::size_t sum = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        start[bucket] = sum;
        for (std::size_t block = 0; block < blocks; ++block) {
            sum += std::exchange(next[block * buckets + bucket], sum);
        }
    }
    start[buckets] = sum;
    for_blocks([&](std::size_t& place, Bits word) { scratch[place++] = word; });
    tbb::parallel_for(std::size_t{0}, buckets, [&](std::size_t bucket) {
        const std::size_t first = start[bucket];
        const std::size_t size = start[bucket + 1] - first;
        if (size != 0) {
            sort_digits(scratch.data() + first, words.data() + first, size, false);
        }
    });
}

std::vector<std::uint32_t> sort_along_curve(std::span<const Key2> keys) {
    const std::size_t count = keys.size();
    double largest = 0;
    for (const Key2& key : keys) {
        largest = std::max({largest, key.x, key.y});
    }
    const CurvePacking packing(largest, count);
    std::vector<Bits> words(count);
    std::vector<Bits> scratch(count);
    for (std::size_t i = 0; i < count; ++i) {
        words[i] = packing.pack(keys[i], i);
    }
    sort_packed(words, scratch, packing, [&](std::uint32_t i) { return keys[i]; });
    std::vector<std::uint32_t> order(count);
    std::transform(words.begin(), words.end(), order.begin(), [&](Bits word) { return packing.index(word); });
    return order;
}

CurveSplit find_curve_split(std::span<const Key2> keys) {
    const Key2 first = keys.front();
    const Key2 last = keys.back();
    const Bits x = bits_of(first.x) ^ bits_of(last.x);
    const Bits y = bits_of(first.y) ^ bits_of(last.y);
    const int axis = has_lower_top_bit(x, y) ? 1 : 0;
    // The upper half begins where the highest differing bit of that axis turns one.
    const Bits top = std::bit_floor(axis == 1 ? y : x);
    const auto limit = static_cast<double>(bits_of(axis == 1 ? last.y : last.x) & ~(top - 1));
    const double Key2::*coordinate = axis == 1 ? &Key2::y : &Key2::x;
    // Most ranges are short: halve the long ones only.
    constexpr std::size_t kShort = 12;
    std::size_t low = 1;  // the first key is in the lower half, the last in the upper one
    for (std::size_t high = keys.size() - 1; high - low > kShort;) {
        const std::size_t middle = low + (high - low) / 2;
        if (keys[middle].*coordinate < limit) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    while (keys[low].*coordinate < limit) {
        ++low;
    }
    return {low, axis};
}

}  // namespace tinwright
