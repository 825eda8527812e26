#include "tinwright/surface/smooth_reader.hpp"

#include <algorithm>
#include <cmath>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/surface/vertex_fan.hpp"
#include "tinwright/surface/weight_sums.hpp"

namespace tinwright {

namespace {

double inner(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

}  // namespace

SmoothReader::SmoothReader(const SplineSources& sources, const QueryLattice& lattice, SplineStore& store)
    : sources_(sources), lattice_(lattice), store_(store), fitter_(sources), slots_(kSlots) {}

void SmoothReader::enter(FaceId face) {
    if (face == face_) {
        return;
    }
    face_ = face;
    // The corner with the smallest id first, so that the surface does not depend on where the face starts.
    const Tin& tin = sources_.tin;
    const auto& v = tin.mesh.face(face).vertex;
    unsigned first = v[1] < v[0] ? 1 : 0;
    first = v[2] < v[first] ? 2 : first;
    corner_ = {first, next_corner(first), previous_corner(first)};
    for (unsigned i = 0; i < 3; ++i) {
        vertex_[i] = v[corner_[i]];
        key_[i] = lattice_.scaled(tin.key(vertex_[i]));
        z_[i] = tin.z[vertex_[i].value];
    }
    area_ = doubled_area(key_[0], key_[1], key_[2]);
    for (unsigned i = 0; i < 3; ++i) {
        const Key2 from = key_[(i + 1) % 3];
        const Key2 to = key_[(i + 2) % 3];
        share_gradient_[i] = {(from.y - to.y) / area_, (to.x - from.x) / area_};
        foot_[i] = sources_.options.is_c1 ? foot(i) : 0.5;
    }
}

/// Where on the edge opposite a corner the derivative across it points to the centroid: along the line from
/// the corner to the one of the face beyond, which is the same line for both faces.
double SmoothReader::foot(unsigned corner) const {
    const TriangleMesh& mesh = sources_.tin.mesh;
    const HalfEdgeId opposite = half_edge(face_, next_corner(corner_[corner]));
    if (is_wall(mesh, sources_.sharp, opposite)) {
        return 0.5;
    }
    const Key2 beyond = lattice_.scaled(sources_.tin.key(mesh.origin(previous(mesh.twin(opposite)))));
    const double from = doubled_area(key_[corner], beyond, key_[(corner + 1) % 3]);
    const double to = doubled_area(key_[corner], beyond, key_[(corner + 2) % 3]);
    // Far outside an edge that is short for its faces, shares would leave [0, 1] by far: a crease is better
    // there.
    const double crossing = std::clamp(from / (from - to), -7.0, 8.0);
    return (1 + crossing) / 3;
}

/// Exact areas over an exact area, so good for needles too, and 1 and 0 at a vertex.
std::array<double, 3> SmoothReader::shares(Key2 at) const {
    const auto& [a, b, c] = key_;
    return {doubled_area(at, b, c) / area_, doubled_area(a, at, c) / area_, doubled_area(a, b, at) / area_};
}

const SmoothReader::Unpacked& SmoothReader::unpack(VertexId v) {
    Unpacked& slot = slots_[v.value % kSlots];
    if (slot.vertex != v) {
        unpack(v, slot);
    }
    return slot;
}

void SmoothReader::unpack(VertexId v, Unpacked& to) {
    const Tin& tin = sources_.tin;
    to.vertex = v;
    const auto block = store_.block_of(v, fitter_);
    const SplineBlock::View view = block->view(v);
    to.is_plane = view.spline.kernel == VertexSpline::kPlane;
    if (to.is_plane) {
        return;
    }
    to.kernel = {sources_.options.kernels[view.spline.kernel].exponent};
    to.stretch = view.spline.stretch;
    to.gradient = view.spline.gradient;
    to.inverse = 1 / (view.spline.reach * lattice_.scale());
    to.guard = sources_.options.guard * (view.spline.highest - view.spline.lowest);
    to.lowest = view.spline.lowest;
    to.highest = view.spline.highest;
    const std::size_t count = view.nodes.size();
    const std::size_t padded = (count + kRadialStep - 1) / kRadialStep * kRadialStep;
    for (std::vector<double>* array : {&to.x, &to.y, &to.c}) {
        array->assign(padded, 0.0);
    }
    const Key2 origin = tin.key(v);
    const double inverse = 1 / view.spline.reach;
    for (std::size_t i = 0; i < count; ++i) {
        const Key2 key = tin.key(view.nodes[i]);
        const Point2 stretched = to.stretch({(key.x - origin.x) * inverse, (key.y - origin.y) * inverse});
        to.x[i] = stretched.x;
        to.y[i] = stretched.y;
        to.c[i] = view.coefficients[i];
    }
    to.at_vertex = sum_kernel(to.kernel, to.x, to.y, to.c, to.stretch({0, 0}));
}

template <bool kWithGradient>
SmoothReader::Local SmoothReader::local(unsigned corner, Key2 at, const std::array<double, 3>& share) {
    const Unpacked& spline = unpack(vertex_[corner]);
    Local local;
    if (spline.is_plane) {
        for (unsigned i = 0; i < 3; ++i) {
            const double rise = z_[i] - z_[corner];
            local.z += share[i] * rise;
            local.gradient.x += share_gradient_[i].x * rise;
            local.gradient.y += share_gradient_[i].y * rise;
        }
        return local;
    }
    const Point2 p{(at.x - key_[corner].x) * spline.inverse, (at.y - key_[corner].y) * spline.inverse};
    const Point2 stretched = spline.stretch(p);
    local.z = inner(spline.gradient, p) +
              (sum_kernel(spline.kernel, spline.x, spline.y, spline.c, stretched) - spline.at_vertex);
    if constexpr (kWithGradient) {
        const Point2 curved = spline.stretch.pull_back(
            sum_kernel_gradient(spline.kernel, spline.x, spline.y, spline.c, stretched));
        local.gradient = {(spline.gradient.x + curved.x) * spline.inverse,
                          (spline.gradient.y + curved.y) * spline.inverse};
    }
    apply_guard(spline, local);
    return local;
}

/// Keeps a spline within its nodes' range and what is granted beyond: sharply, or with a gradient that ends
/// where the second half of the grant does.
void SmoothReader::apply_guard(const Unpacked& spline, Local& local) const {
    const bool is_above = local.z > spline.highest;
    const double excess = is_above ? local.z - spline.highest : spline.lowest - local.z;
    const double free = sources_.options.is_c1 ? spline.guard / 2 : spline.guard;
    if (!(excess > free)) {
        return;
    }
    double kept = free;
    double slope = 0;
    if (sources_.options.is_c1 && excess < free + 2 * free) {
        // A parabola from slope one at `free` to slope zero at twice as much beyond it as it rises.
        const double beyond = excess - free;
        kept = free + beyond * (1 - beyond / (4 * free));
        slope = 1 - beyond / (2 * free);
    } else if (sources_.options.is_c1) {
        kept = 2 * free;
    }
    local.z = is_above ? spline.highest + kept : spline.lowest - kept;
    local.gradient = {local.gradient.x * slope, local.gradient.y * slope};
}

template <bool kWithGradient>
SurfaceReading SmoothReader::evaluate(const SurfacePlace& place) {
    enter(place.face);
    const std::array<double, 3> share = shares(place.at);
    const FaceBlend blend = sources_.options.is_c1 ? blend_smoothly(share, foot_) : blend_linearly(share);
    SurfaceReading reading;
    double rise = 0;  // above the first corner
    for (unsigned i = 0; i < 3; ++i) {
        const Local part = local<kWithGradient>(i, place.at, share);
        const double z = (z_[i] - z_[0]) + part.z;
        rise += blend.share[i] * z;
        if constexpr (kWithGradient) {
            Point2 slope{};
            for (unsigned j = 0; j < 3; ++j) {
                slope.x += blend.slope[i][j] * share_gradient_[j].x;
                slope.y += blend.slope[i][j] * share_gradient_[j].y;
            }
            reading.gradient.x += slope.x * z + blend.share[i] * part.gradient.x;
            reading.gradient.y += slope.y * z + blend.share[i] * part.gradient.y;
        }
    }
    reading.z = z_[0] + rise;
    for (unsigned i = 0; i < 3; ++i) {
        reading.z = place.at == key_[i] ? z_[i] : reading.z;
    }
    if constexpr (kWithGradient) {
        const double step = lattice_.step();
        reading.gradient = {reading.gradient.x / step, reading.gradient.y / step};
    }
    return reading;
}

double SmoothReader::elevation(const SurfacePlace& place) { return evaluate<false>(place).z; }

SurfaceReading SmoothReader::read(const SurfacePlace& place) { return evaluate<true>(place); }

void SmoothReader::find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) {
    enter(place.face);
    weights.clear();
    for (unsigned i = 0; i < 3; ++i) {
        if (place.at == key_[i]) {
            weights.push_back({vertex_[i], 1});
            return;
        }
    }
    const std::array<double, 3> share = shares(place.at);
    const FaceBlend blend = sources_.options.is_c1 ? blend_smoothly(share, foot_) : blend_linearly(share);
    for (unsigned i = 0; i < 3; ++i) {
        add_weights(i, place.at, share, blend.share[i], weights);
    }
    sum_weights(weights);
}

/// Fits the spline of a corner once more: its shares are not kept.
void SmoothReader::add_weights(unsigned corner, Key2 at, const std::array<double, 3>& share, double factor,
                               std::vector<VertexWeight>& weights) {
    const auto block = store_.block_of(vertex_[corner], fitter_);
    const SplineBlock::View view = block->view(vertex_[corner]);
    LocalSpline* const spline = fitter_.fit_again(view.spline, view.nodes);
    if (spline == nullptr) {
        for (unsigned i = 0; i < 3; ++i) {
            weights.push_back({vertex_[i], factor * share[i]});
        }
        return;
    }
    const double inverse = 1 / (view.spline.reach * lattice_.scale());
    std::vector<double> of_nodes(view.nodes.size());
    spline->find_weights({(at.x - key_[corner].x) * inverse, (at.y - key_[corner].y) * inverse}, of_nodes);
    for (std::size_t i = 0; i < of_nodes.size(); ++i) {
        weights.push_back({view.nodes[i], factor * of_nodes[i]});
    }
}

}  // namespace tinwright
