#ifndef TINWRIGHT_SURFACE_GRADIENT_FIT_HPP
#define TINWRIGHT_SURFACE_GRADIENT_FIT_HPP

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tinwright/surface/gradients.hpp"
#include "tinwright/surface/vertex_neighbors.hpp"

namespace tinwright {

/// Estimates the gradient that the faces of a fan have in common. For one thread.
///
/// A gradient is a weighted sum of elevations: a stencil is a list of vertices, some perhaps more than once,
/// and the gradient is the sum of weight times (z - z of the fan's own vertex), here in z units over steps of
/// the TIN's lattice.
///
/// Where a fan begins or ends at a sharp edge the gradient is tied: along the line it has the slope of the
/// parabola through the line's three points, or at the end of a line, or where it meets the border, that of
/// the edge. Where the line bends by more than 60 degrees it is not tied, for what holds along the one edge
/// says little of the other.
class GradientFit {
  public:
    /// All must outlive the fit.
    GradientFit(const Tin& tin, const SharpEdges& sharp, GradientMethod method)
        : tin_(tin), sharp_(sharp), method_(method), search_(tin, sharp) {}

    /// Valid until the next call.
    std::span<const GradientWeight> find_stencil(const VertexFan& fan);
    /// What the stencil makes of the elevations.
    Point2 estimate(const VertexFan& fan);

  private:
    /// gradient * direction = sum of share * (z - z of the fan's vertex); nothing is known without terms.
    struct Tie {
        struct Term {
            VertexId vertex{};
            double share = 0;
        };
        Point2 direction{};  ///< steps
        std::array<Term, 2> term{};
        unsigned count = 0;
    };
    enum class Model : std::uint8_t { Plane, Quadric };

    [[nodiscard]] Tie find_tie(const VertexFan& fan) const;
    bool fit(Model model, const Tie& tie);
    void fit_ring(const VertexFan& fan, const Tie& tie);
    double find_trust(VertexId center, const Tie& tie);
    [[nodiscard]] double misfit(double left, unsigned columns) const;
    void weigh_by_distance(int power);
    void weigh_by_cells();
    void make_columns(Model model, const Tie& tie, bool are_slopes_last);
    double subtract_others(unsigned j, double before);
    bool orthogonalize();
    void make_stencil(const Tie& tie);
    [[nodiscard]] double magnification(VertexId center) const;

    static constexpr unsigned kMostColumns = 5;

    const Tin& tin_;
    const SharpEdges& sharp_;
    GradientMethod method_;
    NeighborSearch search_;
    std::vector<VertexNeighbor> neighbors_;
    std::vector<double> row_weight_;  // one a neighbour: square root of its weight in the sum of squares
    std::array<std::vector<double>, kMostColumns> column_;
    unsigned column_count_ = 0;
    std::array<std::array<double, kMostColumns>, kMostColumns> r_{};
    double scale_ = 1;  // of the columns to steps
    std::vector<double> right_side_;
    std::vector<GradientWeight> stencil_;
    std::vector<GradientWeight> quadric_;
};

}  // namespace tinwright

#endif
