#include "tinwright/surface/natural_neighbor.hpp"

#include <array>
#include <optional>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/surface/neighbor_blend.hpp"
#include "tinwright/surface/neighbor_cavity.hpp"

namespace tinwright {

namespace {

using Kind = NaturalNeighborOptions::Kind;

/// The gradient of a face's plane.
Point2 gradient_of(const Tin& tin, FaceId f, double step) {
    const auto& v = tin.mesh.face(f).vertex;
    const std::array<Key2, 3> key{tin.key(v[0]), tin.key(v[1]), tin.key(v[2])};
    const double y_z = tin.z[v[1].value] - tin.z[v[0].value];
    const double w_z = tin.z[v[2].value] - tin.z[v[0].value];
    const double scale = doubled_area(key[0], key[1], key[2]) * step;
    return {(y_z * (key[2].y - key[0].y) - w_z * (key[1].y - key[0].y)) / scale,
            (w_z * (key[1].x - key[0].x) - y_z * (key[2].x - key[0].x)) / scale};
}

/// What all readers of one surface share.
struct Surface {
    Surface(const Tin& own, const SharpEdges& sharp, const NaturalNeighborOptions& options)
        : tin(own), kind(options.kind), lattice(own), mesh(own, sharp, lattice) {
        if (kind == Kind::C1) {
            gradients.emplace(mesh.tin(), mesh.sharp(), options.gradients);
        }
    }

    const Tin& tin;
    Kind kind;
    QueryLattice lattice;
    NeighborMesh mesh;
    std::optional<CornerGradients> gradients;  // of the mesh's TIN
};

class NaturalNeighborReader final : public SurfaceReader {
  public:
    explicit NaturalNeighborReader(const Surface& surface)
        : surface_(surface),
          share_kind_(surface.kind == Kind::Laplace ? ShareKind::Laplace : ShareKind::Sibson),
          cavity_(surface.mesh, surface.lattice) {
        if (surface.gradients) {
            blend_.emplace(surface.mesh, surface.lattice, *surface.gradients);
        }
    }

    double elevation(const SurfacePlace& place) override;
    SurfaceReading read(const SurfacePlace& place) override;
    void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) override;

  private:
    [[nodiscard]] double z(VertexId v) const { return surface_.tin.z[v.value]; }
    [[nodiscard]] NeighborPlace find(const SurfacePlace& place) const { return surface_.mesh.find(place); }
    [[nodiscard]] SurfaceReading read_vertex(const SurfacePlace& place, const NeighborPlace& vertex) const;
    /// Sums over the neighbours; elevations count from the first one's, so that their size costs nothing.
    [[nodiscard]] double mean() const;
    [[nodiscard]] SurfaceReading mean_with_gradient() const;

    const Surface& surface_;
    ShareKind share_kind_;
    NeighborCavity cavity_;
    std::optional<NeighborBlend> blend_;  // for C1
};

double NaturalNeighborReader::elevation(const SurfacePlace& place) {
    const NeighborPlace at = find(place);
    if (at.kind == NeighborPlace::Kind::Vertex) {
        return z(surface_.mesh.tin().mesh.origin(at.edge));
    }
    cavity_.find(at, place.at, share_kind_);
    return blend_ ? blend_->elevation(cavity_) : mean();
}

SurfaceReading NaturalNeighborReader::read(const SurfacePlace& place) {
    const NeighborPlace at = find(place);
    if (at.kind == NeighborPlace::Kind::Vertex) {
        return read_vertex(place, at);
    }
    cavity_.find_with_gradients(at, place.at, share_kind_);
    return blend_ ? blend_->read(cavity_) : mean_with_gradient();
}

void NaturalNeighborReader::find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) {
    const NeighborPlace at = find(place);
    weights.clear();
    if (at.kind == NeighborPlace::Kind::Vertex) {
        weights.push_back({surface_.mesh.tin().mesh.origin(at.edge), 1});
        return;
    }
    cavity_.find(at, place.at, share_kind_);
    if (blend_) {
        blend_->find_weights(cavity_, weights);
        return;
    }
    double sum = 0;
    for (const NaturalNeighbor& neighbor : cavity_.neighbors()) {
        sum += neighbor.share;
    }
    for (const NaturalNeighbor& neighbor : cavity_.neighbors()) {
        weights.push_back({neighbor.vertex, neighbor.share / sum});
    }
}

SurfaceReading NaturalNeighborReader::read_vertex(const SurfacePlace& place,
                                                  const NeighborPlace& vertex) const {
    return {z(surface_.mesh.tin().mesh.origin(vertex.edge)),
            surface_.gradients ? surface_.gradients->at(vertex.edge)
                               : gradient_of(surface_.tin, place.face, surface_.tin.lattice.quantum())};
}

double NaturalNeighborReader::mean() const {
    const double base = z(cavity_.neighbors().front().vertex);
    double sum = 0;
    double total = 0;
    for (const NaturalNeighbor& neighbor : cavity_.neighbors()) {
        total += neighbor.share;
        sum += neighbor.share * (z(neighbor.vertex) - base);
    }
    return base + sum / total;
}

SurfaceReading NaturalNeighborReader::mean_with_gradient() const {
    const double mean_z = mean();
    const double base = z(cavity_.neighbors().front().vertex);
    const double above_base = mean_z - base;
    double total = 0;
    Point2 sum{0, 0};
    for (std::size_t i = 0; i < cavity_.neighbors().size(); ++i) {
        const NaturalNeighbor& neighbor = cavity_.neighbors()[i];
        const Point2 gradient = cavity_.gradients()[i];
        const double above = (z(neighbor.vertex) - base) - above_base;
        total += neighbor.share;
        sum.x += gradient.x * above;
        sum.y += gradient.y * above;
    }
    const double scale = total * surface_.lattice.step();
    return {mean_z, {sum.x / scale, sum.y / scale}};
}

class NaturalNeighborInterpolator final : public Interpolator {
  public:
    NaturalNeighborInterpolator(const Tin& tin, const SharpEdges& sharp,
                                const NaturalNeighborOptions& options)
        : surface_(tin, sharp, options) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        return std::make_unique<NaturalNeighborReader>(surface_);
    }

  private:
    Surface surface_;
};

}  // namespace

std::unique_ptr<Interpolator> make_natural_neighbor(const Tin& tin, const SharpEdges& sharp,
                                                    const NaturalNeighborOptions& options) {
    return std::make_unique<NaturalNeighborInterpolator>(tin, sharp, options);
}

}  // namespace tinwright
