#include "tinwright/optimal/triangulate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/threads.hpp"

namespace tinwright {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_optimize_options(const OptimizeOptions& options) {
    const Scope& scope = options.scope;
    if (scope.kind == Scope::Kind::Top && !(scope.value > 0 && scope.value <= 100)) {
        throw UsageError("the percentage of the scope must be above 0 and at most 100");
    }
    if (scope.kind == Scope::Kind::Above && !std::isfinite(scope.value)) {
        throw UsageError("the measure that the scope ends at must be a number");
    }
    if (options.budget_seconds && !(*options.budget_seconds >= 0)) {
        throw UsageError("the budget must be zero seconds or more");
    }
}

void check_data_dependent_options(const DataDependentOptions& options) {
    if (options.delaunay_order && *options.delaunay_order < 0) {
        throw UsageError("the Delaunay order must be zero or more");
    }
    if (options.budget_seconds && !(*options.budget_seconds >= 0)) {
        throw UsageError("the budget must be zero seconds or more");
    }
}

void check_options(const TriangulateOptions& options) {
    if (options.threads < 0) {
        throw UsageError("the number of threads must not be negative");
    }
    if (!(options.duplicates.tolerance >= 0)) {
        throw UsageError("the duplicate tolerance must be zero or more");
    }
    if (!(options.noding.snap >= 0)) {
        throw UsageError("the snapping distance must be zero or more");
    }
    if (!(options.noding.crossing_tolerance >= 0)) {
        throw UsageError("the crossing tolerance must be zero or more");
    }
    if (!(options.line_tolerance >= 0)) {
        throw UsageError("the line tolerance must be zero or more");
    }
    if (options.domain.kind == DomainRule::Kind::Concave && !(options.domain.length > 0)) {
        throw UsageError("the length of a concave domain must be above zero");
    }
    if (options.optimize) {
        check_optimize_options(*options.optimize);
    }
    if (options.data_dependent) {
        check_data_dependent_options(*options.data_dependent);
        if (options.optimize) {
            throw UsageError("a TIN is made optimal or data-dependent, not both");
        }
    }
    if (options.max_edge && !(*options.max_edge > 0)) {
        throw UsageError("the longest edge allowed must be above zero");
    }
}

std::string text_of(const Tin& tin, VertexId v) { return location_text(tin.lattice.position(tin.key(v))); }

struct HullAndDetail {
    std::size_t hull_vertices = 0;
    double closest = std::numeric_limits<double>::infinity();  // squared distance in keys
    FaceId at{};

    static HullAndDetail merge(const HullAndDetail& a, const HullAndDetail& b) {
        const bool is_b = b.closest < a.closest || (b.closest == a.closest && b.at < a.at);
        const HullAndDetail& least = is_b ? b : a;
        return {a.hull_vertices + b.hull_vertices, least.closest, least.at};
    }
};

// Counts ghost faces, as many as the hull has vertices, and finds the two closest vertices, which are the
// ends of an edge.
// `turns`: the numbers, as in `Tin::sample`, where points of water begin, end, begin again, ...
HullAndDetail examine(const Tin& tin, const std::vector<std::uint32_t>& turns = {}) {
    constexpr std::uint32_t kGrain = 1U << 14U;
    const TriangleMesh& mesh = tin.mesh;
    const bool must_measure = !tin.lattice.is_exact();
    const std::span<const Key2> keys = tin.keys;
    // Points made where lines cross may be as close to others as they like, and so may those of water, which
    // has been cut where it crosses already.
    const auto is_given = [&tin, &turns](VertexId v) {
        const std::uint32_t number = tin.sample[v.value];
        const auto turn = std::upper_bound(turns.begin(), turns.end(), number);
        return number < Tin::kInserted && (turn - turns.begin()) % 2 == 0;
    };
    const auto examine_range = [&mesh, &is_given, keys, must_measure](
                                   const tbb::blocked_range<std::uint32_t>& range,
                                   const HullAndDetail& before) {
        std::size_t ghosts = before.hull_vertices;
        double closest = before.closest;
        FaceId at = before.at;
        for (std::uint32_t f = range.begin(); f != range.end(); ++f) {
            const auto& [a, b, c] = mesh.face({f}).vertex;
            if (c == kGhostVertex) {
                ++ghosts;
            } else if (must_measure && is_given(a) && is_given(b) && is_given(c)) {
                const Key2 p = keys[a.value];
                const Key2 q = keys[b.value];
                const Key2 r = keys[c.value];
                const double least = std::min(std::min(squared_distance(p, q), squared_distance(q, r)),
                                              squared_distance(r, p));
                if (least < closest) {
                    closest = least;
                    at = {f};
                }
            }
        }
        return HullAndDetail{ghosts, closest, at};
    };
    return tbb::parallel_reduce(
        tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(mesh.slot_count()), kGrain),
        HullAndDetail{}, examine_range, HullAndDetail::merge);
}

