#include "tinwright/optimal/edge_insertion.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <queue>
#include <type_traits>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/mesh/border.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/empty_triangle_search.hpp"
#include "tinwright/optimal/wedge_search.hpp"

namespace tinwright {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Asks now and then whether to stop: for time, or because the caller says so.
class Stopwatch {
  public:
    explicit Stopwatch(const OptimizeOptions& options)
        : start_(Clock::now()), budget_(options.budget_seconds), progress_(options.progress) {}

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }
    [[nodiscard]] StoppedBy stopped_by() const { return stopped_by_; }
    [[nodiscard]] bool has_stopped() const { return stopped_by_ != StoppedBy::Finished; }
    /// Whether to stop; `fraction` gives how much is done.
    template <class Fraction>
    bool is_over(const Fraction& fraction) {
        // A clock is slow next to most tries.
        constexpr unsigned kTriesBetween = 64;
        if (stopped_by_ != StoppedBy::Finished) {
            return true;
        }
        if (calls_++ % kTriesBetween == 0) {
            if (budget_ && seconds() >= *budget_) {
                stopped_by_ = StoppedBy::Budget;
            } else if (progress_ && !progress_(fraction())) {
                stopped_by_ = StoppedBy::Interrupt;
            }
        }
        return stopped_by_ != StoppedBy::Finished;
    }

  private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point start_;
    std::optional<double> budget_;
    const Progress& progress_;
    unsigned calls_ = 0;
    StoppedBy stopped_by_ = StoppedBy::Finished;
};

/// The search for edges to insert that a criterion's condition calls for.
template <FaceCriterion C>
struct SearchFor {
    using Type = internal::WedgeSearch;
};
template <WeakCriterion C>
struct SearchFor<C> {
    using Type = internal::EmptyTriangleSearch<C>;
};

/// Improves faces of one TIN under one criterion.
template <FaceCriterion C>
class Engine {
  public:
    Engine(Tin& tin, const C& criterion, const OptimizeOptions& options)
        : mesh_(tin.mesh),
          vertex_count_(tin.vertex_count()),
          criterion_(criterion),
          stopwatch_(options),
          measures_(tin.mesh.slot_count()),
          space_{tin.mesh, tin.keys, criterion_, measures_} {}

    OptimizeReport run(const Scope& scope);

  private:
    struct QueuedFace {
        double measure;
        FaceId face;
        /// Worst first, equal ones by face.
        friend bool operator<(const QueuedFace& a, const QueuedFace& b) {
            return a.measure != b.measure ? a.measure < b.measure : b.face < a.face;
        }
    };

    [[nodiscard]] double measure_of(FaceId f) const {
        const auto& [a, b, c] = mesh_.face(f).vertex;
        return criterion_.measure(a, b, c);
    }
    void measure_all();
    [[nodiscard]] WorstMeasures worst() const;
    [[nodiscard]] double measure_of_rank(std::size_t rank) const;

    bool improve(FaceId f, unsigned horizon = internal::kNoHorizon);
    void commit();
    void descend(double stop, bool only_worst);
    void descend_to_worst();
    void sweep_until_stable();
    void sweep(unsigned horizon);
    [[nodiscard]] bool has_run_away() const;
    void forget_tries_near(const std::vector<FaceId>& changed);

    /// A try of a face that failed.
    struct FailedTry {
        std::uint8_t reach = kNone;  ///< how deep it looked, `kFar` if that deep or deeper
        std::uint8_t ties = 0;       ///< measures met that equal the face's; 255 if as many or more
    };
    static constexpr std::uint8_t kNone = 0;  ///< there was none, or it does not count any more
    static constexpr std::uint8_t kFar = 255;

    TriangleMesh& mesh_;
    std::size_t vertex_count_;
    const C& criterion_;
    Stopwatch stopwatch_;
    LargeVector<double> measures_;
    LargeVector<FailedTry> tries_;  ///< the last one of each slot, for sweeps
    internal::SearchSpace<C> space_;
    typename SearchFor<C>::Type search_;
    OptimizeReport report_;
    FailedTry failed_;  ///< the last of all
};

template <FaceCriterion C>
void Engine<C>::measure_all() {
    constexpr std::uint32_t kGrain = 1U << 14U;
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(measures_.size()), kGrain),
        [this](const tbb::blocked_range<std::uint32_t>& range) {
            for (std::uint32_t f = range.begin(); f != range.end(); ++f) {
                measures_[f] = mesh_.is_terrain({f}) ? measure_of({f}) : kInfinity;
            }
        });
}

template <FaceCriterion C>
WorstMeasures Engine<C>::worst() const {
    double all = -kInfinity;
    double interior = -kInfinity;
    for (std::uint32_t f = 0; f < measures_.size(); ++f) {
        const double measure = measures_[f];
        if (measure == kInfinity) {
            continue;
        }
        all = std::max(all, measure);
        if (measure > interior && !is_on_border(mesh_, {f})) {
            interior = measure;
        }
    }
    WorstMeasures worst{criterion_.to_report(all), std::nullopt};
    if (interior != -kInfinity) {
        worst.interior = criterion_.to_report(interior);
    }
    return worst;
}

