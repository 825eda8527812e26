#include "tinwright/surface/facets.hpp"

#include <utility>

#include "tinwright/surface/linear.hpp"

namespace tinwright {

namespace {

class FacetsReader final : public SurfaceReader {
  public:
    FacetsReader(const std::vector<bool>& is_facet, std::unique_ptr<SurfaceReader> surface,
                 std::unique_ptr<SurfaceReader> facets)
        : is_facet_(is_facet), surface_(std::move(surface)), facets_(std::move(facets)) {}

    double elevation(const SurfacePlace& place) override { return reader_of(place).elevation(place); }
    SurfaceReading read(const SurfacePlace& place) override { return reader_of(place).read(place); }
    void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) override {
        reader_of(place).find_weights(place, weights);
    }

  private:
    [[nodiscard]] SurfaceReader& reader_of(const SurfacePlace& place) const {
        return is_facet_[place.face.value] ? *facets_ : *surface_;
    }

    const std::vector<bool>& is_facet_;
    std::unique_ptr<SurfaceReader> surface_;
    std::unique_ptr<SurfaceReader> facets_;
};

class FacetsInterpolator final : public Interpolator {
  public:
    FacetsInterpolator(const Tin& tin, std::unique_ptr<Interpolator> surface, std::vector<bool> is_facet)
        : surface_(std::move(surface)), facets_(make_linear(tin)), is_facet_(std::move(is_facet)) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        return std::make_unique<FacetsReader>(is_facet_, surface_->make_reader(), facets_->make_reader());
    }
    [[nodiscard]] bool is_facet(FaceId face) const override {
        return is_facet_[face.value] || surface_->is_facet(face);
    }

  private:
    std::unique_ptr<Interpolator> surface_;
    std::unique_ptr<Interpolator> facets_;
    std::vector<bool> is_facet_;
};

}  // namespace

std::unique_ptr<Interpolator> keep_facets(const Tin& tin, std::unique_ptr<Interpolator> surface,
                                          std::vector<bool> is_facet) {
    if (surface == nullptr || is_facet.empty()) {
        return surface;
    }
    return std::make_unique<FacetsInterpolator>(tin, std::move(surface), std::move(is_facet));
}

}  // namespace tinwright
