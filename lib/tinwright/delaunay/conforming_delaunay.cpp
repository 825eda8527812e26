#include "tinwright/delaunay/conforming_delaunay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "tinwright/delaunay/delaunay_edges.hpp"
#include "tinwright/delaunay/propagation.hpp"
#include "tinwright/delaunay/steiner_point.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_walk.hpp"

namespace tinwright {

namespace {

// An edge is Delaunay if neither of its faces' circles holds the other face's apex; in a constrained Delaunay
// triangulation it then has an empty disk. Edges of the hull always have one.
bool is_open(const Tin& tin, HalfEdgeId h) {
    const TriangleMesh& mesh = tin.mesh;
    const VertexId apex = mesh.origin(previous(h));
    const VertexId other = mesh.origin(previous(mesh.twin(h)));
    return apex != kGhostVertex && other != kGhostVertex &&
           incircle(tin.key(mesh.origin(h)), tin.key(mesh.destination(h)), tin.key(apex), tin.key(other)) > 0;
}

double distance(Key2 a, Key2 b) { return std::sqrt(squared_distance(a, b)); }

/// Splits edges of lines until all of them are Delaunay.
class Splitter {
  public:
    Splitter(SteinerInserter& inserter, std::size_t max_steiner, const Progress& progress)
        : inserter_(inserter),
          tin_(inserter.tin()),
          max_steiner_(max_steiner),
          progress_(progress),
          generation_(tin_.vertex_count() - inserter.old_vertex_count(), 0),
          fans_(inserter.old_vertex_count() + 1, 0),
          closures_(inserter.old_vertex_count(), Closure::Unknown) {
        make_fans();
    }

    void run() {
        enqueue_all();
        while (!queue_.empty() && steiner_count() < max_steiner_) {
            const Open open = queue_.front();
            queue_.pop_front();
            const std::optional<HalfEdgeId> h = find(open);
            if (h && is_open(tin_, *h) && !split(*h)) {
                given_up_.push_back(open);
            }
            if ((++steps_ & 0xFFFU) == 0) {
                report_progress(progress_, 1 - static_cast<double>(queue_.size()) /
                                                   static_cast<double>(queue_.size() + steiner_count()));
            }
        }
    }

    // Whether any edge of a line is still open.
    [[nodiscard]] bool has_open() const {
        const auto is_still_open = [&](const Open& edge) {
            const std::optional<HalfEdgeId> h = find(edge);
            return h && is_open(tin_, *h) && inserter_.line_edge_of(edge.a, edge.b) != SteinerInserter::kFree;
        };
        return std::any_of(queue_.begin(), queue_.end(), is_still_open) ||
               std::any_of(given_up_.begin(), given_up_.end(), is_still_open);
    }

  private:
    [[nodiscard]] Key2 key(VertexId v) const { return tin_.key(v); }
    [[nodiscard]] std::size_t steiner_count() const {
        return tin_.vertex_count() - inserter_.old_vertex_count();
    }
    [[nodiscard]] bool is_old(VertexId v) const { return v.value < inserter_.old_vertex_count(); }
    [[nodiscard]] int generation(VertexId v) const {
        return is_old(v) ? 0 : generation_[v.value - inserter_.old_vertex_count()];
    }

    // An edge that was open when it was queued, and where it was then.
    struct Open {
        VertexId a;
        VertexId b;
        HalfEdgeId h;
    };

    [[nodiscard]] std::optional<HalfEdgeId> find(const Open& open) const {
        const bool is_there = tin_.mesh.origin(open.h) == open.a && tin_.mesh.destination(open.h) == open.b;
        return is_there ? open.h : inserter_.find_half_edge(open.a, open.b);
    }

    void enqueue(HalfEdgeId h) {
        const TriangleMesh& mesh = tin_.mesh;
        if (mesh.is_constrained(h) && is_open(tin_, h)) {
            queue_.push_back({mesh.origin(h), mesh.destination(h), h});
        }
    }