std::vector<std::uint32_t> find_turns_of_water(std::size_t sample_count, std::span<const Breakline> lines) {
    std::vector<std::uint32_t> turns;
    std::size_t number = sample_count;
    for (const Breakline& line : lines) {
        const bool is_in_water = turns.size() % 2 != 0;
        if (is_water_role(line.role) != is_in_water) {
            turns.push_back(static_cast<std::uint32_t>(number));
        }
        number += line.points.size();
    }
    return turns;
}

// A lattice that had to move samples is good only if it moved each by a small part of the way to its
// nearest neighbour.
void check_detail(const Tin& tin, const HullAndDetail& seen) {
    const double closest_allowed = std::ldexp(16.0, tin.lattice.refinement());
    if (tin.lattice.is_exact() || seen.closest >= closest_allowed * closest_allowed) {
        return;
    }
    const VertexId at = tin.mesh.vertex(seen.at, 0);
    throw InputError(
        "the extent of the samples is too large for their detail: two of them at " + text_of(tin, at) +
            " or next to it are closer than 16 of the 2^45 = 35184372088832 lattice steps across the "
            "extent; remove outlying samples or round the coordinates",
        {tin.sample[at.value]});
}

// Vertices and their Delaunay triangulation, without lines.
void make_plain_tin(std::span<const Point3> samples, const TriangulateOptions& options,
                    Triangulated& result) {
    SampleVertices vertices = make_sample_vertices(samples, options.duplicates);
    result.report.bounds = vertices.bounds;
    result.report.duplicates = std::move(vertices.duplicates);
    Tin& tin = result.tin;
    tin.lattice = vertices.lattice;
    tin.keys = std::move(vertices.keys);
    tin.z = std::move(vertices.z);
    tin.sample = std::move(vertices.sample);
    report_progress(options.progress, 0.3);
    if (tin.keys.size() >= 2) {
        tin.mesh = make_delaunay(tin.keys);
    }
}

// The same with lines in it. Returns the number of the terrain ring's traces, where there is one.
std::optional<std::uint32_t> make_tin_with_lines(std::span<const Point3> samples,
                                                 std::span<const Breakline> lines,
                                                 const TriangulateOptions& options, Triangulated& result) {
    ConstrainedTin made = make_constrained_tin(samples, lines,
                                               {.duplicates = options.duplicates,
                                                .noding = options.noding,
                                                .line_tolerance = options.line_tolerance,
                                                .wants_fine_lattice = options.conforming.has_value()});
    result.tin = std::move(made.tin);
    result.report.bounds = made.bounds;
    result.report.duplicates = std::move(made.duplicates);
    result.report.lines = std::move(made.lines);
    return made.terrain_ring ? std::optional(static_cast<std::uint32_t>(lines.size())) : std::nullopt;
}

void check_locations(const Tin& tin) {
    const std::size_t count = tin.keys.size();
    if (count < 3) {
        throw InputError("a surface needs three distinct sample locations or more, there " +
                         std::string(count == 1 ? "is " : "are ") + std::to_string(count));
    }
    if (tin.mesh.count_terrain() == 0) {
        throw InputError("all " + std::to_string(count) + " sample locations lie on one line, for example " +
                         text_of(tin, {0}) + " and " + text_of(tin, {static_cast<std::uint32_t>(count - 1)}) +
                         "; a surface needs one off the line");
    }
}

