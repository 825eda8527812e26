#include "tinwright/surface/neighbor_blend.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "tinwright/surface/step_vectors.hpp"
#include "tinwright/surface/weight_sums.hpp"

namespace tinwright {

namespace {

using steps::add;
using steps::dot;
using steps::precise_cross;
using steps::square;
using steps::turned;
using steps::vector_between;
using steps::vector_to;

/// The sums of the same letters.
struct BlendSums {
    double d = 0;
    double n = 0;
    double u = 0;
    double v = 0;
    double p = 0;
    double q = 0;

    [[nodiscard]] double over() const { return u * n + v * q; }
    [[nodiscard]] double under() const { return u * d + v * p; }
};

/// Adds a neighbour: area, distance, elevation, and that of its tangent plane.
void add_neighbor(BlendSums& sums, double area, double distance, double z, double tangent) {
    const double near = area / distance;
    sums.d += area;
    sums.n += area * z;
    sums.u += area * distance;
    sums.v += area * distance * distance;
    sums.p += near;
    sums.q += near * tangent;
}

}  // namespace

void NeighborBlend::look(const NeighborCavity& cavity) {
    seen_.clear();
    if (!mesh_.sharp().is_empty()) {
        for (std::size_t i = 0; i < cavity.neighbors().size(); ++i) {
            seen_.push_back(see(cavity, i));
        }
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            seen_[cavity.neighbors()[i].next].before = i;
        }
    }
}

NeighborBlend::Seen NeighborBlend::see(const NeighborCavity& cavity, std::size_t i) const {
    const std::span<const NaturalNeighbor> all = cavity.neighbors();
    Seen seen;
    seen.is_sharp = mesh_.sharp().is_sharp(all[i].edge);
    seen.is_here = seen.is_sharp && i == 0 && cavity.is_on_edge();
    if (!seen.is_sharp || seen.is_here) {
        return seen;
    }
    const Tin& tin = mesh_.tin();
    const Key2 apex = lattice_.scaled(tin.key(tin.mesh.origin(previous(all[i].edge))));
    const Key2 a = lattice_.scaled(tin.key(all[i].vertex));
    const internal::LocalKey& at_a = all[i].at;
    const internal::LocalKey& at_b = all[all[i].next].at;
    const Point2 to_a{a.x - apex.x, a.y - apex.y};
    const Point2 side = vector_between(at_a, at_b);
    const Point2 to_b{to_a.x + side.x, to_a.y + side.y};
    const double d = precise_cross(vector_to(at_a), vector_to(at_b));
    const double of_place = dot(vector_to(at_a), vector_to(at_b)) / d;
    seen.l = dot(to_a, to_b) / precise_cross(to_a, to_b) - of_place;
    // The gradient of a x b is b - a turned counter-clockwise, that of a b is -(a + b).
    add(seen.gradient, 1 / d, {at_a.x + at_b.x, at_a.y + at_b.y});
    add(seen.gradient, -of_place / d, turned(side));
    return seen;
}

NeighborBlend::Tilt NeighborBlend::tilt(const Seen& edge, const Seen& other) {
    if (!edge.is_sharp || edge.is_here || other.is_here) {
        return {edge.is_here ? 1.0 : 0.0, {0, 0}};
    }
    const double m = other.is_sharp ? other.l : 0;
    const double under = 1 + edge.l * edge.l + m * m;
    Tilt tilt{edge.l * edge.l / under, {0, 0}};
    add(tilt.gradient, 2 * edge.l * (1 + m * m) / (under * under), edge.gradient);
    if (other.is_sharp) {
        add(tilt.gradient, -2 * m * edge.l * edge.l / (under * under), other.gradient);
    }
    return tilt;
}

template <class Visit>
void NeighborBlend::visit_tilts(const NeighborCavity& cavity, std::size_t i, const Visit& visit) const {
    if (seen_.empty()) {
        return;
    }
    const Seen& out = seen_[i];
    const Seen& in = seen_[out.before];
    if (out.is_sharp) {
        visit(cavity.neighbors()[i].next, tilt(out, in));
    }
    if (in.is_sharp) {
        visit(out.before, tilt(in, out));
    }
}

NeighborBlend::Tangent NeighborBlend::tangent(const NeighborCavity& cavity, std::size_t i,
                                              double base) const {
    const NaturalNeighbor& neighbor = cavity.neighbors()[i];
    const Point2 gradient = gradients_.of_fan(neighbor.edge);
    const double step = lattice_.step();
    const Point2 slope{gradient.x * step, gradient.y * step};
    const double above = z(neighbor.vertex) - base;
    Tangent tangent{above - dot(slope, vector_to(neighbor.at)), slope};
    visit_tilts(cavity, i, [&](std::size_t to, const Tilt& tilt) {
        const NaturalNeighbor& end = cavity.neighbors()[to];
        const Point2 edge = vector_between(neighbor.at, end.at);
        const double lack = (z(end.vertex) - z(neighbor.vertex)) - dot(slope, edge);
        const double way = -dot(vector_to(neighbor.at), edge) / square(edge);
        tangent.z += tilt.phi * lack * way;
        add(tangent.gradient, lack * way, tilt.gradient);
        add(tangent.gradient, tilt.phi * lack / square(edge), edge);
    });
    return tangent;
}

