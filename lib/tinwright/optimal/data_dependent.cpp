#include "tinwright/optimal/data_dependent.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/optimal/delaunay_order.hpp"

namespace tinwright {

namespace {

/// Of z over x and y of the plane through three vertices; the same bits for any order of them. `z_factor`:
/// CRS units in a unit of z.
Point2 gradient_of(const Tin& tin, VertexId a, VertexId b, VertexId c, double z_factor) {
    std::array<VertexId, 3> v{a, b, c};
    std::sort(v.begin(), v.end());
    const Key2 p = tin.key(v[0]);
    const Key2 q = tin.key(v[1]);
    const Key2 r = tin.key(v[2]);
    const double q_z = tin.z[v[1].value] - tin.z[v[0].value];
    const double r_z = tin.z[v[2].value] - tin.z[v[0].value];
    const double area = doubled_area(p, q, r) * tin.lattice.quantum();
    return {z_factor * ((q_z * (r.y - p.y) - r_z * (q.y - p.y)) / area),
            z_factor * ((r_z * (q.x - p.x) - q_z * (r.x - p.x)) / area)};
}

double length(double x, double y) { return std::sqrt(x * x + y * y); }

double crease(Point2 a, Point2 b, CreaseMeasure measure) {
    const double x = b.x - a.x;
    const double y = b.y - a.y;
    if (measure == CreaseMeasure::NormalJump) {
        return length(x, y);  // along the edge both slopes are the same
    }
    const double cross = a.x * b.y - a.y * b.x;
    return std::atan2(std::sqrt(x * x + y * y + cross * cross), 1 + (a.x * b.x + a.y * b.y));
}

/// The edge of `h` with its two faces' other corners; the same for both half-edges.
struct Quad {
    HalfEdgeId h{};  ///< from a to b
    HalfEdgeId t{};  ///< its twin
    VertexId a{};    ///< a < b
    VertexId b{};
    VertexId c{};  ///< left of a b
    VertexId d{};  ///< right of it
};

Quad quad_around(const TriangleMesh& mesh, HalfEdgeId h) {
    if (mesh.destination(h) < mesh.origin(h)) {
        h = mesh.twin(h);
    }
    const HalfEdgeId t = mesh.twin(h);
    return {h, t, mesh.origin(h), mesh.origin(t), mesh.origin(previous(h)), mesh.origin(previous(t))};
}

class Flipper {
  public:
    Flipper(Tin& tin, const DataDependentOptions& options)
        : tin_(tin),
          options_(options),
          gradients_(tin.mesh.slot_count()),
          stamps_(4 * tin.mesh.slot_count()) {
        if (options.delaunay_order) {
            order_.emplace(tin);
        }
    }

    DataDependentReport run();

  private:
    using Clock = std::chrono::steady_clock;

    struct Candidate {
        double gain = 0;
        VertexId a{};
        VertexId b{};
        HalfEdgeId h{};
        std::uint32_t stamp = 0;
        friend bool operator<(const Candidate& one, const Candidate& other) {
            return std::tuple(one.gain, other.a, other.b) < std::tuple(other.gain, one.a, one.b);
        }
    };

    /// Whether the edge has a crease that counts; if constrained, it has not.
    [[nodiscard]] bool does_count(HalfEdgeId h) const {
        const TriangleMesh& mesh = tin_.mesh;
        return !mesh.is_constrained(h) && mesh.is_terrain(face_of(h)) &&
               mesh.is_terrain(face_of(mesh.twin(h)));
    }
    [[nodiscard]] double crease_at(HalfEdgeId h) const {
        return crease(gradients_[face_of(h).value], gradients_[face_of(tin_.mesh.twin(h)).value],
                      options_.measure);
    }
    void find_gradient(FaceId f) {
        const auto& v = tin_.mesh.face(f).vertex;
        gradients_[f.value] = gradient_of(tin_, v[0], v[1], v[2], options_.z_factor);
    }
    [[nodiscard]] double find_gain(const Quad& quad) const;
    [[nodiscard]] bool is_in_order(const Quad& quad);
    void consider(HalfEdgeId h);
    void flip(HalfEdgeId h);
    void sum_up(double& sum);
    [[nodiscard]] bool must_stop(std::size_t steps);
    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }

    Tin& tin_;
    const DataDependentOptions& options_;
    DataDependentReport report_;
    Clock::time_point start_ = Clock::now();
    std::optional<internal::DelaunayOrder> order_;
    std::vector<Point2> gradients_;  // by face slot
    // By half-edge: grows with every look at its edge. Candidates of an earlier look are out of date.
    std::vector<std::uint32_t> stamps_;
    std::priority_queue<Candidate> queue_;
};

// By how much a flip lowers the sum; zero if it is not possible or gains nothing but rounding.
double Flipper::find_gain(const Quad& quad) const {
    const auto& [h, t, a, b, c, d] = quad;
    if (orient2d(tin_.key(d), tin_.key(c), tin_.key(a)) <= 0 ||
        orient2d(tin_.key(c), tin_.key(d), tin_.key(b)) <= 0) {
        return 0;
    }
    const Point2 at_a = gradient_of(tin_, a, c, d, options_.z_factor);
    const Point2 at_b = gradient_of(tin_, b, c, d, options_.z_factor);
    double before = crease_at(h);
    double after = crease(at_a, at_b, options_.measure);
    double steepest = std::max(length(at_a.x, at_a.y), length(at_b.x, at_b.y));
    const auto add_rim = [&](HalfEdgeId rim, Point2 inside) {
        const Point2 old = gradients_[face_of(rim).value];
        steepest = std::max(steepest, length(old.x, old.y));
        if (does_count(rim)) {
            const Point2 outside = gradients_[face_of(tin_.mesh.twin(rim)).value];
            before += crease(old, outside, options_.measure);
            after += crease(inside, outside, options_.measure);
            steepest = std::max(steepest, length(outside.x, outside.y));
        }
    };
    add_rim(next(h), at_b);
    add_rim(previous(h), at_a);
    add_rim(next(t), at_a);
    add_rim(previous(t), at_b);
    const double scale = options_.measure == CreaseMeasure::NormalAngle ? 1 : steepest;
    const double gain = before - after;
    return gain > kTieMargin * std::max(before, scale) ? gain : 0;
}

bool Flipper::is_in_order(const Quad& quad) {
    if (!order_) {
        return true;
    }
    const int order = *options_.delaunay_order;
    const HalfEdgeId at_c = previous(quad.h);
    const HalfEdgeId at_d = previous(quad.t);
    return order_->is_at_most(tin_, {quad.h, at_d, at_c}, order) ||
           order_->is_at_most(tin_, {quad.t, at_c, at_d}, order);
}

// Looks anew at an edge.
void Flipper::consider(HalfEdgeId h) {
    const HalfEdgeId twin = tin_.mesh.twin(h);
    const std::uint32_t look = std::max(stamps_[h.value], stamps_[twin.value]) + 1;
    stamps_[h.value] = look;
    stamps_[twin.value] = look;
    if (!does_count(h)) {
        return;
    }
    const Quad quad = quad_around(tin_.mesh, h);
    const double gain = find_gain(quad);
    if (gain > 0) {
        queue_.push({gain, quad.a, quad.b, quad.h, look});
    }
}

// A flip changes what is to be gained at every edge of its two faces and of the faces around them.
void Flipper::flip(HalfEdgeId h) {
    TriangleMesh& mesh = tin_.mesh;
    flip_edge(mesh, h);
    ++report_.flips;
    const HalfEdgeId t = mesh.twin(h);
    find_gradient(face_of(h));
    find_gradient(face_of(t));
    consider(h);
    for (const HalfEdgeId rim : {next(h), previous(h), next(t), previous(t)}) {
        consider(rim);
        const HalfEdgeId outer = mesh.twin(rim);
        consider(next(outer));
        consider(previous(outer));
    }
}

void Flipper::sum_up(double& sum) {
    const TriangleMesh& mesh = tin_.mesh;
    report_.edges = 0;
    std::vector<double> creases;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (h < mesh.twin(h) && does_count(h)) {
                creases.push_back(crease_at(h));
            }
        }
    }
    // The same sum whatever the order of the faces.
    std::sort(creases.begin(), creases.end());
    sum = 0;
    for (const double value : creases) {
        sum += value;
    }
    report_.edges = creases.size();
}

bool Flipper::must_stop(std::size_t steps) {
    constexpr std::size_t kStepsBetween = 1024;
    if (steps % kStepsBetween != 0) {
        return false;
    }
    if (options_.budget_seconds && seconds() >= *options_.budget_seconds) {
        report_.stopped_by = StoppedBy::Budget;
    } else if (options_.progress) {
        const double part = static_cast<double>(steps) / static_cast<double>(steps + queue_.size());
        report_.stopped_by = options_.progress(part) ? StoppedBy::Finished : StoppedBy::Interrupt;
    }
    return report_.stopped_by != StoppedBy::Finished;
}

DataDependentReport Flipper::run() {
    const TriangleMesh& mesh = tin_.mesh;
    const auto slots = static_cast<std::uint32_t>(mesh.slot_count());
    for (std::uint32_t f = 0; f < slots; ++f) {
        if (mesh.is_terrain({f})) {
            find_gradient({f});
        }
    }
    sum_up(report_.sum_before);
    for (std::uint32_t f = 0; f < slots; ++f) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            if (h < mesh.twin(h)) {
                consider(h);
            }
        }
    }
    for (std::size_t steps = 1; !queue_.empty() && !must_stop(steps); ++steps) {
        const Candidate best = queue_.top();
        queue_.pop();
        if (stamps_[best.h.value] != best.stamp) {
            continue;
        }
        if (is_in_order(quad_around(mesh, best.h))) {
            flip(best.h);
        } else {
            ++report_.refused;
        }
    }
    sum_up(report_.sum_after);
    report_.seconds = seconds();
    return report_;
}

}  // namespace

double measure_crease(const Tin& tin, HalfEdgeId h, CreaseMeasure measure, double z_factor) {
    const auto gradient = [&tin, z_factor](HalfEdgeId side) {
        const auto& v = tin.mesh.face(face_of(side)).vertex;
        return gradient_of(tin, v[0], v[1], v[2], z_factor);
    };
    const Quad quad = quad_around(tin.mesh, h);
    return crease(gradient(quad.h), gradient(quad.t), measure);
}

DataDependentReport flip_creases(Tin& tin, const DataDependentOptions& options) {
    if (options.delaunay_order && *options.delaunay_order < 0) {
        throw UsageError("the Delaunay order must be zero or more");
    }
    return Flipper(tin, options).run();
}

}  // namespace tinwright
