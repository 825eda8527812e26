#include "tinwright/geometry/curve.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

namespace tinwright {

namespace {

using Bits = std::uint64_t;

Bits bits(double key) { return static_cast<Bits>(key); }

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

struct CodedIndex {
    Bits code;
    std::uint32_t index;
};

bool precedes_coded(const CodedIndex& a, const CodedIndex& b) {
    return a.code < b.code || (a.code == b.code && a.index < b.index);
}

// Most significant digit first; each level moves the items to the other buffer, so that `items` holds the
// result when `in_place`, else `other` does. Stable, hence equal codes stay in index order.
void sort_codes(CodedIndex* items, CodedIndex* other, std::size_t count, bool in_place) {
    constexpr std::size_t kSmall = 48;
    Bits differing = 0;
    for (std::size_t i = 1; i < count; ++i) {
        differing |= items[i].code ^ items[0].code;
    }
    if (differing == 0 || count <= kSmall) {
        if (differing != 0) {
            for (std::size_t i = 1; i < count; ++i) {
                const CodedIndex item = items[i];
                std::size_t hole = i;
                for (; hole > 0 && precedes_coded(item, items[hole - 1]); --hole) {
                    items[hole] = items[hole - 1];
                }
                items[hole] = item;
            }
        }
        if (!in_place) {
            std::copy_n(items, count, other);
        }
        return;
    }
    const int top = width_of(differing);
    const int width = std::min({8, top, width_of(count) - 2});
    const int shift = top - width;
    const std::size_t mask = (std::size_t{1} << width) - 1;
    std::array<std::size_t, 257> start{};
    for (std::size_t i = 0; i < count; ++i) {
        ++start[((items[i].code >> shift) & mask) + 1];
    }
    for (std::size_t digit = 0; digit <= mask; ++digit) {
        start[digit + 1] += start[digit];
    }
    std::array<std::size_t, 256> next{};
    std::copy_n(start.begin(), mask + 1, next.begin());
    for (std::size_t i = 0; i < count; ++i) {
        other[next[(items[i].code >> shift) & mask]++] = items[i];
    }
    for (std::size_t digit = 0; digit <= mask; ++digit) {
        const std::size_t first = start[digit];
        const std::size_t size = start[digit + 1] - first;
        if (size != 0) {
            sort_codes(other + first, items + first, size, !in_place);
        }
    }
}

constexpr std::size_t kGrain = 1U << 14U;

// Distributes by the top digit in parallel (counts by block of input, so the result does not depend on
// the schedule), then sorts the buckets in parallel. The result is in `items`.
void sort_codes_in_parallel(CodedIndex* items, CodedIndex* other, std::size_t count, int top) {
    const int width = std::min(11, top);
    const int shift = top - width;
    const std::size_t buckets = std::size_t{1} << width;
    const std::size_t blocks = (count + kGrain * 4 - 1) / (kGrain * 4);
    const auto block_begin = [&](std::size_t block) { return block * count / blocks; };
    std::vector<std::size_t> next(blocks * buckets);
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        std::size_t* mine = next.data() + block * buckets;
        for (std::size_t i = block_begin(block); i < block_begin(block + 1); ++i) {
            ++mine[items[i].code >> shift];
        }
    });
    std::vector<std::size_t> start(buckets + 1);
    std::size_t sum = 0;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        start[bucket] = sum;
        for (std::size_t block = 0; block < blocks; ++block) {
            sum += std::exchange(next[block * buckets + bucket], sum);
        }
    }
    start[buckets] = sum;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        std::size_t* mine = next.data() + block * buckets;
        for (std::size_t i = block_begin(block); i < block_begin(block + 1); ++i) {
            other[mine[items[i].code >> shift]++] = items[i];
        }
    });
    tbb::parallel_for(std::size_t{0}, buckets, [&](std::size_t bucket) {
        const std::size_t first = start[bucket];
        const std::size_t size = start[bucket + 1] - first;
        if (size != 0) {
            sort_codes(other + first, items + first, size, false);
        }
    });
}

}  // namespace

bool precedes_on_curve(Key2 a, Key2 b) {
    const Bits x = bits(a.x) ^ bits(b.x);
    const Bits y = bits(a.y) ^ bits(b.y);
    return has_lower_top_bit(x, y) ? a.y < b.y : a.x < b.x;
}

std::vector<std::uint32_t> sort_along_curve(std::span<const Key2> keys) {
    const std::size_t count = keys.size();
    const Bits all = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, kGrain), Bits{0},
        [&](const tbb::blocked_range<std::size_t>& range, Bits seen) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                seen |= bits(keys[i].x) | bits(keys[i].y);
            }
            return seen;
        },
        [](Bits a, Bits b) { return a | b; });
    // Codes hold the upper 32 bits of wider keys; runs of equal codes are then sorted by the keys.
    const int key_bits = width_of(all);
    const int dropped = std::max(0, key_bits - 32);

    const auto items = std::make_unique_for_overwrite<CodedIndex[]>(count);
    const auto other = std::make_unique_for_overwrite<CodedIndex[]>(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              const Bits x = spread(bits(keys[i].x) >> dropped);
                              const Bits y = spread(bits(keys[i].y) >> dropped);
                              items[i] = {x << 1U | y, static_cast<std::uint32_t>(i)};
                          }
                      });
    sort_codes_in_parallel(items.get(), other.get(), count, 2 * (key_bits - dropped));

    std::vector<std::uint32_t> order(count);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              order[i] = items[i].index;
                          }
                      });
    if (dropped > 0) {
        for (std::size_t first = 0; first < count;) {
            std::size_t last = first + 1;
            while (last < count && items[last].code == items[first].code) {
                ++last;
            }
            std::sort(order.begin() + static_cast<std::ptrdiff_t>(first),
                      order.begin() + static_cast<std::ptrdiff_t>(last),
                      [&](std::uint32_t a, std::uint32_t b) {
                          return keys[a] == keys[b] ? a < b : precedes_on_curve(keys[a], keys[b]);
                      });
            first = last;
        }
    }
    return order;
}

CurveSplit find_curve_split(std::span<const Key2> keys) {
    const Key2 first = keys.front();
    const Key2 last = keys.back();
    const Bits x = bits(first.x) ^ bits(last.x);
    const Bits y = bits(first.y) ^ bits(last.y);
    const int axis = has_lower_top_bit(x, y) ? 1 : 0;
    // The upper half begins where the highest differing bit of that axis turns one.
    const Bits top = std::bit_floor(axis == 1 ? y : x);
    const Bits bound = bits(axis == 1 ? last.y : last.x) & ~(top - 1);
    const auto limit = static_cast<double>(bound);
    const auto middle = std::partition_point(
        keys.begin(), keys.end(), [&](const Key2& key) { return (axis == 1 ? key.y : key.x) < limit; });
    return {static_cast<std::size_t>(middle - keys.begin()), axis};
}

}  // namespace tinwright