// The nearest neighbour's: close to it, where gradients are differences of what is large, all is small then.
double NeighborBlend::base_of(const NeighborCavity& cavity) const {
    const std::span<const NaturalNeighbor> all = cavity.neighbors();
    const auto nearest = std::min_element(
        all.begin(), all.end(), [](const auto& a, const auto& b) { return a.at.square < b.at.square; });
    return z(nearest->vertex);
}

double NeighborBlend::elevation(const NeighborCavity& cavity) {
    look(cavity);
    const double base = base_of(cavity);
    BlendSums sums;
    for (std::size_t i = 0; i < cavity.neighbors().size(); ++i) {
        const NaturalNeighbor& neighbor = cavity.neighbors()[i];
        add_neighbor(sums, neighbor.share, std::sqrt(neighbor.at.square), z(neighbor.vertex) - base,
                     tangent(cavity, i, base).z);
    }
    return base + sums.over() / sums.under();
}

SurfaceReading NeighborBlend::read(const NeighborCavity& cavity) {
    look(cavity);
    const double base = base_of(cavity);
    BlendSums sums;
    BlendSums along_x;
    BlendSums along_y;
    for (std::size_t i = 0; i < cavity.neighbors().size(); ++i) {
        const NaturalNeighbor& neighbor = cavity.neighbors()[i];
        const double distance = std::sqrt(neighbor.at.square);
        const double above = z(neighbor.vertex) - base;
        const Tangent plane = tangent(cavity, i, base);
        add_neighbor(sums, neighbor.share, distance, above, plane.z);
        const auto add_derivative = [&](BlendSums& rate, double area_rate, double toward,
                                        double tangent_rate) {
            // The distance falls by the way towards the neighbour over itself.
            const double distance_rate = -toward / distance;
            const double near_rate = (area_rate - neighbor.share * distance_rate / distance) / distance;
            rate.d += area_rate;
            rate.n += area_rate * above;
            rate.u += area_rate * distance + neighbor.share * distance_rate;
            rate.v += area_rate * distance * distance + 2 * neighbor.share * distance * distance_rate;
            rate.p += near_rate;
            rate.q += near_rate * plane.z + neighbor.share / distance * tangent_rate;
        };
        add_derivative(along_x, cavity.gradients()[i].x, neighbor.at.x, plane.gradient.x);
        add_derivative(along_y, cavity.gradients()[i].y, neighbor.at.y, plane.gradient.y);
    }
    const double value = sums.over() / sums.under();
    const auto slope = [&](const BlendSums& rate) {
        const double over = rate.u * sums.n + sums.u * rate.n + rate.v * sums.q + sums.v * rate.q;
        const double under = rate.u * sums.d + sums.u * rate.d + rate.v * sums.p + sums.v * rate.p;
        return (over - value * under) / (sums.under() * lattice_.step());
    };
    return {base + value, {slope(along_x), slope(along_y)}};
}

void NeighborBlend::find_weights(const NeighborCavity& cavity, std::vector<VertexWeight>& weights) {
    look(cavity);
    const std::span<const NaturalNeighbor> all = cavity.neighbors();
    BlendSums sums;
    for (const NaturalNeighbor& neighbor : all) {
        add_neighbor(sums, neighbor.share, std::sqrt(neighbor.at.square), 0, 0);
    }
    weights.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double near = all[i].share / std::sqrt(all[i].at.square);
        const double of_tangent = sums.v * near / sums.under();
        weights.push_back({all[i].vertex, sums.u * all[i].share / sums.under() + of_tangent});
        Point2 of_gradient{0, 0};
        add(of_gradient, -of_tangent, vector_to(all[i].at));
        visit_tilts(cavity, i, [&](std::size_t to, const Tilt& tilt) {
            const Point2 edge = vector_between(all[i].at, all[to].at);
            const double share = -of_tangent * tilt.phi * dot(vector_to(all[i].at), edge) / square(edge);
            weights.push_back({all[to].vertex, share});
            weights.push_back({all[i].vertex, -share});
            add(of_gradient, -share, edge);
        });
        for (const GradientWeight& part : gradients_.fan_weights(all[i].edge)) {
            weights.push_back({part.vertex, lattice_.step() * dot(of_gradient, part.weight)});
        }
    }
    sum_weights(weights);
}

}  // namespace tinwright