void apply_domain_rules(Triangulated& result, std::span<const Breakline> lines,
                        std::optional<std::uint32_t> terrain_ring, const TriangulateOptions& options) {
    Tin& tin = result.tin;
    result.report.domain.cut_faces = apply_polygons(tin, lines, terrain_ring);
    if (tin.mesh.count_terrain() == 0) {
        throw InputError("no face is left: boundary and holes leave no terrain between the samples");
    }
    result.report.domain.trimmed_faces = apply_domain(tin, options.domain);
    constrain_border(tin);
}

Triangulated triangulate_here(std::span<const Point3> samples, std::span<const Breakline> lines,
                              const TriangulateOptions& options) {
    Triangulated result;
    Tin& tin = result.tin;
    TriangulateReport& report = result.report;
    const auto start = Clock::now();
    report_progress(options.progress, 0);
    report.samples = samples.size();
    std::optional<std::uint32_t> terrain_ring;
    if (lines.empty()) {
        make_plain_tin(samples, options, result);
    } else {
        terrain_ring = make_tin_with_lines(samples, lines, options, result);
    }
    check_locations(tin);
    const HullAndDetail seen = examine(tin, find_turns_of_water(samples.size(), lines));
    report.hull_vertices = seen.hull_vertices;
    check_detail(tin, seen);
    report.triangulate_seconds = seconds_since(start);
    report_progress(options.progress, 0.9);

    const auto domain_start = Clock::now();
    if (options.conforming && !lines.empty()) {
        report.conforming = make_conforming(tin, *options.conforming);
        report.is_conforming = report.conforming->is_conforming;
        report.hull_vertices = tin.mesh.slot_count() - tin.mesh.count_terrain();
    } else {
        report.is_conforming = lines.empty() || is_conforming(tin);
    }
    apply_domain_rules(result, lines, terrain_ring, options);
    if (options.before_optimum) {
        options.before_optimum(tin, find_water_faces(tin, lines));
    }
    report.constrain_seconds = seconds_since(domain_start);
    if (options.optimize) {
        report.optimize = optimize(tin, *options.optimize);
    }
    if (options.data_dependent) {
        report.data_dependent = flip_creases(tin, *options.data_dependent);
    }
    const auto voids_start = Clock::now();
    if (options.max_edge) {
        report.domain.void_faces =
            drop_long_faces(tin, *options.max_edge, find_water_faces(tin, lines), options.ground);
        constrain_border(tin);
    }
    report.faces = tin.mesh.slot_count() - report.hull_vertices - report.domain.cut_faces -
                   report.domain.trimmed_faces - report.domain.void_faces;
    if (report.faces == 0) {
        throw InputError(
            "no face is left: all have an edge longer than --max-edge allows; give a longer one");
    }
    report.constrain_seconds += seconds_since(voids_start);
    report_progress(options.progress, 1);
    return result;
}

}  // namespace

Triangulated triangulate(std::span<const Point3> samples, std::span<const Breakline> lines,
                         const TriangulateOptions& options) {
    check_options(options);
    tbb::task_arena arena(count_threads(options.threads));
    return arena.execute([&] { return triangulate_here(samples, lines, options); });
}

Triangulated triangulate(std::span<const Point3> samples, const TriangulateOptions& options) {
    return triangulate(samples, {}, options);
}

Triangulated triangulate_locations(std::span<const Point3> samples, const TriangulateOptions& options) {
    check_options(options);
    tbb::task_arena arena(count_threads(options.threads));
    return arena.execute([&] {
        Triangulated result;
        const auto start = Clock::now();
        report_progress(options.progress, 0);
        result.report.samples = samples.size();
        make_plain_tin(samples, options, result);
        const std::size_t count = result.tin.keys.size();
        if (count < 2) {
            throw InputError("a graph needs two distinct sample locations or more, there " +
                             std::string(count == 1 ? "is " : "are ") + std::to_string(count));
        }
        const HullAndDetail seen = examine(result.tin);
        check_detail(result.tin, seen);
        result.report.hull_vertices = seen.hull_vertices;
        result.report.faces = result.tin.mesh.count_terrain();
        result.report.triangulate_seconds = seconds_since(start);
        report_progress(options.progress, 1);
        return result;
    });
}

}  // namespace tinwright