/// The measure of the terrain face of that rank, the worst having rank 1; the least one if there are fewer.
template <FaceCriterion C>
double Engine<C>::measure_of_rank(std::size_t rank) const {
    LargeVector<double> sorted;
    sorted.reserve(measures_.size());
    for (const double measure : measures_) {
        if (measure != kInfinity) {
            sorted.push_back(measure);
        }
    }
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(rank, sorted.size()) - 1);
    std::nth_element(sorted.begin(), place, sorted.end(), std::greater<>());
    return *place;
}

/// Tries to improve a face at its anchors, looking at most `horizon` faces deep. If it can be, commits, and
/// the new faces are in `search_.refill()`; else `failed_` tells of the try.
template <FaceCriterion C>
bool Engine<C>::improve(FaceId f, unsigned horizon) {
    const auto [a, b, c] = mesh_.face(f).vertex;
    const unsigned anchors = criterion_.anchors(a, b, c);
    ++report_.tries;
    internal::MeasureLimit limit(measures_[f.value]);
    unsigned reach = 1;
    bool is_cut_short = false;
    for (unsigned corner = 0; corner < 3; ++corner) {
        if ((anchors >> corner & 1U) == 0) {
            continue;
        }
        if (search_.find(space_, limit, f, corner, horizon)) {
            commit();
            return true;
        }
        reach = std::max(reach, search_.reach());
        is_cut_short = is_cut_short || search_.reach() > horizon;
    }
    failed_.reach = is_cut_short ? kNone : static_cast<std::uint8_t>(std::min<unsigned>(reach, kFar));
    failed_.ties = static_cast<std::uint8_t>(std::min<std::size_t>(limit.ties(), 255));
    return false;
}

template <FaceCriterion C>
void Engine<C>::commit() {
    const internal::Refill& refill = search_.refill();
    refill_cavity(mesh_, refill.slots, refill.faces);
    for (const FaceId slot : refill.slots) {
        measures_[slot.value] = measure_of(slot);
    }
    ++report_.insertions;
}

/// Improves faces worst first down to the measure `stop`; with `only_worst`, until one cannot be improved.
template <FaceCriterion C>
void Engine<C>::descend(double stop, bool only_worst) {
    std::vector<QueuedFace> entries;
    for (std::uint32_t f = 0; f < measures_.size(); ++f) {
        if (measures_[f] >= stop && measures_[f] != kInfinity) {
            entries.push_back({measures_[f], {f}});
        }
    }
    const std::size_t at_start = entries.size();
    std::priority_queue<QueuedFace> queue(std::less<QueuedFace>(), std::move(entries));
    std::size_t done = 0;
    while (!queue.empty()) {
        const QueuedFace worst = queue.top();
        queue.pop();
        if (measures_[worst.face.value] != worst.measure) {
            continue;  // its face is gone
        }
        if (stopwatch_.is_over([&] { return std::min(1.0, double(done) / double(at_start)); })) {
            return;
        }
        ++done;
        if (improve(worst.face)) {
            for (const FaceId slot : search_.refill().slots) {
                if (measures_[slot.value] >= stop) {
                    queue.push({measures_[slot.value], slot});
                }
            }
        } else {
            ++report_.frozen;
            report_.ties += failed_.ties;
            if (only_worst) {
                return;
            }
        }
    }
}

/// Improves the worst face until it cannot be. Few are touched, so few are queued at first.
template <FaceCriterion C>
void Engine<C>::descend_to_worst() {
    constexpr std::size_t kFirst = 256;
    constexpr std::size_t kGrowth = 16;
    for (std::size_t rank = kFirst; report_.frozen == 0; rank *= kGrowth) {
        descend(measure_of_rank(rank), true);
        if (stopwatch_.has_stopped()) {
            return;
        }
    }
}

/// Improves faces, each where it is met, until no face can be improved. That order is not the theorems', nor
/// are their bounds on the number of steps; but every step lowers the sorted vector, and where no face can be
/// improved the optimum is reached (docs/criteria.md, "Any order"). It is several times faster than worst
/// first, which wanders through all memory.
template <FaceCriterion C>
void Engine<C>::sweep_until_stable() {
    tries_.assign(measures_.size(), FailedTry{});
    if constexpr (WeakCriterion<C>) {
        // Most improvements are near, but most of the time goes into looking far: that is left for later.
        constexpr unsigned kNear = 4;
        sweep(kNear);
    }
    std::size_t insertions = 0;
    do {
        insertions = report_.insertions;
        sweep(internal::kNoHorizon);
    } while (insertions != report_.insertions && !has_run_away() && !stopwatch_.has_stopped());
    if (has_run_away() && !stopwatch_.has_stopped()) {
        descend(-kInfinity, false);
        return;
    }
    for (std::uint32_t f = 0; f < tries_.size(); ++f) {
        if (mesh_.is_terrain({f}) && tries_[f].reach != kNone) {
            ++report_.frozen;
            report_.ties += tries_[f].ties;
        }
    }
}

