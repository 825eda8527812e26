#include "tinwright/surface/spline_fitter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/mesh/border.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/ring_prediction.hpp"
#include "tinwright/surface/stretch_direction.hpp"
#include "tinwright/surface/vertex_fan.hpp"

namespace tinwright {

namespace {

/// A node's error counts for 1 / (kNearness + d^2), d being its distance in units of the reach: nodes at the
/// rim are foretold from one side only.
constexpr double kNearness = 0.3;

}  // namespace

std::vector<HalfEdgeId> find_spline_starts(const TriangleMesh& mesh) {
    std::vector<HalfEdgeId> starts(mesh.vertex_count(), kNoHalfEdge);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            starts[mesh.vertex({f}, corner).value] = half_edge({f}, corner);
        }
    }
    // Each part of the terrain at a vertex, if not all around it, has one border half-edge from there.
    std::vector<bool> has_part(mesh.vertex_count());
    for (const HalfEdgeId h : find_border(mesh)) {
        const std::uint32_t v = mesh.origin(h).value;
        if (has_part[v]) {
            starts[v] = kNoHalfEdge;
        }
        has_part[v] = true;
    }
    return starts;
}

SplineFitter::SplineFitter(const SplineSources& sources)
    : sources_(sources), neighbors_(sources.tin, sources.sharp, sources.options.neighbors) {}

/// Nodes, the vertex first, and what is known of the spline before any kernel.
VertexSpline SplineFitter::place_nodes(std::span<const VertexId> ids) {
    const Tin& tin = sources_.tin;
    const Key2 origin = tin.key(ids.front());
    const double base = tin.z[ids.front().value];
    VertexSpline spline;
    for (const VertexId id : ids) {
        spline.reach = std::max(spline.reach, squared_distance(origin, tin.key(id)));
    }
    spline.reach = std::sqrt(spline.reach);
    nodes_.clear();
    nearness_.clear();
    for (const VertexId id : ids) {
        const Key2 key = tin.key(id);
        const double x = (key.x - origin.x) / spline.reach;
        const double y = (key.y - origin.y) / spline.reach;
        const double z = tin.z[id.value] - base;
        nodes_.push_back({x, y, z});
        nearness_.push_back(1 / (kNearness + x * x + y * y));
        spline.lowest = std::min(spline.lowest, z);
        spline.highest = std::max(spline.highest, z);
    }
    spline.node_count = static_cast<std::uint32_t>(ids.size());
    return spline;
}

/// Of the nodes, each left out in turn.
double SplineFitter::expected_error() const {
    const std::span<const double> errors = spline_.errors();
    double sum = 0;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        sum += nearness_[i] * std::abs(errors[i]);
    }
    return sum;
}

bool SplineFitter::is_usable(const SmoothOptions::Kernel& kernel) const {
    return kernel.exponent > 0 && (!sources_.options.is_c1 || kernel.exponent >= 1.5);
}

/// Whether the planes of faces predict the vertex and those joined to it better than the best spline.
bool SplineFitter::is_plane_better(double handicap) const {
    const TriangleMesh& mesh = sources_.tin.mesh;
    double of_planes = 0;
    double of_spline = 0;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
        const bool is_central =
            i == 0 || find_half_edge(mesh, sources_.starts[ids_.front().value], ids_[i]).has_value();
        const HalfEdgeId corner = sources_.starts[ids_[i].value];
        const std::optional<double> error =
            is_central && corner != kNoHalfEdge
                ? ring_prediction_error(sources_.tin, find_fan(mesh, sources_.sharp, corner))
                : std::nullopt;
        if (error) {
            of_planes += std::abs(*error);
            of_spline += std::abs(best_errors_[i]);
        }
    }
    return of_planes * handicap < of_spline;
}

VertexSpline SplineFitter::fit(VertexId v, std::vector<VertexId>& nodes, std::vector<double>& coefficients) {
    const HalfEdgeId corner = sources_.starts[v.value];
    if (corner == kNoHalfEdge || sources_.sharp.is_sharp(v)) {
        return {};
    }
    const Tin& tin = sources_.tin;
    const VertexFan fan = find_fan(tin.mesh, sources_.sharp, corner);
    const std::span<const VertexId> found = neighbors_.find(fan);
    ids_.assign(1, v);
    ids_.insert(ids_.end(), found.begin(), found.end());
    VertexSpline best = place_nodes(ids_);
    if (!spline_.set_nodes(nodes_)) {
        return {};
    }
    const Point2 change = find_direction_of_change(tin, sources_.sharp, fan);
    const std::vector<SmoothOptions::Kernel>& kernels = sources_.options.kernels;
    const auto first = static_cast<std::ptrdiff_t>(coefficients.size());
    double least = std::numeric_limits<double>::infinity();
    double plane_handicap = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const SmoothOptions::Kernel& kernel = kernels[k];
        if (kernel.exponent == 0) {
            plane_handicap = std::min(plane_handicap, kernel.handicap);
        }
        const Stretch stretch{change, kernel.stretch};
        if (!is_usable(kernel) || !spline_.fit({kernel.exponent}, stretch)) {
            continue;
        }
        const double error = kernel.handicap * expected_error();
        if (error < least) {
            least = error;
            best.kernel = static_cast<std::uint8_t>(k);
            best.stretch = stretch;
            best.gradient = spline_.gradient();
            const std::span<const double> of_nodes = spline_.coefficients();
            coefficients.erase(coefficients.begin() + first, coefficients.end());
            coefficients.insert(coefficients.end(), of_nodes.begin(), of_nodes.end());
            best_errors_.assign(spline_.errors().begin(), spline_.errors().end());
        }
    }
    if (best.kernel == VertexSpline::kPlane || (plane_handicap < std::numeric_limits<double>::infinity() &&
                                                !sources_.options.is_c1 && is_plane_better(plane_handicap))) {
        coefficients.erase(coefficients.begin() + first, coefficients.end());
        return {};
    }
    nodes.insert(nodes.end(), ids_.begin(), ids_.end());
    return best;
}

LocalSpline* SplineFitter::fit_again(const VertexSpline& spline, std::span<const VertexId> nodes) {
    if (spline.kernel == VertexSpline::kPlane) {
        return nullptr;
    }
    place_nodes(nodes);
    const double exponent = sources_.options.kernels[spline.kernel].exponent;
    return spline_.set_nodes(nodes_) && spline_.fit({exponent}, spline.stretch) ? &spline_ : nullptr;
}

}  // namespace tinwright
