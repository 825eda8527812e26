#include "tinwright/surface/gradients.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <span>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/gradient_fit.hpp"
#include "tinwright/surface/vertex_fan.hpp"

namespace tinwright {

namespace {

constexpr std::size_t kBlock = 1024;  // vertices a task

/// One corner's own gradient, where the faces around its vertex do not all have the same.
struct Override {
    HalfEdgeId corner{};
    Point2 gradient{};
    Point2 of_fan{};  // before sharp edges were kept straight
};

double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

/// The two edges of a face at a corner, from there, steps; and which of them are sharp.
struct CornerEdges {
    CornerEdges(const Tin& tin, const SharpEdges& sharp, HalfEdgeId corner)
        : ends{tin.mesh.destination(corner), tin.mesh.origin(previous(corner))},
          is_sharp{sharp.is_sharp(corner), sharp.is_sharp(previous(corner))} {
        const Key2 at = tin.key(tin.mesh.origin(corner));
        for (unsigned i = 0; i < 2; ++i) {
            const Key2 end = tin.key(ends[i]);
            edge[i] = {end.x - at.x, end.y - at.y};
        }
        area = doubled_area(at, tin.key(ends[0]), tin.key(ends[1]));
    }

    [[nodiscard]] bool has_sharp() const { return is_sharp[0] || is_sharp[1]; }

    /// The gradient with these rises along the two edges.
    [[nodiscard]] Point2 gradient(double rise0, double rise1) const {
        return {(rise0 * edge[1].y - rise1 * edge[0].y) / area,
                (rise1 * edge[0].x - rise0 * edge[1].x) / area};
    }

    std::array<VertexId, 2> ends;
    std::array<bool, 2> is_sharp;
    std::array<Point2, 2> edge;
    double area = 0;
};

/// Adds up the weights of each vertex; ascending.
std::vector<GradientWeight> merged(std::vector<GradientWeight> weights) {
    std::stable_sort(weights.begin(), weights.end(),
                     [](const GradientWeight& a, const GradientWeight& b) { return a.vertex < b.vertex; });
    std::size_t count = 0;
    for (const GradientWeight& each : weights) {
        if (count > 0 && weights[count - 1].vertex == each.vertex) {
            Point2& sum = weights[count - 1].weight;
            sum = {sum.x + each.weight.x, sum.y + each.weight.y};
        } else {
            weights[count++] = each;
        }
    }
    weights.resize(count);
    return weights;
}

/// All fans in one turn around a vertex; the number of terrain faces in it.
template <class Visit>
std::size_t visit_fans(const TriangleMesh& mesh, const SharpEdges& sharp, HalfEdgeId start, Visit visit) {
    bool is_one = true;
    std::size_t faces = 0;
    HalfEdgeId h = start;
    do {
        const bool is_terrain = mesh.is_terrain(face_of(h));
        faces += is_terrain ? 1 : 0;
        is_one = is_one && is_terrain;
        if (is_terrain && is_wall(mesh, sharp, h)) {
            is_one = false;
            visit(find_fan(mesh, sharp, h));
        }
        h = next_around(mesh, h);
    } while (h != start);
    if (is_one) {
        visit(find_fan(mesh, sharp, start));
    }
    return faces;
}

/// Marks the half-edges that turning around vertices leads to from where they start.
std::vector<bool> mark_turns(const TriangleMesh& mesh, const std::vector<HalfEdgeId>& starts) {
    std::vector<bool> is_in_turn(4 * mesh.slot_count());
    for (const HalfEdgeId start : starts) {
        HalfEdgeId h = start;
        do {
            is_in_turn[h.value] = true;
            h = h == kNoHalfEdge ? start : next_around(mesh, h);
        } while (h != start);
    }
    return is_in_turn;
}

}  // namespace

struct CornerGradients::State {
    State(const Tin& of_tin, SharpEdges its_sharp, GradientMethod its_method)
        : tin(of_tin),
          sharp(std::move(its_sharp)),
          method(its_method),
          steps_per_unit(of_tin.lattice.steps_per_unit()) {}