/// Whether sweeps take many more steps than ever seen on terrain, as on points around a circle or along two
/// lines: the theorems bound them when the worst face comes first.
template <FaceCriterion C>
bool Engine<C>::has_run_away() const {
    constexpr std::size_t kInsertionsPerVertex = 3;
    constexpr std::size_t kVisitsPerFace = 256;
    constexpr std::size_t kSmall = 1U << 16U;
    return report_.insertions > kInsertionsPerVertex * vertex_count_ + kSmall ||
           search_.visits() > kVisitsPerFace * measures_.size() + kSmall;
}

/// Tries every face that has to be, and the new ones where a try succeeds. Afterwards a failed try stands
/// unless what it looked at has changed since.
template <FaceCriterion C>
void Engine<C>::sweep(unsigned horizon) {
    std::vector<FaceId> changed;
    std::vector<FaceId> pending;
    for (std::uint32_t f = 0; f < measures_.size(); ++f) {
        if (tries_[f].reach != kNone || measures_[f] == kInfinity) {
            continue;
        }
        pending.push_back({f});
        while (!pending.empty()) {
            const FaceId face = pending.back();
            pending.pop_back();
            if (has_run_away() || stopwatch_.is_over([&] { return double(f) / double(measures_.size()); })) {
                return;
            }
            if (!improve(face, horizon)) {
                tries_[face.value] = failed_;
                continue;
            }
            for (const FaceId slot : search_.refill().slots) {
                tries_[slot.value] = {};
                changed.push_back(slot);
                pending.push_back(slot);
            }
        }
    }
    forget_tries_near(changed);
}

/// Forgets the tries that looked as deep as the nearest changed face is away, in steps from face to face: no
/// other can have seen a change.
template <FaceCriterion C>
void Engine<C>::forget_tries_near(const std::vector<FaceId>& changed) {
    constexpr std::uint8_t kUnseen = 255;
    LargeVector<std::uint8_t> distance(measures_.size(), kUnseen);
    std::vector<FaceId> level;
    for (const FaceId f : changed) {
        if (distance[f.value] == kUnseen) {
            distance[f.value] = 0;
            tries_[f.value] = {};
            level.push_back(f);
        }
    }
    if (level.empty()) {
        return;
    }
    std::vector<FaceId> next_level;
    for (std::uint8_t steps = 1; !level.empty() && steps < kFar; ++steps) {
        next_level.clear();
        for (const FaceId f : level) {
            for (const HalfEdgeId twin : mesh_.face(f).twin) {
                const FaceId g = face_of(twin);
                if (distance[g.value] != kUnseen || measures_[g.value] == kInfinity) {
                    continue;
                }
                distance[g.value] = steps;
                next_level.push_back(g);
                if (tries_[g.value].reach >= steps) {
                    tries_[g.value] = {};
                }
            }
        }
        std::swap(level, next_level);
    }
    for (FailedTry& failed : tries_) {
        if (failed.reach == kFar) {
            failed = {};
        }
    }
}

template <FaceCriterion C>
OptimizeReport Engine<C>::run(const Scope& scope) {
    measure_all();
    report_.before = worst();
    switch (scope.kind) {
        case Scope::Kind::Max:
            descend_to_worst();
            break;
        case Scope::Kind::Vector:
            sweep_until_stable();
            break;
        case Scope::Kind::Top: {
            const auto faces = static_cast<double>(mesh_.count_terrain());
            const double rank = std::max(1.0, std::ceil(scope.value / 100 * faces));
            descend(measure_of_rank(static_cast<std::size_t>(rank)), false);
            break;
        }
        case Scope::Kind::Above:
            descend(std::nextafter(criterion_.from_report(scope.value), kInfinity), false);
            break;
    }
    report_.after = worst();
    report_.candidates = search_.candidates();
    report_.stopped_by = stopwatch_.stopped_by();
    if (report_.stopped_by == StoppedBy::Finished && report_.frozen > 0) {
        report_.proof = report_.ties > 0 ? Proof::Tested : Proof::Theorem;
    }
    report_.seconds = stopwatch_.seconds();
    return report_;
}

}  // namespace

OptimizeReport optimize(Tin& tin, const OptimizeOptions& options) {
    return visit_criterion(options.criterion, tin, [&](const FaceCriterion auto& criterion) {
        return Engine(tin, criterion, options).run(options.scope);
    });
}

}  // namespace tinwright
