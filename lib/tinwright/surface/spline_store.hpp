#ifndef TINWRIGHT_SURFACE_SPLINE_STORE_HPP
#define TINWRIGHT_SURFACE_SPLINE_STORE_HPP

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/spline_fitter.hpp"

namespace tinwright {

/// The splines of the vertices from one multiple of kBlock to the next, which are neighbours on the curve.
class SplineBlock {
  public:
    static constexpr std::uint32_t kBlock = 64;

    SplineBlock(SplineFitter& fitter, std::uint32_t first, std::uint32_t last);

    struct View {
        const VertexSpline& spline;
        std::span<const VertexId> nodes;
        std::span<const double> coefficients;
    };
    [[nodiscard]] View view(VertexId v) const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    std::uint32_t first_;
    std::vector<VertexSpline> splines_;
    std::vector<std::uint32_t> starts_;  // of each spline's nodes and coefficients
    std::vector<VertexId> nodes_;
    std::vector<double> coefficients_;
};

/// Splines of all vertices, fitted a block at a time when first asked for, by whoever asks. What is held at a
/// time is limited: a raster read row by row needs the blocks that its rows pass, and the others are dropped,
/// the one that was not asked for longest first. Whenever a dropped block is asked for again the limit grows
/// by kRegret blocks, so that reading in any order fits at most a quarter of the splines more than once.
///
/// For any number of threads at a time. What a block holds does not depend on when it was fitted.
class SplineStore {
  public:
    explicit SplineStore(const SplineSources& sources);
    /// `limit`: of the blocks held, to begin with.
    SplineStore(const SplineSources& sources, std::size_t limit);

    /// The block of a vertex; `fitter` is the caller's own.
    std::shared_ptr<const SplineBlock> block_of(VertexId v, SplineFitter& fitter);
    /// Of the splines held now; not while others read.
    [[nodiscard]] std::size_t bytes() const;

  private:
    static constexpr std::size_t kRegret = 4;

    struct Place {
        std::mutex mutex;
        std::shared_ptr<const SplineBlock> block;
        std::atomic<std::uint64_t> used = 0;  // when: the number of blocks fitted by then
        bool was_dropped = false;
    };
    void fit_beside(std::uint32_t number, SplineFitter& fitter);
    std::shared_ptr<const SplineBlock> fit(std::uint32_t number, SplineFitter& fitter,
                                           std::unique_lock<std::mutex> lock);
    void drop_oldest(std::uint32_t fitted, bool is_regretted);

    const Tin& tin_;
    std::vector<Place> places_;
    std::atomic<std::uint64_t> fitted_ = 0;
    std::mutex held_mutex_;            // of what follows
    std::vector<std::uint32_t> held_;  // the blocks that there are
    std::size_t limit_;
};

}  // namespace tinwright

#endif
