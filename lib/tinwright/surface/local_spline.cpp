#include "tinwright/surface/local_spline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tinwright {

namespace {

/// Nodes nearer to a line than this, their spread being about one, say nothing of the slope across it.
constexpr double kFlatSpread = 0x1p-20;
/// A pivot below this share of the largest entry is rounding.
constexpr double kSmallestPivot = 0x1p-44;

/// Of rows that end in zeros up to a multiple of kRadialStep; always added in the same order.
double inner(const double* a, const double* b, std::size_t stride) {
    std::array<double, kRadialStep> sums{};
    for (std::size_t i = 0; i < stride; i += kRadialStep) {
        for (std::size_t j = 0; j < kRadialStep; ++j) {
            sums[j] += a[i + j] * b[i + j];
        }
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// to -= factor * from
void subtract(double* to, double factor, const double* from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        to[i] -= factor * from[i];
    }
}

}  // namespace

bool LocalSpline::set_nodes(std::span<const SplineNode> nodes) {
    count_ = nodes.size();
    stride_ = (count_ + kRadialStep - 1) / kRadialStep * kRadialStep;
    if (count_ <= kDrift) {
        return false;
    }
    for (std::vector<double>* array : {&x_, &y_, &z_, &u_, &v_, &coefficients_, &errors_, &work_}) {
        array->assign(stride_, 0.0);
    }
    for (std::size_t i = 0; i < count_; ++i) {
        x_[i] = nodes[i].x;
        y_[i] = nodes[i].y;
        z_[i] = nodes[i].z;
    }
    // QR of the rows (1, x, y).
    std::array<std::vector<double>, kDrift> column{std::vector<double>(stride_, 1.0), x_, y_};
    for (std::size_t k = 0; k < kDrift; ++k) {
        std::vector<double>& v = reflector_[k];
        v.assign(stride_, 0.0);
        std::copy(column[k].begin() + static_cast<std::ptrdiff_t>(k),
                  column[k].begin() + static_cast<std::ptrdiff_t>(count_),
                  v.begin() + static_cast<std::ptrdiff_t>(k));
        const double length = std::sqrt(inner(v.data(), v.data(), stride_));
        if (!(length > kFlatSpread)) {
            return false;
        }
        const double diagonal = v[k] > 0 ? -length : length;
        v[k] -= diagonal;
        const double scale = std::sqrt(2 / inner(v.data(), v.data(), stride_));
        for (double& entry : v) {
            entry *= scale;
        }
        for (std::size_t j = k; j < kDrift; ++j) {
            subtract(column[j].data(), inner(v.data(), column[j].data(), stride_), v.data(), stride_);
            r_[k][j] = column[j][k];
        }
    }
    make_basis();
    return true;
}

void LocalSpline::make_basis() {
    matrix_.resize(count_ * stride_);
    plain_.resize(count_ * stride_);
    factor_.resize(count_ * stride_);
    basis_.assign(count_ * stride_, 0.0);
    for (std::size_t i = 0; i < count_; ++i) {
        row(basis_, i)[i] = 1;
    }
    for (const std::vector<double>& v : reflector_) {
        std::fill(work_.begin(), work_.end(), 0.0);
        for (std::size_t i = 0; i < count_; ++i) {
            subtract(work_.data(), -v[i], row(basis_, i), stride_);
        }
        for (std::size_t i = 0; i < count_; ++i) {
            subtract(row(basis_, i), v[i], work_.data(), stride_);
        }
    }
}

/// A <- H A H for the symmetric matrix A and the reflection H = I - v v'.
void LocalSpline::reflect(std::size_t k) {
    const double* const v = reflector_[k].data();
    std::fill(work_.begin(), work_.end(), 0.0);
    for (std::size_t i = 0; i < count_; ++i) {
        subtract(work_.data(), -v[i], row(matrix_, i), stride_);  // A v, by the symmetry of A
    }
    subtract(work_.data(), inner(work_.data(), v, stride_) / 2, v, stride_);
    const double* const w = work_.data();
    for (std::size_t i = 0; i < count_; ++i) {
        double* const to = row(matrix_, i);
        const double vi = v[i];
        const double wi = w[i];
        for (std::size_t j = 0; j < stride_; ++j) {
            to[j] -= vi * w[j] + wi * v[j];
        }
    }
}

/// Cholesky's factor of the reflected matrix beyond the planes, its inverse applied to the basis on the way.
bool LocalSpline::eliminate() {
    double largest = 0;
    for (std::size_t k = kDrift; k < count_; ++k) {
        largest = std::max(largest, row(matrix_, k)[k]);
    }
    for (std::size_t k = kDrift; k < count_; ++k) {
        double* const from = row(matrix_, k);
        double* const result = row(factor_, k);
        if (!(from[k] > kSmallestPivot * largest)) {
            return false;
        }
        const double scale = 1 / std::sqrt(from[k]);
        for (std::size_t j = k; j < stride_; ++j) {
            from[j] *= scale;
        }
        for (std::size_t j = 0; j < stride_; ++j) {
            result[j] *= scale;
        }
        for (std::size_t i = k + 1; i < count_; ++i) {
            const double multiple = from[i];
            const std::size_t first = i / kRadialStep * kRadialStep;
            subtract(row(matrix_, i) + first, multiple, from + first, stride_ - first);
            subtract(row(factor_, i), multiple, result, stride_);
        }
    }
    return true;
}

bool LocalSpline::fit(RadialKernel kernel, const Stretch& stretch) {
    kernel_ = kernel;
    stretch_ = stretch;
    for (std::size_t i = 0; i < stride_; ++i) {
        const Point2 stretched = stretch({x_[i], y_[i]});
        u_[i] = stretched.x;
        v_[i] = stretched.y;
    }
    const std::span<const double> us(u_.data(), stride_);
    const std::span<const double> vs(v_.data(), stride_);
    const double sign = kernel.sign();
    for (std::size_t i = 0; i < count_; ++i) {
        double* const to = row(plain_, i);
        find_kernel_values(kernel, us, vs, {u_[i], v_[i]}, {to, stride_});
        for (std::size_t j = count_; j < stride_; ++j) {
            to[j] = 0;
        }
        double* const signed_row = row(matrix_, i);
        for (std::size_t j = 0; j < stride_; ++j) {
            signed_row[j] = sign * to[j];
        }
    }
    for (std::size_t k = 0; k < kDrift; ++k) {
        reflect(k);
    }
    std::copy(basis_.begin() + static_cast<std::ptrdiff_t>(kDrift * stride_), basis_.end(),
              factor_.begin() + static_cast<std::ptrdiff_t>(kDrift * stride_));
    if (!eliminate()) {
        return false;
    }
    find_coefficients();
    find_drift();
    return true;
}

/// c = F' F z and e_k = c_k / (F' F)_kk for the factor F.
void LocalSpline::find_coefficients() {
    std::fill(coefficients_.begin(), coefficients_.end(), 0.0);
    std::fill(work_.begin(), work_.end(), 0.0);
    for (std::size_t i = kDrift; i < count_; ++i) {
        const double* const f = row(factor_, i);
        const double product = inner(f, z_.data(), stride_);
        for (std::size_t j = 0; j < stride_; ++j) {
            coefficients_[j] += product * f[j];
            work_[j] += f[j] * f[j];
        }
    }
    const double sign = kernel_.sign();
    for (std::size_t k = 0; k < count_; ++k) {
        // A node that the others say nothing of (the basis has no part of it) is a plane's matter: no error.
        errors_[k] = work_[k] > 0 ? coefficients_[k] / work_[k] : 0.0;
        coefficients_[k] *= sign;
    }
}

/// The plane through what the kernels leave: r drift = the first three of Q' (z - A c).
void LocalSpline::find_drift() {
    for (std::size_t i = 0; i < count_; ++i) {
        work_[i] = z_[i] - inner(row(plain_, i), coefficients_.data(), stride_);
    }
    for (const std::vector<double>& v : reflector_) {
        subtract(work_.data(), inner(v.data(), work_.data(), stride_), v.data(), stride_);
    }
    for (std::size_t k = kDrift; k-- > 0;) {
        double value = work_[k];
        for (std::size_t j = k + 1; j < kDrift; ++j) {
            value -= r_[k][j] * drift_[j];
        }
        drift_[k] = value / r_[k][k];
    }
}

void LocalSpline::find_weights(Point2 at, std::span<double> weights) {
    // First the least weights that reproduce planes: w = Q (r'^-1 p, 0), for p = (1, x, y).
    std::vector<double> w(stride_, 0.0);
    const std::array<double, kDrift> p{1, at.x, at.y};
    for (std::size_t k = 0; k < kDrift; ++k) {
        double value = p[k];
        for (std::size_t j = 0; j < k; ++j) {
            value -= r_[j][k] * w[j];
        }
        w[k] = value / r_[k][k];
    }
    for (std::size_t k = kDrift; k-- > 0;) {
        const std::vector<double>& v = reflector_[k];
        subtract(w.data(), inner(v.data(), w.data(), stride_), v.data(), stride_);
    }
    // Then F' F (kernel at `at` less A w), which no plane notices.
    std::vector<double> rest(stride_, 0.0);
    find_kernel_values(kernel_, {u_.data(), stride_}, {v_.data(), stride_}, stretch_(at), rest);
    for (std::size_t i = 0; i < count_; ++i) {
        rest[i] -= inner(row(plain_, i), w.data(), stride_);
    }
    const double sign = kernel_.sign();
    for (std::size_t i = kDrift; i < count_; ++i) {
        const double* const f = row(factor_, i);
        subtract(w.data(), -sign * inner(f, rest.data(), stride_), f, stride_);
    }
    std::copy(w.begin(), w.begin() + static_cast<std::ptrdiff_t>(count_), weights.begin());
}

}  // namespace tinwright
