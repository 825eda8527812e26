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

bool precedes_in_code(const CurveItem& a, const CurveItem& b) {
    return a.code < b.code || (a.code == b.code && a.index < b.index);
}

// Most significant digit first; each level moves the items to the other buffer, so that `items` holds the
// result when `in_place`, else `other` does. Stable, hence equal codes stay in index order.
void sort_codes(CurveItem* items, CurveItem* other, std::size_t count, bool in_place) {
    constexpr std::size_t kSmall = 48;
    Bits differing = 0;
    for (std::size_t i = 1; i < count; ++i) {
        differing |= items[i].code ^ items[0].code;
    }
    if (differing == 0 || count <= kSmall) {
        if (differing != 0) {
            for (std::size_t i = 1; i < count; ++i) {
                const CurveItem item = items[i];
                std::size_t hole = i;
                for (; hole > 0 && precedes_in_code(item, items[hole - 1]); --hole) {
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
void sort_codes_in_parallel(CurveItem* items, CurveItem* other, std::size_t count, int top) {
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

int curve_bits_dropped(double largest) { return std::max(0, width_of(bits(largest)) - 32); }

std::uint64_t curve_code(Key2 key, int dropped) {
    return spread(bits(key.x) >> dropped) << 1U | spread(bits(key.y) >> dropped);
}

int curve_code_bits(double largest) { return 2 * std::min(width_of(bits(largest)), 32); }

void sort_curve_items(std::span<CurveItem> items, std::span<CurveItem> scratch, int code_bits) {
    sort_codes_in_parallel(items.data(), scratch.data(), items.size(), code_bits);
}

std::vector<std::uint32_t> sort_along_curve(std::span<const Key2> keys) {
    const std::size_t count = keys.size();
    double largest = 0;
    for (const Key2& key : keys) {
        largest = std::max({largest, key.x, key.y});
    }
    const int dropped = curve_bits_dropped(largest);
    std::vector<CurveItem> items(count);
    std::vector<CurveItem> scratch(count);
    for (std::size_t i = 0; i < count; ++i) {
        items[i] = {curve_code(keys[i], dropped), static_cast<std::uint32_t>(i)};
    }
    sort_curve_items(items, scratch, curve_code_bits(largest));
    // Codes of wide keys are cut short: runs of equal ones are ordered by the keys themselves.
    for (auto first = items.begin(); dropped > 0 && first != items.end();) {
        const auto last =
            std::find_if(first, items.end(), [&](const CurveItem& i) { return i.code != first->code; });
        std::sort(first, last, [&](const CurveItem& a, const CurveItem& b) {
            return keys[a.index] == keys[b.index] ? a.index < b.index
                                                  : precedes_on_curve(keys[a.index], keys[b.index]);
        });
        first = last;
    }
    std::vector<std::uint32_t> order(count);
    std::transform(items.begin(), items.end(), order.begin(),
                   [](const CurveItem& item) { return item.index; });
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