    // In the order of the vertices, whatever the order of faces.
    void enqueue_all() {
        for (const auto& [a, b] : inserter_.line_edges()) {
            if (const std::optional<HalfEdgeId> h = inserter_.find_half_edge(a, b)) {
                enqueue(*h);
            }
        }
        for (auto v = static_cast<std::uint32_t>(inserter_.old_vertex_count()); v < tin_.vertex_count();
             ++v) {
            const HalfEdgeId first = inserter_.some_half_edge({v});
            HalfEdgeId h = first;
            do {
                enqueue(h);
                h = next_around(tin_.mesh, h);
            } while (h != first);
        }
    }

    enum class Closure : unsigned char { Unknown, Open, Closed };

    // The edges of lines at each vertex. Other ends come out ascending, as the edges do.
    void make_fans() {
        const auto& edges = inserter_.line_edges();
        for (const auto& [a, b] : edges) {
            ++fans_[a.value + 1];
            ++fans_[b.value + 1];
        }
        for (std::size_t v = 1; v < fans_.size(); ++v) {
            fans_[v] += fans_[v - 1];
        }
        fan_edges_.resize(2 * edges.size());
        std::vector<std::uint32_t> next(fans_.begin(), fans_.end() - 1);
        for (const auto& [a, b] : edges) {
            fan_edges_[next[a.value]++] = b;
            fan_edges_[next[b.value]++] = a;
        }
    }

    // Whether the edges of lines at a vertex leave no gap of much more than a right angle. Projecting from
    // one to the next then leads around the vertex, ever closer to it.
    [[nodiscard]] bool is_closed_fan(VertexId v) {
        Closure& closure = closures_[v.value];
        if (closure == Closure::Unknown) {
            closure = has_no_wide_gap(v) ? Closure::Closed : Closure::Open;
        }
        return closure == Closure::Closed;
    }

    [[nodiscard]] bool has_no_wide_gap(VertexId v) const {
        constexpr double kCosine = -0.05;
        std::vector<double> angles;
        for (std::uint32_t i = fans_[v.value]; i < fans_[v.value + 1]; ++i) {
            const Key2 end = key(fan_edges_[i]);
            angles.push_back(std::atan2(end.y - key(v).y, end.x - key(v).x));
        }
        if (angles.size() < 4) {
            return false;
        }
        std::sort(angles.begin(), angles.end());
        angles.push_back(angles.front() + 2 * 3.14159265358979323846);
        for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
            if (angles[i + 1] - angles[i] >= 3.14 || std::cos(angles[i + 1] - angles[i]) < kCosine) {
                return false;
            }
        }
        return true;
    }

    // The end that the line's edge through a and b shares with one that `c` lies on.
    [[nodiscard]] std::optional<VertexId> find_fan(std::uint32_t line_edge, VertexId c) const {
        const auto [begin, end] = inserter_.line_edges()[line_edge];
        if (is_old(c)) {
            for (const VertexId v : {begin, end}) {
                const auto first = fan_edges_.begin();
                if (std::binary_search(first + fans_[v.value], first + fans_[v.value + 1], c)) {
                    return v;
                }
            }
            return std::nullopt;
        }
        const std::uint32_t other = inserter_.line_edge_of(c, c);
        if (other >= inserter_.line_edges().size()) {
            return std::nullopt;
        }
        const auto [other_begin, other_end] = inserter_.line_edges()[other];
        for (const VertexId v : {begin, end}) {
            if (v == other_begin || v == other_end) {
                return v;
            }
        }
        return std::nullopt;
    }

    // The share of the way from a to b at a distance from `centre` that is a power of two; the middle when
    // there is none.
    [[nodiscard]] double shell(VertexId centre, VertexId a, VertexId b) const {
        const double near = distance(key(centre), key(a));
        const double far = distance(key(centre), key(b));
        const double low = std::min(near, far);
        const double high = std::max(near, far);
        const double middle = 0.5 * (low + high);
        double radius = std::exp2(std::round(std::log2(middle)));
        if (radius <= low + 0.1 * (high - low) || radius >= high - 0.1 * (high - low)) {
            radius = middle;
        }
        return (radius - near) / (far - near);
    }