    [[nodiscard]] Point2 per_unit(Point2 per_step) const {
        return {per_step.x * steps_per_unit, per_step.y * steps_per_unit};
    }
    /// A fan's gradient as one of its faces has it, per step.
    [[nodiscard]] Point2 at_corner(Point2 of_fan, HalfEdgeId corner) const;
    std::size_t estimate_around(VertexId v, HalfEdgeId start, GradientFit& fit, std::vector<Override>& own);
    void estimate_all();
    void estimate_other_turns(const std::vector<HalfEdgeId>& starts);
    void add_overrides(const std::vector<Override>& own);
    [[nodiscard]] const Override* find_override(HalfEdgeId corner) const;
    [[nodiscard]] std::vector<GradientWeight> stencil(HalfEdgeId corner) const;
    [[nodiscard]] std::vector<GradientWeight> with_own(HalfEdgeId corner,
                                                       std::vector<GradientWeight> weights) const;

    const Tin& tin;
    SharpEdges sharp;
    GradientMethod method;
    double steps_per_unit;
    LargeVector<Point2> gradient;     // by vertex
    std::vector<bool> has_override;   // by vertex; empty if none has
    std::vector<Override> overrides;  // by corner, ascending
};

Point2 CornerGradients::State::at_corner(Point2 of_fan, HalfEdgeId corner) const {
    const CornerEdges edges(tin, sharp, corner);
    if (!edges.has_sharp()) {
        return of_fan;
    }
    const double z = tin.z[tin.mesh.origin(corner).value];
    std::array<double, 2> missing{};  // of the rise along a sharp edge
    for (unsigned i = 0; i < 2; ++i) {
        missing[i] = edges.is_sharp[i] ? tin.z[edges.ends[i].value] - z - dot(of_fan, edges.edge[i]) : 0;
    }
    const Point2 change = edges.gradient(missing[0], missing[1]);
    return {of_fan.x + change.x, of_fan.y + change.y};
}

/// The gradients of one turn around a vertex; the number of terrain faces in it.
std::size_t CornerGradients::State::estimate_around(VertexId v, HalfEdgeId start, GradientFit& fit,
                                                    std::vector<Override>& own) {
    gradient[v.value] = {};
    unsigned fans = 0;
    const std::size_t before = own.size();
    const std::size_t faces = visit_fans(tin.mesh, sharp, start, [&](const VertexFan& fan) {
        const Point2 of_fan = fit.estimate(fan);
        if (fans++ == 0) {
            gradient[v.value] = per_unit(of_fan);
        }
        if (!fan.is_closed) {
            visit_fan(tin.mesh, fan, [&](HalfEdgeId h) {
                own.push_back({h, per_unit(at_corner(of_fan, h)), per_unit(of_fan)});
            });
        }
    });
    if (fans == 1 && !sharp.is_sharp(v)) {
        own.resize(before);  // all have the vertex' own
    }
    return faces;
}

void CornerGradients::State::estimate_all() {
    gradient.resize(tin.vertex_count());
    const std::vector<HalfEdgeId> starts = find_starts(tin.mesh);
    const std::size_t blocks = (tin.vertex_count() + kBlock - 1) / kBlock;
    std::vector<std::vector<Override>> own(blocks);
    std::vector<std::size_t> faces(blocks);
    tbb::enumerable_thread_specific<GradientFit> fits([&] { return GradientFit(tin, sharp, method); });
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        GradientFit& fit = fits.local();
        const std::size_t end = std::min((block + 1) * kBlock, tin.vertex_count());
        for (std::size_t v = block * kBlock; v < end; ++v) {
            gradient[v] = {};
            if (starts[v] != kNoHalfEdge) {
                faces[block] += estimate_around({static_cast<std::uint32_t>(v)}, starts[v], fit, own[block]);
            }
        }
    });
    for (const std::vector<Override>& of_block : own) {
        add_overrides(of_block);
    }
    if (std::accumulate(faces.begin(), faces.end(), std::size_t{0}) != 3 * tin.mesh.count_terrain()) {
        estimate_other_turns(starts);
    }
    std::sort(overrides.begin(), overrides.end(),
              [](const Override& a, const Override& b) { return a.corner < b.corner; });
}

