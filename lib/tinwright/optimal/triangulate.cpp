#include "tinwright/optimal/triangulate.hpp"

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <tbb/task_arena.h>

#include "tinwright/delaunay/delaunay.hpp"

namespace tinwright {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void check_options(const TriangulateOptions& options) {
    if (options.threads < 0) {
        throw UsageError("the number of threads must not be negative");
    }
    if (!(options.duplicates.tolerance >= 0)) {
        throw UsageError("the duplicate tolerance must be zero or more");
    }
    if (options.domain.kind == DomainRule::Kind::Concave && !(options.domain.length > 0)) {
        throw UsageError("the length of a concave domain must be above zero");
    }
    if (options.max_edge && !(*options.max_edge > 0)) {
        throw UsageError("the longest edge allowed must be above zero");
    }
}

// A lattice that had to move samples is good only if it moved each by a small part of the way to its
// nearest neighbour, which in a Delaunay triangulation is at the other end of an edge.
void check_detail(const Tin& tin) {
    constexpr double kClosest = 16;
    double closest = std::numeric_limits<double>::infinity();
    VertexId at{};
    for (std::size_t f = 0; f < tin.mesh.slot_count(); ++f) {
        const FaceId face{static_cast<std::uint32_t>(f)};
        // The first edge of a ghost face is a hull edge, so each edge is seen, most of them twice.
        const unsigned edges = tin.mesh.is_ghost(face) ? 1 : 3;
        for (unsigned i = 0; i < edges; ++i) {
            const Key2 a = tin.key(tin.mesh.vertex(face, i));
            const Key2 b = tin.key(tin.mesh.vertex(face, next_corner(i)));
            const double distance = std::hypot(a.x - b.x, a.y - b.y);
            if (distance < closest) {
                closest = distance;
                at = tin.mesh.vertex(face, i);
            }
        }
    }
    if (closest < kClosest) {
        const Point3 p = tin.position(at);
        throw InputError(
            "the extent of the samples is too large for their detail: two of them near (" +
                std::to_string(p.x) + ", " + std::to_string(p.y) +
                ") are closer than 16 steps of the lattice of 2^45 = 35184372088832 steps across the extent; "
                "remove outlying samples or round the coordinates",
            {tin.sample[at.value]});
    }
}

std::size_t count_ghosts(const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < mesh.slot_count(); ++f) {
        count += mesh.is_ghost({static_cast<std::uint32_t>(f)}) ? 1 : 0;
    }
    return count;
}

Triangulated triangulate_here(std::span<const Point3> samples, const TriangulateOptions& options) {
    Triangulated result;
    Tin& tin = result.tin;
    TriangulateReport& report = result.report;
    const auto start = Clock::now();
    report_progress(options.progress, 0);
    {
        SampleVertices vertices = make_sample_vertices(samples, options.duplicates);
        report.samples = samples.size();
        report.bounds = vertices.bounds;
        report.duplicates = std::move(vertices.duplicates);
        tin.lattice = vertices.lattice;
        tin.keys = std::move(vertices.keys);
        tin.z = std::move(vertices.z);
        tin.sample = std::move(vertices.sample);
    }
    if (tin.keys.size() < 3) {
        throw InputError("a surface needs three distinct sample locations or more, there " +
                         std::string(tin.keys.size() == 1 ? "is " : "are ") +
                         std::to_string(tin.keys.size()));
    }
    report_progress(options.progress, 0.3);
    tin.mesh = make_delaunay(tin.keys);
    report.hull_vertices = count_ghosts(tin.mesh);
    if (report.hull_vertices == tin.mesh.slot_count()) {
        const Point3 a = tin.position({0});
        const Point3 b = tin.position({static_cast<std::uint32_t>(tin.keys.size() - 1)});
        throw InputError("all " + std::to_string(tin.keys.size()) +
                         " sample locations lie on one line, for example (" + std::to_string(a.x) + ", " +
                         std::to_string(a.y) + ") and (" + std::to_string(b.x) + ", " + std::to_string(b.y) +
                         "); a surface needs one off the line");
    }
    if (!tin.lattice.is_exact()) {
        check_detail(tin);
    }
    report.triangulate_seconds = seconds_since(start);
    report_progress(options.progress, 0.9);

    const auto domain_start = Clock::now();
    report.domain.trimmed_faces = apply_domain(tin, options.domain);
    if (options.max_edge) {
        report.domain.void_faces = drop_long_faces(tin, *options.max_edge);
    }
    constrain_border(tin);
    report.faces = tin.mesh.count_terrain();
    if (report.faces == 0) {
        throw InputError(
            "no face is left: all have an edge longer than --max-edge allows; give a longer one");
    }
    report.constrain_seconds = seconds_since(domain_start);
    report_progress(options.progress, 1);
    return result;
}

}  // namespace

Triangulated triangulate(std::span<const Point3> samples, const TriangulateOptions& options) {
    check_options(options);
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
    return arena.execute([&] { return triangulate_here(samples, options); });
}

}  // namespace tinwright
