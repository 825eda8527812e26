#include "tinwright/surface/nearest.hpp"

#include "tinwright/surface/sample_tree.hpp"

namespace tinwright {

namespace {

class NearestReader final : public SurfaceReader {
  public:
    NearestReader(const Tin& tin, const SampleTree& tree) : tin_(tin), tree_(tree) {}

    double elevation(const SurfacePlace& place) override { return tin_.z[find(place).value]; }

    SurfaceReading read(const SurfacePlace& place) override { return {elevation(place), {}}; }

    void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) override {
        weights.assign(1, {find(place), 1});
    }

  private:
    VertexId find(const SurfacePlace& place) {
        last_ = tree_.nearest(place.at, last_);
        return *last_;  // a TIN with faces has vertices
    }

    const Tin& tin_;
    const SampleTree& tree_;
    std::optional<VertexId> last_;
};

class NearestInterpolator final : public Interpolator {
  public:
    explicit NearestInterpolator(const Tin& tin) : tin_(tin), tree_(tin) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        return std::make_unique<NearestReader>(tin_, tree_);
    }

  private:
    const Tin& tin_;
    SampleTree tree_;
};

}  // namespace

std::unique_ptr<Interpolator> make_nearest(const Tin& tin) {
    return std::make_unique<NearestInterpolator>(tin);
}

}  // namespace tinwright
