#ifndef TINWRIGHT_SURFACE_SMOOTH_READER_HPP
#define TINWRIGHT_SURFACE_SMOOTH_READER_HPP

#include <array>
#include <vector>

#include "tinwright/surface/face_blend.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/spline_fitter.hpp"
#include "tinwright/surface/spline_store.hpp"

namespace tinwright {

/// Reads the surface that the splines of a face's corners make together.
class SmoothReader final : public SurfaceReader {
  public:
    SmoothReader(const SplineSources& sources, const QueryLattice& lattice, SplineStore& store);

    double elevation(const SurfacePlace& place) override;
    SurfaceReading read(const SurfacePlace& place) override;
    void find_weights(const SurfacePlace& place, std::vector<VertexWeight>& weights) override;

  private:
    /// A vertex' spline, its nodes stretched and side by side.
    struct Unpacked {
        VertexId vertex = kGhostVertex;
        bool is_plane = true;
        RadialKernel kernel;
        Stretch stretch;
        Point2 gradient{};
        double inverse = 0;  ///< of the spline's unit, in steps of places
        double lowest = 0;
        double highest = 0;
        double guard = 0;
        double at_vertex = 0;  ///< the sum of kernels there
        std::vector<double> x, y, c;
    };
    /// Elevation above the vertex', and its change with a step along x and y.
    struct Local {
        double z = 0;
        Point2 gradient{};
    };

    void enter(FaceId face);
    [[nodiscard]] double foot(unsigned corner) const;
    [[nodiscard]] std::array<double, 3> shares(Key2 at) const;
    [[nodiscard]] FaceBlend blend(Key2 at) const;
    const Unpacked& unpack(VertexId v);
    void unpack(VertexId v, Unpacked& to);
    template <bool kWithGradient>
    Local local(unsigned corner, Key2 at, const std::array<double, 3>& share);
    void add_weights(unsigned corner, Key2 at, const std::array<double, 3>& share, double factor,
                     std::vector<VertexWeight>& weights);
    void apply_guard(const Unpacked& spline, Local& local) const;
    template <bool kWithGradient>
    SurfaceReading evaluate(const SurfacePlace& place);

    static constexpr std::size_t kSlots = 512;

    SplineSources sources_;
    const QueryLattice& lattice_;
    SplineStore& store_;
    SplineFitter fitter_;
    std::vector<Unpacked> slots_;

    FaceId face_{0xFFFFFFFFU};  // the one that the rest is of
    std::array<unsigned, 3> corner_{};
    std::array<VertexId, 3> vertex_{};
    std::array<Key2, 3> key_{};
    std::array<double, 3> z_{};
    std::array<double, 3> foot_{};
    std::array<Point2, 3> share_gradient_{};  // of barycentric coordinates, per step of places
    double area_ = 1;
};

}  // namespace tinwright

#endif
