#include "tinwright/surface/smooth.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/smooth_reader.hpp"
#include "tinwright/surface/spline_store.hpp"

namespace tinwright {

namespace {

constexpr int kFewestNeighbors = 8;  // one an octant
constexpr int kMostNeighbors = 200;  // fitting takes time with their cube
constexpr std::size_t kMostKernels = 32;
constexpr double kMostStretch = 1000;
constexpr double kLeastSmoothExponent = 1.5;

class SmoothInterpolator final : public Interpolator {
  public:
    SmoothInterpolator(const Tin& tin, SharpEdges sharp, SmoothOptions options)
        : sharp_(std::move(sharp)),
          options_(std::move(options)),
          starts_(find_spline_starts(tin.mesh)),
          lattice_(tin),
          sources_{tin, sharp_, starts_, options_},
          store_(sources_) {}

    [[nodiscard]] std::unique_ptr<SurfaceReader> make_reader() const override {
        return std::make_unique<SmoothReader>(sources_, lattice_, store_);
    }

  private:
    SharpEdges sharp_;
    SmoothOptions options_;
    std::vector<HalfEdgeId> starts_;
    QueryLattice lattice_;
    SplineSources sources_;
    mutable SplineStore store_;  // filled on demand; guards itself
};

}  // namespace

void check_smooth(const SmoothOptions& options) {
    // Written so that a NaN is refused.
    if (options.neighbors < kFewestNeighbors || options.neighbors > kMostNeighbors) {
        throw UsageError("a smooth surface takes " + std::to_string(kFewestNeighbors) + " to " +
                         std::to_string(kMostNeighbors) + " neighbours of a vertex, not " +
                         std::to_string(options.neighbors));
    }
    if (!(options.guard >= 0)) {
        throw UsageError("the guard of a smooth surface must be zero or more, or infinite for none");
    }
    if (options.kernels.empty() || options.kernels.size() > kMostKernels) {
        throw UsageError("a smooth surface takes 1 to " + std::to_string(kMostKernels) + " kernels, not " +
                         std::to_string(options.kernels.size()));
    }
    bool is_any_usable = false;
    for (const SmoothOptions::Kernel& kernel : options.kernels) {
        if (!(kernel.exponent >= 0 && kernel.exponent < 4) || kernel.exponent == 2) {
            throw UsageError(
                "the exponent of a kernel must be above 0, below 4 and not 2 (0: the plane), not " +
                decimal_text(kernel.exponent));
        }
        if (!(kernel.stretch >= 1 && kernel.stretch <= kMostStretch)) {
            throw UsageError("the stretch of a kernel must be from 1 to " + decimal_text(kMostStretch) +
                             ", not " + decimal_text(kernel.stretch));
        }
        if (!(kernel.handicap > 0) || !std::isfinite(kernel.handicap)) {
            throw UsageError("the handicap of a kernel must be a number above 0, not " +
                             decimal_text(kernel.handicap));
        }
        is_any_usable = is_any_usable || kernel.exponent >= (options.is_c1 ? kLeastSmoothExponent : 0);
    }
    if (!is_any_usable) {
        throw UsageError(
            "smooth:c1 needs a kernel with an exponent of 1.5 or more: smaller ones have a crease");
    }
}

std::unique_ptr<Interpolator> make_smooth(const Tin& tin, const SharpEdges& sharp,
                                          const SmoothOptions& options) {
    check_smooth(options);
    return std::make_unique<SmoothInterpolator>(tin, sharp, options);
}

}  // namespace tinwright
