#ifndef TINWRIGHT_SURFACE_NEIGHBOR_BLEND_HPP
#define TINWRIGHT_SURFACE_NEIGHBOR_BLEND_HPP

#include <vector>

#include "tinwright/surface/gradients.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/neighbor_cavity.hpp"

/// Sibson's C1 surface [sibson1981].
///
/// With the areas a_i that q takes from its neighbours p_i, their distances d_i, elevations z_i, and the
/// elevation t_i that the neighbour's tangent plane has at q, let
///     D = sum a_i,        N = sum a_i z_i,       U = sum a_i d_i,   V = sum a_i d_i^2,
///     P = sum a_i / d_i,  Q = sum a_i t_i / d_i.
/// N / D is Sibson's mean, Q / P the mean of the tangent planes, the near ones counting more. They are mixed
/// in the ratio (U / P) : (V / D), which makes errors of a (x^2 + y^2) cancel:
///     z = (U N + V Q) / (U D + V P).
///
/// *Sharp edges.* So that both sides of the edge agree, the surface is linear there: the tangent plane of an
/// end b is tilted along the edge by phi times what it lacks to the edge's own slope. phi = l^2 / (1 + l^2 +
/// m^2), where l is the difference of the cotangents under which the face of the cavity and q see the edge: 0
/// where the face joins the cavity, infinite on the edge; m is the same for the other rim edge that ends at b
/// if it is sharp too, else 0.
namespace tinwright {

class NeighborBlend {
  public:
    NeighborBlend(const NeighborMesh& mesh, const QueryLattice& lattice, const CornerGradients& gradients)
        : mesh_(mesh), lattice_(lattice), gradients_(gradients) {}

    /// `cavity`: with Sibson's shares.
    [[nodiscard]] double elevation(const NeighborCavity& cavity);
    /// With their gradients.
    [[nodiscard]] SurfaceReading read(const NeighborCavity& cavity);
    void find_weights(const NeighborCavity& cavity, std::vector<VertexWeight>& weights);

  private:
    /// The sharp rim edge from a neighbour to another: l and its gradient per step.
    struct Seen {
        bool is_sharp = false;
        bool is_here = false;    // the place is on it: l is infinite
        std::size_t before = 0;  // the neighbour whose edge ends where this one begins
        double l = 0;
        Point2 gradient{};
    };
    /// How far a neighbour's tangent plane is tilted along an edge: phi and its gradient per step.
    struct Tilt {
        double phi = 0;
        Point2 gradient{};
    };
    /// A tangent plane at the place, above the base elevation, and its gradient per step.
    struct Tangent {
        double z = 0;
        Point2 gradient{};
    };

    void look(const NeighborCavity& cavity);
    [[nodiscard]] Seen see(const NeighborCavity& cavity, std::size_t i) const;
    static Tilt tilt(const Seen& edge, const Seen& other);
    template <class Visit>
    void visit_tilts(const NeighborCavity& cavity, std::size_t i, const Visit& visit) const;
    [[nodiscard]] Tangent tangent(const NeighborCavity& cavity, std::size_t i, double base) const;
    /// What elevations are counted from.
    [[nodiscard]] double base_of(const NeighborCavity& cavity) const;
    [[nodiscard]] double z(VertexId v) const { return mesh_.tin().z[v.value]; }

    const NeighborMesh& mesh_;
    const QueryLattice& lattice_;
    const CornerGradients& gradients_;
    std::vector<Seen> seen_;  // by neighbour: its edge to the next; empty without sharp edges around
};

}  // namespace tinwright

#endif
