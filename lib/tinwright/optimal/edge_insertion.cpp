#include "tinwright/optimal/edge_insertion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/large_vector.hpp"
#include "tinwright/mesh/border.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/empty_triangle_search.hpp"
#include "tinwright/optimal/stopwatch.hpp"
#include "tinwright/optimal/wedge_search.hpp"

namespace tinwright {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

    /// Faces worst first: those of a sorted list, and those added since.
    class Queue {
      public:
        explicit Queue(std::vector<QueuedFace> list) : list_(std::move(list)) {}

        [[nodiscard]] bool is_empty() const { return done_ == list_.size() && added_.empty(); }
        void push(QueuedFace face) { added_.push(face); }
        QueuedFace pop() {
            if (done_ < list_.size() && (added_.empty() || added_.top() < list_[done_])) {
                return list_[done_++];
            }
            const QueuedFace worst = added_.top();
            added_.pop();
            return worst;
        }
        [[nodiscard]] const std::vector<QueuedFace>& list() const { return list_; }
        /// Faces of the list that were popped.
        [[nodiscard]] std::size_t done() const { return done_; }

      private:
        std::vector<QueuedFace> list_;
        std::size_t done_ = 0;
        std::priority_queue<QueuedFace> added_;
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
    [[nodiscard]] bool is_hopeful(FaceId f, double stop) const;
    [[nodiscard]] std::vector<QueuedFace> list_hopeful(double stop) const;
    void descend(double stop, bool only_worst);
    void prefetch(const std::vector<QueuedFace>& list, std::size_t place) const;
    void descend_to_worst();
    void optimize_all();
    [[nodiscard]] bool has_run_away() const;
    void sweep(unsigned horizon);
    void forget_tries_near_changes();

    /// A try of a face that failed.
    struct FailedTry {
        std::uint8_t reach = kNone;  ///< how deep it looked
        std::uint16_t ties = 0;      ///< measures met that equal the face's, or the greatest number
    };
    static constexpr std::uint8_t kNone = 0;   ///< there was none, or what it saw may have changed
    static constexpr std::uint8_t kFar = 255;  ///< that deep or deeper

