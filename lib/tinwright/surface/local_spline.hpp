#ifndef TINWRIGHT_SURFACE_LOCAL_SPLINE_HPP
#define TINWRIGHT_SURFACE_LOCAL_SPLINE_HPP

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/surface/radial_kernel.hpp"

namespace tinwright {

/// What a local spline passes through. Positions relative to a place among them, and of the order of one.
struct SplineNode {
    double x = 0;
    double y = 0;
    double z = 0;
};

/// A stretch of the plane before distances are measured: by `factor` along a unit vector, not at all across.
struct Stretch {
    Point2 along{1, 0};
    double factor = 1;

    [[nodiscard]] Point2 operator()(Point2 p) const {
        return {factor * (along.x * p.x + along.y * p.y), along.x * p.y - along.y * p.x};
    }
    /// The gradient of a function of the plane as it was, from that of the same function of the stretched
    /// one.
    [[nodiscard]] Point2 pull_back(Point2 g) const {
        return {factor * along.x * g.x - along.y * g.y, factor * along.y * g.x + along.x * g.y};
    }
};

/// Fits s(p) = constant + gradient p + sum of c_k kernel(|p - p_k|) through nodes, with sum c_k = 0 and
/// sum c_k p_k = 0; kernel after kernel through the same nodes. Reusable, on one thread.
///
/// The conditions are met by an orthonormal basis of the vectors that no plane can explain, in which the
/// kernel's matrix is definite and has a Cholesky factor. The same factor gives the error with which each
/// node is predicted by all others [rippa1999].
class LocalSpline {
  public:
    /// False where the nodes are fewer than four or too near to a line: there is nothing to fit then. O(n^2).
    bool set_nodes(std::span<const SplineNode> nodes);
    /// False where the matrix is singular to working precision: nothing below may be asked then. O(n^3).
    bool fit(RadialKernel kernel, const Stretch& stretch);

    [[nodiscard]] std::size_t node_count() const { return count_; }
    /// c_k, n of them.
    [[nodiscard]] std::span<const double> coefficients() const { return {coefficients_.data(), count_}; }
    [[nodiscard]] Point2 gradient() const { return {drift_[1], drift_[2]}; }
    /// For each node its elevation less what all others predict for it.
    [[nodiscard]] std::span<const double> errors() const { return {errors_.data(), count_}; }
    /// For each node its share in s(at): s(at) is their sum times the elevations. O(n^2).
    void find_weights(Point2 at, std::span<double> weights);

  private:
    [[nodiscard]] double* row(std::vector<double>& matrix, std::size_t i) const {
        return matrix.data() + i * stride_;
    }
    void make_basis();
    void reflect(std::size_t k);
    bool eliminate();
    void find_coefficients();
    void find_drift();

    static constexpr std::size_t kDrift = 3;  ///< a plane has three coefficients

    std::size_t count_ = 0;
    std::size_t stride_ = 0;  // of rows: count_ rounded up to kRadialStep
    RadialKernel kernel_;
    Stretch stretch_;
    std::vector<double> x_, y_, z_;                       // nodes
    std::vector<double> u_, v_;                           // nodes, stretched
    std::array<std::vector<double>, kDrift> reflector_;   // Householder's: I - reflector reflector'
    std::array<std::array<double, kDrift>, kDrift> r_{};  // the planes in terms of the first basis vectors
    std::vector<double> basis_;                           // rows: the n - 3 vectors that no plane can explain
    std::vector<double> matrix_;                          // the kernel's, reflected and then eliminated
    std::vector<double> plain_;                           // the kernel's
    std::vector<double> factor_;  // rows of the inverse Cholesky factor times the basis
    std::vector<double> coefficients_, errors_, work_;
    std::array<double, kDrift> drift_{};
};

}  // namespace tinwright

#endif
