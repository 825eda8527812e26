#include "tinwright/surface/contour_sites.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"

namespace tinwright {

template <class PointOf>
void ContourSites::fill(const PointOf& point_of) {
    constexpr std::size_t kGrain = 4096;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, sites_.size(), kGrain), [&](const auto& part) {
        for (std::size_t v = part.begin(); v < part.end(); ++v) {
            const Point3 p = point_of(v);
            const auto low = std::lower_bound(levels_.begin(), levels_.end(), p.z);
            const bool is_at = low != levels_.end() && *low == p.z;
            const auto below = static_cast<std::uint32_t>(low - levels_.begin());
            below_[v] = below;
            sites_[v] = {p.x, p.y, p.z, below, below + (is_at ? 1U : 0U)};
        }
    });
}

ContourSites::ContourSites(const Tin& tin, std::span<const double> levels)
    : sites_(tin.vertex_count()), below_(tin.vertex_count()), levels_(levels) {
    fill([&tin](std::size_t v) { return tin.position({static_cast<std::uint32_t>(v)}); });
}

ContourSites::ContourSites(std::span<const Point3> vertices, std::span<const double> levels)
    : sites_(vertices.size()), below_(vertices.size()), levels_(levels) {
    fill([&vertices](std::size_t v) { return vertices[v]; });
}

void require_few_crossings(std::size_t count) {
    constexpr std::size_t kLimit = 200'000'000;
    if (count > kLimit) {
        throw UsageError(
            "contours would cross faces more than 200 million times: choose a larger interval or fewer "
            "levels");
    }
}

LevelLists list_by_level(std::span<const LevelRange> ranges, std::size_t levels) {
    LevelLists lists;
    // Differences of the counts first: where ranges begin and end.
    std::vector<std::int64_t> change(levels + 1);
    for (const LevelRange& range : ranges) {
        if (range.first < range.last) {
            ++change[range.first];
            --change[range.last];
        }
    }
    lists.begin.resize(levels + 1);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < levels; ++i) {
        count += change[i];
        lists.begin[i + 1] = lists.begin[i] + static_cast<std::size_t>(count);
    }
    require_few_crossings(lists.begin.back());
    lists.items.resize(lists.begin.back());
    // Each task fills the lists of some levels and looks at all items for it.
    const auto tasks = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
        const auto bound = [&](std::size_t part) {
            const std::size_t entries = lists.items.size() * part / tasks;
            const auto at = std::lower_bound(lists.begin.begin(), lists.begin.end(), entries);
            return part == tasks ? levels : static_cast<std::size_t>(at - lists.begin.begin());
        };
        const auto low = static_cast<std::uint32_t>(bound(task));
        const auto high = static_cast<std::uint32_t>(bound(task + 1));
        if (low >= high) {
            return;
        }
        std::vector<std::size_t> next(lists.begin.begin() + low, lists.begin.begin() + high);
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            const std::uint32_t end = std::min(ranges[i].last, high);
            for (std::uint32_t level = std::max(ranges[i].first, low); level < end; ++level) {
                lists.items[next[level - low]++] = static_cast<std::uint32_t>(i);
            }
        }
    });
    return lists;
}

LargeVector<LevelRange> crossed_levels(const TriangleMesh& mesh, const ContourSites& sites) {
    LargeVector<LevelRange> ranges(mesh.slot_count());
    constexpr std::size_t kGrain = 4096;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, ranges.size(), kGrain), [&](const auto& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
            const FaceId f{static_cast<std::uint32_t>(i)};
            if (!mesh.is_terrain(f)) {
                ranges[i] = {0, 0};
                continue;
            }
            const std::uint32_t a = sites.below(mesh.vertex(f, 0));
            const std::uint32_t b = sites.below(mesh.vertex(f, 1));
            const std::uint32_t c = sites.below(mesh.vertex(f, 2));
            ranges[i] = {std::min({a, b, c}), std::max({a, b, c})};
        }
    });
    return ranges;
}

}  // namespace tinwright