    // Whether there was room on the lattice to split the edge.
    bool split(HalfEdgeId h) {
        constexpr int kDeep = 24;
        const TriangleMesh& mesh = tin_.mesh;
        const VertexId a = mesh.origin(h);
        const VertexId b = mesh.destination(h);
        VertexId c = mesh.origin(previous(h));
        const VertexId d = mesh.origin(previous(mesh.twin(h)));
        // The apex that sees the edge under the greater angle: the lesser cosine.
        const auto cosine = [&](VertexId v) {
            return inner_product(key(a), key(v), key(b)) /
                   (distance(key(a), key(v)) * distance(key(b), key(v)));
        };
        c = cosine(d) < cosine(c) ? d : c;
        const int generation_of_new = generation(c) + 1;
        double t = inner_product(key(c), key(a), key(b)) / inner_product(key(b), key(a), key(b));
        const std::uint32_t line_edge = inserter_.line_edge_of(a, b);
        if (line_edge == SteinerInserter::kFree) {
            return true;  // nobody's line
        }
        const std::optional<VertexId> fan = find_fan(line_edge, c);
        if (fan && (generation_of_new >= kDeep || is_closed_fan(*fan))) {
            t = shell(*fan, a, b);
        }
        std::optional<VertexId> made = inserter_.split(h, t);
        if (!made) {
            made = inserter_.split(h, 0.5);
        }
        if (!made) {
            return false;
        }
        generation_.push_back(generation_of_new);
        for (const HalfEdgeId touched : inserter_.touched()) {
            enqueue(touched);
        }
        return true;
    }

    SteinerInserter& inserter_;
    const Tin& tin_;
    std::size_t max_steiner_;
    const Progress& progress_;
    std::deque<Open> queue_;
    std::vector<Open> given_up_;
    std::vector<int> generation_;      // of Steiner points: how many were made one because of the other
    std::vector<std::uint32_t> fans_;  // where a vertex's entries in fan_edges_ begin
    std::vector<VertexId> fan_edges_;  // other ends of the edges of lines at each vertex, ascending
    std::vector<Closure> closures_;    // of the fan at each vertex
    std::size_t steps_ = 0;
};

std::size_t usual_budget(ConformingMethod method, std::size_t vertices, std::size_t edges) {
    constexpr std::size_t kMost = 100'000'000;
    const std::size_t few = 10 * vertices + 100 * edges;
    // Some sets of edges need as many as there are pairs of a vertex and an edge [tan1993, Fig. 6.1], which
    // splitting does not always find.
    return method == ConformingMethod::Split ? few : few + std::min(kMost, 10 * vertices * edges);
}

}  // namespace

ConformingReport make_conforming(Tin& tin, const ConformingOptions& options) {
    ConformingReport report;
    const std::size_t old_count = tin.vertex_count();
    SteinerInserter inserter(tin);
    const std::size_t max_steiner =
        options.max_steiner > 0 ? options.max_steiner
                                : usual_budget(options.method, old_count, inserter.line_edges().size());
    if (options.method == ConformingMethod::Blocking) {
        const BlockingReport blocking = block_and_propagate(inserter, max_steiner, options.progress);
        report.blocking_disks = blocking.disks;
        report.blocking_vertices = blocking.circle_vertices + blocking.touching_vertices;
    }
    // After blocking, what rounding to the lattice has spoiled.
    Splitter splitter(inserter, max_steiner, options.progress);
    splitter.run();
    const bool has_open_edges = splitter.has_open();
    inserter.finish();
    report.open_edges = has_open_edges ? count_open_edges(tin) : 0;
    report.steiner_vertices = tin.vertex_count() - old_count;
    report.is_conforming = report.open_edges == 0;
    report.is_budget_spent = !report.is_conforming && report.steiner_vertices >= max_steiner;
    return report;
}

bool is_conforming(const Tin& tin) {
    const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
    return std::all_of(tin.traces.begin(), tin.traces.end(), [&](const LineTrace& trace) {
        const std::optional<HalfEdgeId> h = find_half_edge(tin.mesh, starts[trace.a.value], trace.b);
        return h && !is_open(tin, *h);
    });
}

std::size_t count_open_edges(const Tin& tin) {
    if (is_conforming(tin)) {
        return 0;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const LineTrace& trace : tin.traces) {
        const std::pair edge(trace.a.value, trace.b.value);
        if (edges.empty() || edges.back() != edge) {
            edges.push_back(edge);
        }
    }
    // One open edge is enough to hide vertices from others.
    return count_edges_without_disk(tin.keys, edges);
}

}  // namespace tinwright
