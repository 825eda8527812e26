#include "tinwright/io/coordinate_transform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/proj_handles.hpp"
#include "tinwright/io/transform_choice.hpp"

namespace tinwright::io {
namespace {

/// Points handed to PROJ at a time: those of a block and their copies stay in the processor's cache.
constexpr std::size_t kBlock = 1024;
/// Blocks between two reports of progress.
constexpr std::size_t kBlocksPerReport = 256;

/// PROJ's objects of one thread.
struct ThreadWay {
    ProjContext context;
    ProjObject way;  // after its context: destroyed before it
};

}  // namespace

struct CoordinateTransform::State {
    State(const Crs& from, const Crs& to, const TransformOptions& options)
        : has_elevations(options.has_elevations),
          epoch(options.epoch.value_or(HUGE_VAL)),
          context(proj_context_create()) {
        // What goes wrong is told in the exceptions, and points one by one.
        proj_log_level(context.get(), PJ_LOG_NONE);
        choice = choose_transform(context.get(), from, to, options);
    }

    /// The calling thread's own.
    PJ* way() {
        ThreadWay& own = ways.local();
        if (!own.way) {
            own.context.reset(proj_context_create());
            proj_log_level(own.context.get(), PJ_LOG_NONE);
            const std::scoped_lock lock(cloning);
            own.way.reset(proj_clone(own.context.get(), choice.way.get()));
            if (!own.way) {
                throw InputError("PROJ cannot copy the operation " + choice.name);
            }
        }
        return own.way.get();
    }

    /// Transforms one block; appends the positions, counted from `first`, of points that cannot be.
    void transform_block(PJ* own, PJ_DIRECTION direction, std::span<Point3> points, std::size_t first,
                         std::vector<std::size_t>& failed) const;
    std::vector<std::size_t> transform(PJ_DIRECTION direction, std::span<Point3> points,
                                       const Progress& progress);
    void transform(PJ_DIRECTION direction, std::span<Point2> positions);

    bool has_elevations;
    double epoch;  // HUGE_VAL is PROJ's word for none
    ProjContext context;
    TransformChoice choice;  // after its context: destroyed before it
    std::mutex cloning;
    tbb::enumerable_thread_specific<ThreadWay> ways;
};

void CoordinateTransform::State::transform_block(PJ* own, PJ_DIRECTION direction, std::span<Point3> points,
                                                 std::size_t first, std::vector<std::size_t>& failed) const {
    std::array<Point3, kBlock> before;  // NOLINT(cppcoreguidelines-pro-type-member-init): written below
    std::copy(points.begin(), points.end(), before.begin());
    const std::size_t count = points.size();
    double t = epoch;
    // Without elevations z stays out of it altogether: PROJ takes it for zero, and nothing is written.
    double* const z = has_elevations ? &points.front().z : nullptr;
    proj_trans_generic(own, direction, &points.front().x, sizeof(Point3), count, &points.front().y,
                       sizeof(Point3), count, z, sizeof(Point3), has_elevations ? count : 0, &t, 0, 1);
    for (std::size_t i = 0; i < count; ++i) {
        const Point3& point = points[i];
        if (!std::isfinite(point.x) || !std::isfinite(point.y) ||
            (has_elevations && !std::isfinite(point.z))) {
            points[i] = before[i];
            failed.push_back(first + i);
        }
    }
}

std::vector<std::size_t> CoordinateTransform::State::transform(PJ_DIRECTION direction,
                                                               std::span<Point3> points,
                                                               const Progress& progress) {
    std::vector<std::size_t> failed;
    constexpr std::size_t kPart = kBlock * kBlocksPerReport;
    for (std::size_t begin = 0; begin < points.size(); begin += kPart) {
        const std::size_t end = std::min(begin + kPart, points.size());
        std::array<std::vector<std::size_t>, kBlocksPerReport> failed_of_block;
        tbb::parallel_for(std::size_t{0}, (end - begin + kBlock - 1) / kBlock, [&](std::size_t block) {
            const std::size_t first = begin + block * kBlock;
            transform_block(way(), direction, points.subspan(first, std::min(kBlock, end - first)), first,
                            failed_of_block[block]);
        });
        for (const std::vector<std::size_t>& some : failed_of_block) {
            failed.insert(failed.end(), some.begin(), some.end());
        }
        report_progress(progress, static_cast<double>(end) / static_cast<double>(points.size()));
    }
    return failed;
}

void CoordinateTransform::State::transform(PJ_DIRECTION direction, std::span<Point2> positions) {
    if (positions.empty()) {
        return;
    }
    const std::size_t count = positions.size();
    double t = epoch;
    proj_trans_generic(way(), direction, &positions.front().x, sizeof(Point2), count, &positions.front().y,
                       sizeof(Point2), count, nullptr, 0, 0, &t, 0, 1);
    for (Point2& position : positions) {
        if (!std::isfinite(position.x) || !std::isfinite(position.y)) {
            position.x = std::numeric_limits<double>::quiet_NaN();
            position.y = position.x;
        }
    }
}

CoordinateTransform::CoordinateTransform(const Crs& from, const Crs& to, const TransformOptions& options)
    : state_(std::make_unique<State>(from, to, options)) {}
CoordinateTransform::~CoordinateTransform() = default;
CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;

std::vector<std::size_t> CoordinateTransform::forward(std::span<Point3> points,
                                                      const Progress& progress) const {
    return state_->transform(PJ_FWD, points, progress);
}

std::vector<std::size_t> CoordinateTransform::inverse(std::span<Point3> points,
                                                      const Progress& progress) const {
    return state_->transform(PJ_INV, points, progress);
}

void CoordinateTransform::forward(std::span<Point2> positions) const { state_->transform(PJ_FWD, positions); }

void CoordinateTransform::inverse(std::span<Point2> positions) const { state_->transform(PJ_INV, positions); }

std::string CoordinateTransform::operation() const { return state_->choice.name; }
std::optional<double> CoordinateTransform::accuracy() const { return state_->choice.accuracy; }
const std::string& CoordinateTransform::warning() const { return state_->choice.warning; }

}  // namespace tinwright::io