/// Where faces of a file touch at a vertex only, it has more turns than the one that it starts with.
void CornerGradients::State::estimate_other_turns(const std::vector<HalfEdgeId>& starts) {
    const TriangleMesh& mesh = tin.mesh;
    GradientFit fit(tin, sharp, method);
    std::vector<Override> own;
    std::vector<bool> is_done = mark_turns(mesh, starts);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            const HalfEdgeId h = half_edge({f}, corner);
            if (is_done[h.value]) {
                continue;
            }
            const VertexFan fan = find_fan(mesh, sharp, h);
            const Point2 of_fan = fit.estimate(fan);
            visit_fan(mesh, fan, [&](HalfEdgeId each) {
                is_done[each.value] = true;
                own.push_back({each, per_unit(at_corner(of_fan, each)), per_unit(of_fan)});
            });
        }
    }
    add_overrides(own);
}

void CornerGradients::State::add_overrides(const std::vector<Override>& own) {
    if (!own.empty()) {
        has_override.resize(tin.vertex_count());
    }
    for (const Override& each : own) {
        has_override[tin.mesh.origin(each.corner).value] = true;
        overrides.push_back(each);
    }
}

CornerGradients::CornerGradients(const Tin& tin, const SharpEdges& sharp, GradientMethod method) {
    auto state = std::make_unique<State>(tin, sharp, method);
    state->estimate_all();
    state_ = std::move(state);
}

CornerGradients::~CornerGradients() = default;

const Override* CornerGradients::State::find_override(HalfEdgeId corner) const {
    if (has_override.empty() || !has_override[tin.mesh.origin(corner).value]) {
        return nullptr;
    }
    const auto found =
        std::lower_bound(overrides.begin(), overrides.end(), corner,
                         [](const Override& each, HalfEdgeId wanted) { return each.corner < wanted; });
    return found != overrides.end() && found->corner == corner ? &*found : nullptr;
}

/// Weights of the other vertices in a fan's gradient, per step.
std::vector<GradientWeight> CornerGradients::State::stencil(HalfEdgeId corner) const {
    GradientFit fit(tin, sharp, method);
    const std::span<const GradientWeight> found = fit.find_stencil(find_fan(tin.mesh, sharp, corner));
    return {found.begin(), found.end()};
}

/// In units, with the weight of the vertex itself, which makes their sum zero.
std::vector<GradientWeight> CornerGradients::State::with_own(HalfEdgeId corner,
                                                             std::vector<GradientWeight> weights) const {
    Point2 own;
    for (GradientWeight& each : weights) {
        each.weight = per_unit(each.weight);
        own = {own.x - each.weight.x, own.y - each.weight.y};
    }
    weights.push_back({tin.mesh.origin(corner), own});
    return merged(std::move(weights));
}

Point2 CornerGradients::at(HalfEdgeId corner) const {
    const Override* own = state_->find_override(corner);
    return own != nullptr ? own->gradient : state_->gradient[state_->tin.mesh.origin(corner).value];
}

Point2 CornerGradients::of_fan(HalfEdgeId corner) const {
    const Override* own = state_->find_override(corner);
    return own != nullptr ? own->of_fan : state_->gradient[state_->tin.mesh.origin(corner).value];
}

std::vector<GradientWeight> CornerGradients::weights(HalfEdgeId corner) const {
    const State& state = *state_;
    std::vector<GradientWeight> weights = state.stencil(corner);
    const CornerEdges edges(state.tin, state.sharp, corner);
    if (edges.has_sharp()) {
        for (GradientWeight& each : weights) {
            const Point2 change = edges.gradient(edges.is_sharp[0] ? -dot(each.weight, edges.edge[0]) : 0,
                                                 edges.is_sharp[1] ? -dot(each.weight, edges.edge[1]) : 0);
            each.weight = {each.weight.x + change.x, each.weight.y + change.y};
        }
        for (unsigned i = 0; i < 2; ++i) {
            if (edges.is_sharp[i]) {
                weights.push_back({edges.ends[i], edges.gradient(i == 0 ? 1 : 0, i == 0 ? 0 : 1)});
            }
        }
    }
    return state.with_own(corner, std::move(weights));
}

std::vector<GradientWeight> CornerGradients::fan_weights(HalfEdgeId corner) const {
    return state_->with_own(corner, state_->stencil(corner));
}

}  // namespace tinwright
