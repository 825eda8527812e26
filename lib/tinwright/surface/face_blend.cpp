#include "tinwright/surface/face_blend.hpp"

namespace tinwright {

FaceBlend blend_linearly(const std::array<double, 3>& barycentric) {
    return {barycentric, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
}

/// The face is cut into three at its centroid. On the third P Q C, with the corner R beyond, the cubic has
/// Bernstein coefficients b[ijk] for p^i q^j c^k.
FaceBlend blend_smoothly(const std::array<double, 3>& barycentric, const std::array<double, 3>& foot) {
    unsigned r = barycentric[1] < barycentric[0] ? 1 : 0;
    r = barycentric[2] < barycentric[r] ? 2 : r;
    const std::array<unsigned, 3> corner{(r + 1) % 3, (r + 2) % 3, r};  // of P, Q, R
    const double p = barycentric[corner[0]] - barycentric[r];
    const double q = barycentric[corner[1]] - barycentric[r];
    const double c = 3 * barycentric[r];
    FaceBlend blend;
    for (unsigned i = 0; i < 3; ++i) {  // the function of corner i of P, Q, R
        const double at_p = i == 0 ? 1 : 0;
        const double at_q = i == 1 ? 1 : 0;
        const double at_r = i == 2 ? 1 : 0;
        // In the middle of the rows next to the edges: opposite P, Q and R.
        const auto middle = [&](unsigned opposite, double first, double second) {
            return first + foot[corner[opposite]] * (second - first);
        };
        const double m_p = middle(0, at_q, at_r);
        const double m_q = middle(1, at_r, at_p);
        const double m_r = middle(2, at_p, at_q);
        const double b102 = (m_q + m_r + at_p) / 3;
        const double b012 = (m_p + m_r + at_q) / 3;
        const double beyond = (m_p + m_q + at_r) / 3;
        const double b003 = (b102 + b012 + beyond) / 3;
        // By de Casteljau's steps: rows of a quadratic each along p, q and c.
        const double along_p = p * p * at_p + 2 * p * q * at_p + q * q * at_q + 2 * p * c * at_p +
                               2 * q * c * m_r + c * c * b102;
        const double along_q = p * p * at_p + 2 * p * q * at_q + q * q * at_q + 2 * p * c * m_r +
                               2 * q * c * at_q + c * c * b012;
        const double along_c = p * p * at_p + 2 * p * q * m_r + q * q * at_q + 2 * p * c * b102 +
                               2 * q * c * b012 + c * c * b003;
        blend.share[corner[i]] = p * along_p + q * along_q + c * along_c;
        blend.slope[corner[i]][corner[0]] = 3 * along_p;
        blend.slope[corner[i]][corner[1]] = 3 * along_q;
        blend.slope[corner[i]][corner[2]] = 3 * (3 * along_c - along_p - along_q);
    }
    return blend;
}

}  // namespace tinwright