    TriangleMesh& mesh_;
    std::size_t vertex_count_;
    const C& criterion_;
    internal::Stopwatch stopwatch_;
    LargeVector<double> measures_;
    LargeVector<FailedTry> tries_;  ///< the last of each slot, if it stands
    std::vector<FaceId> changed_;   ///< new faces of the last sweep, some of them more than once
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
    for (unsigned corner = 0; corner < 3; ++corner) {
        if ((anchors >> corner & 1U) == 0) {
            continue;
        }
        if (search_.find(space_, limit, f, corner, horizon)) {
            commit();
            return true;
        }
        reach = std::max(reach, search_.reach());
    }
    failed_.reach = reach > horizon ? kNone : static_cast<std::uint8_t>(std::min<unsigned>(reach, kFar));
    failed_.ties = static_cast<std::uint16_t>(std::min<std::size_t>(limit.ties(), 0xFFFF));
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

/// Whether a face of measure `stop` or more may be improvable: what has no anchor cannot [tan1993,
/// Lemma 4.5].
template <FaceCriterion C>
bool Engine<C>::is_hopeful(FaceId f, double stop) const {
    const double measure = measures_[f.value];
    const auto& [a, b, c] = mesh_.face(f).vertex;
    return measure >= stop && measure != kInfinity && criterion_.anchors(a, b, c) != 0;
}

/// The faces that may be improvable, worst first.
template <FaceCriterion C>
std::vector<typename Engine<C>::QueuedFace> Engine<C>::list_hopeful(double stop) const {
    std::vector<QueuedFace> list;
    for (std::uint32_t f = 0; f < measures_.size(); ++f) {
        if (is_hopeful({f}, stop)) {
            list.push_back({measures_[f], {f}});
        }
    }
    std::sort(list.begin(), list.end(), [](const QueuedFace& a, const QueuedFace& b) { return b < a; });
    return list;
}

/// Improves faces worst first down to the measure `stop`; with `only_worst`, until one cannot be improved.
template <FaceCriterion C>
void Engine<C>::descend(double stop, bool only_worst) {
    Queue queue(list_hopeful(stop));
    while (!queue.is_empty()) {
        const QueuedFace worst = queue.pop();
        prefetch(queue.list(), queue.done());
        if (measures_[worst.face.value] != worst.measure) {
            continue;  // its face is gone
        }
        if (stopwatch_.is_over(queue.done(), queue.list().size(), search_.visits())) {
            return;
        }
        if (improve(worst.face)) {
            for (const FaceId face : search_.refill().slots) {
                if (is_hopeful(face, stop)) {
                    queue.push({measures_[face.value], face});
                }
            }
            continue;
        }
        ++report_.frozen;
        report_.ties += failed_.ties;
        if (only_worst) {
            return;
        }
    }
    // Whatever is left cannot be improved, be it tried or without an anchor.
    const auto left = std::count_if(measures_.begin(), measures_.end(), [stop](double measure) {
        return measure >= stop && measure != kInfinity;
    });
    report_.frozen = only_worst ? (left > 0 ? 1 : 0) : static_cast<std::size_t>(left);
}

/// Fetches what the tries of faces some places down the list will read: they lie all over memory.
template <FaceCriterion C>
void Engine<C>::prefetch(const std::vector<QueuedFace>& list, std::size_t place) const {
    constexpr std::size_t kAhead = 12;
    constexpr std::size_t kSoon = 6;
    if (place + kAhead < list.size()) {
        __builtin_prefetch(&mesh_.face(list[place + kAhead].face));
        __builtin_prefetch(&measures_[list[place + kAhead].face.value]);
    }
    if (place + kSoon < list.size()) {
        const TriangleMesh::Face& face = mesh_.face(list[place + kSoon].face);
        for (unsigned i = 0; i < 3; ++i) {
            __builtin_prefetch(&space_.keys[face.vertex[i].value]);
            __builtin_prefetch(&mesh_.face(face_of(face.twin[i])));
            __builtin_prefetch(&measures_[face_of(face.twin[i]).value]);
        }
    }
}

/// Improves the worst face until it cannot be. Few are touched, so few are queued at first.
template <FaceCriterion C>
void Engine<C>::descend_to_worst() {
    constexpr std::size_t kFirst = 256;
    constexpr std::size_t kGrowth = 16;
    for (std::size_t rank = kFirst; report_.frozen == 0 && !stopwatch_.has_stopped();
         rank = std::min(rank * kGrowth, measures_.size())) {
        descend(measure_of_rank(rank), true);
    }
}

/// Improves faces, each where it is met, until none can be. That order is not the theorems', but it does not
/// wander through all memory, every step lowers the sorted vector, and where no face can be improved the
/// optimum is reached (docs/criteria.md, "Any order").
template <FaceCriterion C>
void Engine<C>::optimize_all() {
    // Most improvements are near, but most time goes into looking far: that is left for later.
    constexpr unsigned kNear = WeakCriterion<C> ? 4 : internal::kNoHorizon;
    double done = 0;
    for (unsigned sweeps = 0; sweeps < 2 || !changed_.empty(); ++sweeps) {
        // After the first sweep nearly everything has changed: finding what has not would not pay.
        if (sweeps < 2) {
            tries_.assign(measures_.size(), FailedTry{});
        } else {
            forget_tries_near_changes();
        }
        stopwatch_.set_stage(done, (1 + done) / 2);
        done = (1 + done) / 2;
        sweep(sweeps == 0 ? kNear : internal::kNoHorizon);
        if (has_run_away()) {
            descend(-kInfinity, false);
            return;
        }
        if (stopwatch_.has_stopped()) {
            return;
        }
    }
    report_.frozen = mesh_.count_terrain();
    for (const FailedTry& failed : tries_) {
        report_.ties += failed.ties;
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

/// Tries every face without a failed try that stands, looking at most `horizon` faces deep, and the new ones
/// where a try succeeds: `changed_`.
template <FaceCriterion C>
void Engine<C>::sweep(unsigned horizon) {
    std::vector<FaceId> pending;
    changed_.clear();
    for (std::uint32_t f = 0; f < measures_.size(); ++f) {
        if (tries_[f].reach != kNone || measures_[f] == kInfinity) {
            continue;
        }
        pending.push_back({f});
        while (!pending.empty()) {
            const FaceId face = pending.back();
            pending.pop_back();
            if (has_run_away() || stopwatch_.is_over(f, measures_.size(), search_.visits())) {
                return;
            }
            if (!improve(face, horizon)) {
                tries_[face.value] = failed_;
                continue;
            }
            for (const FaceId slot : search_.refill().slots) {
                changed_.push_back(slot);
                pending.push_back(slot);
            }
        }
    }
}

/// Forgets the tries that looked as deep as the nearest changed face is away, in steps from face to face: no
/// other can have seen a change.
template <FaceCriterion C>
void Engine<C>::forget_tries_near_changes() {
    LargeVector<std::uint8_t> is_seen(measures_.size(), 0);
    std::vector<FaceId> level;
    for (const FaceId f : changed_) {
        tries_[f.value] = {};
        if (is_seen[f.value] == 0) {
            is_seen[f.value] = 1;
            level.push_back(f);
        }
    }
    std::vector<FaceId> next_level;
    for (unsigned steps = 1; steps < kFar && !level.empty(); ++steps) {
        next_level.clear();
        for (const FaceId f : level) {
            for (const HalfEdgeId twin : mesh_.face(f).twin) {
                const FaceId g = face_of(twin);
                if (is_seen[g.value] == 0) {
                    is_seen[g.value] = 1;
                    next_level.push_back(g);
                    if (tries_[g.value].reach >= steps) {
                        tries_[g.value] = {};
                    }
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
            optimize_all();
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

OptimizeReport improve_by_insertions(Tin& tin, const OptimizeOptions& options) {
    return visit_criterion(
        options.criterion, tin,
        [&](const FaceCriterion auto& criterion) {
            OptimizeReport report = Engine(tin, criterion, options).run(options.scope);
            if (criterion.kTraits.condition == InsertionCondition::None) {
                report.proof = Proof::None;
            }
            return report;
        },
        options.norm);
}

}  // namespace tinwright
