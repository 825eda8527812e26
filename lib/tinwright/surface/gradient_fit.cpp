#include "tinwright/surface/gradient_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/surface/cell_shares.hpp"

namespace tinwright {

namespace {

// Neighbours in each octant. One leaves quadrics with little to average over, three reach too far out.
constexpr unsigned kPerOctant = 2;
// What a quadric may at most make of errors of the slopes to its neighbours; beyond it a plane is taken.
constexpr double kMostMagnification = 20;
// A quadric has to be better than a plane by this factor to be believed at all. Measured: 1 to 2 are about as
// good on surveys and terrain, 0 is a fifth worse on surveys, on Franke's functions less is better.
constexpr double kDoubt = 1.5;
// What is left of a right side that a plane meets, in squares, and rounding with it.
constexpr double kFlat = 1e-24;
// A fit is poor if of one of its columns less than this is left beside those before; where there is no other
// fit to turn to, a column counts until nothing is left but rounding.
constexpr double kPoor = 1e-5;
constexpr double kDependent = 1e-14;

// Of more neighbours the cells are not looked for, which takes the square of their number.
constexpr std::size_t kMostCells = 256;

double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

/// In four sums, so that additions need not wait for each other.
double product(const std::vector<double>& a, const std::vector<double>& b) {
    std::array<double, 4> sum{};
    std::size_t i = 0;
    for (; i + 4 <= a.size(); i += 4) {
        for (std::size_t lane = 0; lane < 4; ++lane) {
            sum[lane] += a[i + lane] * b[i + lane];
        }
    }
    for (; i < a.size(); ++i) {
        sum[0] += a[i] * b[i];
    }
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

}  // namespace

std::span<const GradientWeight> GradientFit::find_stencil(const VertexFan& fan) {
    const Tie tie = find_tie(fan);
    const VertexId center = tin_.mesh.origin(fan.first);
    double trust = 0;
    if (method_ == GradientMethod::Octant) {
        search_.find_octants(fan, kPerOctant, neighbors_);
        trust = find_trust(center, tie);
        weigh_by_distance(3);  // as what a quadric leaves out of a smooth surface grows
        if (trust > 0 && !(fit(Model::Quadric, tie) && magnification(center) <= kMostMagnification)) {
            trust = 0;
        }
        if (trust == 1) {
            return stencil_;
        }
        quadric_.swap(stencil_);
    }
    search_.find_ring(fan, neighbors_);
    fit_ring(fan, tie);
    if (trust > 0) {
        for (GradientWeight& term : stencil_) {
            term.weight = {(1 - trust) * term.weight.x, (1 - trust) * term.weight.y};
        }
        for (const GradientWeight& term : quadric_) {
            stencil_.push_back({term.vertex, {trust * term.weight.x, trust * term.weight.y}});
        }
    }
    return stencil_;
}

void GradientFit::fit_ring(const VertexFan& fan, const Tie& tie) {
    if (method_ == GradientMethod::Sibson && fan.is_closed && neighbors_.size() <= kMostCells) {
        weigh_by_cells();
        if (fit(Model::Plane, tie)) {
            return;
        }
    }
    weigh_by_distance(1);
    fit(Model::Plane, tie);
}

/// How far the quadric through the octants' vertices is believed, from 0 to 1: by as much as it tells their
/// slopes better than a plane does, degrees of freedom allowed for. On smooth surfaces nearly all, on rough
/// ones little, and then a plane errs less.
double GradientFit::find_trust(VertexId center, const Tie& tie) {
    const double z = tin_.z[center.value];
    double slope = 0;  // along the tie, per squared length of it
    for (unsigned k = 0; k < tie.count; ++k) {
        slope += tie.term[k].share * (tin_.z[tie.term[k].vertex.value] - z);
    }
    slope = tie.count > 0 ? slope / dot(tie.direction, tie.direction) : 0;
    weigh_by_distance(1);
    right_side_.clear();
    for (std::size_t i = 0; i < neighbors_.size(); ++i) {
        const Point2 offset{neighbors_[i].offset.x, neighbors_[i].offset.y};
        const double rise = tin_.z[neighbors_[i].vertex.value] - z - slope * dot(tie.direction, offset);
        right_side_.push_back(row_weight_[i] * rise);
    }
    // A plane's columns first, so that what it leaves is met on the way to what a quadric leaves.
    make_columns(Model::Quadric, tie, false);
    orthogonalize();
    const unsigned of_plane = tie.count > 0 ? 1 : 2;
    const double whole = product(right_side_, right_side_);
    double left = whole;
    double left_by_plane = whole;
    for (unsigned j = 0; j < column_count_; ++j) {
        left_by_plane = j == of_plane ? left : left_by_plane;
        const double part = product(column_[j], right_side_);
        left -= part * part;
    }
    const double plane = misfit(left_by_plane, of_plane);
    return plane > kFlat * whole ? std::max(0.0, 1 - kDoubt * misfit(left, column_count_) / plane) : 0;
}

/// The mean square of what a model leaves; infinite for what it could not but meet.
double GradientFit::misfit(double left, unsigned columns) const {
    const std::size_t rows = neighbors_.size();
    return rows > columns ? std::max(0.0, left) / static_cast<double>(rows - columns)
                          : std::numeric_limits<double>::infinity();
}

Point2 GradientFit::estimate(const VertexFan& fan) {
    const double z = tin_.z[tin_.mesh.origin(fan.first).value];
    Point2 gradient;
    for (const GradientWeight& term : find_stencil(fan)) {
        const double rise = tin_.z[term.vertex.value] - z;
        gradient.x += term.weight.x * rise;
        gradient.y += term.weight.y * rise;
    }
    return gradient;
}

GradientFit::Tie GradientFit::find_tie(const VertexFan& fan) const {
    const TriangleMesh& mesh = tin_.mesh;
    if (fan.is_closed) {
        return {};
    }
    const Key2 at = tin_.key(mesh.origin(fan.first));
    const auto along = [&](VertexId end) { return Point2{tin_.key(end).x - at.x, tin_.key(end).y - at.y}; };
    const VertexId a = mesh.destination(fan.first);
    const VertexId b = last_neighbor(mesh, fan);
    const bool is_a_sharp = sharp_.is_sharp(fan.first);
    const bool is_b_sharp = sharp_.is_sharp(previous(fan.last));
    if (!is_a_sharp && !is_b_sharp) {
        return {};
    }
    if (a == b || is_a_sharp != is_b_sharp) {
        const VertexId end = is_a_sharp ? a : b;
        return {along(end), {Tie::Term{end, 1}}, 1};
    }
    const Point2 to_a = along(a);
    const Point2 to_b = along(b);
    const double a_length = std::sqrt(dot(to_a, to_a));
    const double b_length = std::sqrt(dot(to_b, to_b));
    if (dot(to_a, to_b) > -0.5 * a_length * b_length) {
        return {};
    }
    const double a_share = -b_length / a_length;
    const double b_share = a_length / b_length;
    return {{a_share * to_a.x + b_share * to_b.x, a_share * to_a.y + b_share * to_b.y},
            {Tie::Term{a, a_share}, Tie::Term{b, b_share}},
            2};
}

/// Residuals count by the inverse of the distance to a power, 1 or 3: 1 where slopes are to be met.
void GradientFit::weigh_by_distance(int power) {
    row_weight_.clear();
    for (const VertexNeighbor& neighbor : neighbors_) {
        const double distance = std::sqrt(neighbor.distance2);
        row_weight_.push_back(power == 1 ? 1 / distance : 1 / (distance * neighbor.distance2));
    }
}

void GradientFit::weigh_by_cells() {
    row_weight_ = find_cell_shares(neighbors_);
    for (std::size_t i = 0; i < neighbors_.size(); ++i) {
        row_weight_[i] = std::sqrt(row_weight_[i] / neighbors_[i].distance2);
    }
}

/// Fills `stencil_` from the neighbours and their weights; whether they determine all of the model. What they
/// do not determine of a plane, few as they are or all on one line, is taken to be zero.
bool GradientFit::fit(Model model, const Tie& tie) {
    make_columns(model, tie, true);
    const bool is_determined = orthogonalize();
    make_stencil(tie);
    return is_determined;
}

void GradientFit::make_columns(Model model, const Tie& tie, bool are_slopes_last) {
    double farthest2 = 0;
    for (const VertexNeighbor& neighbor : neighbors_) {
        farthest2 = std::max(farthest2, neighbor.distance2);
    }
    const double scale = 1 / std::sqrt(farthest2);
    scale_ = scale;
    const bool is_tied = tie.count > 0;
    const unsigned slopes = is_tied ? 1 : 2;
    column_count_ = slopes + (model == Model::Quadric ? 3 : 0);
    const unsigned slope = are_slopes_last ? column_count_ - slopes : 0;
    const unsigned square = are_slopes_last ? 0 : slopes;
    for (unsigned j = 0; j < column_count_; ++j) {
        column_[j].resize(neighbors_.size());
    }
    const double length = std::sqrt(dot(tie.direction, tie.direction));
    for (std::size_t i = 0; i < neighbors_.size(); ++i) {
        const Point2 u{neighbors_[i].offset.x * scale, neighbors_[i].offset.y * scale};
        const double weight = row_weight_[i];
        if (model == Model::Quadric) {
            column_[square][i] = weight * u.x * u.x;
            column_[square + 1][i] = weight * u.x * u.y;
            column_[square + 2][i] = weight * u.y * u.y;
        }
        if (is_tied) {
            column_[slope][i] = weight * ((tie.direction.x * u.y - tie.direction.y * u.x) / length);
        } else {
            column_[slope][i] = weight * u.x;
            column_[slope + 1][i] = weight * u.y;
        }
    }
}

/// Takes from a column what the orthonormal ones before it say; the squared length that is left of `before`.
double GradientFit::subtract_others(unsigned j, double before) {
    std::vector<double>& column = column_[j];
    for (unsigned k = 0; k < j; ++k) {
        r_[k][j] = 0;
    }
    double after = before;
    for (int pass = 0; pass < 2; ++pass) {
        for (unsigned k = 0; k < j; ++k) {
            const double part = product(column_[k], column);
            r_[k][j] += part;
            for (std::size_t i = 0; i < column.size(); ++i) {
                column[i] -= part * column_[k][i];
            }
        }
        const double left = product(column, column);
        const bool is_clean = left > 0.01 * after;  // or else rounding has its share in what is left
        after = left;
        if (is_clean) {
            break;
        }
    }
    return after;
}

/// Gram and Schmidt: `r_` and orthonormal columns. Columns that depend on those before become zero, with an
/// infinite diagonal of `r_`, so that what they stand for comes out as zero. Whether none came near to that.
bool GradientFit::orthogonalize() {
    const std::size_t rows = neighbors_.size();
    bool is_determined = rows >= column_count_;
    for (unsigned j = 0; j < column_count_; ++j) {
        std::vector<double>& column = column_[j];
        const double before = product(column, column);
        const double after = subtract_others(j, before);
        const bool is_dependent = !(after > kDependent * kDependent * before);
        is_determined = is_determined && after > kPoor * kPoor * before;
        r_[j][j] = is_dependent ? std::numeric_limits<double>::infinity() : std::sqrt(after);
        const double factor = is_dependent ? 0 : 1 / r_[j][j];
        for (std::size_t i = 0; i < rows; ++i) {
            column[i] *= factor;
        }
    }
    return is_determined;
}

void GradientFit::make_stencil(const Tie& tie) {
    const double scale = scale_;
    stencil_.clear();
    const unsigned y = column_count_ - 1;
    if (tie.count == 0) {
        const unsigned x = y - 1;
        for (std::size_t i = 0; i < neighbors_.size(); ++i) {
            const double along_y = column_[y][i] / r_[y][y];
            const double along_x = (column_[x][i] - r_[x][y] * along_y) / r_[x][x];
            const double factor = row_weight_[i] * scale;
            stencil_.push_back({neighbors_[i].vertex, {along_x * factor, along_y * factor}});
        }
        return;
    }
    const double length = std::sqrt(dot(tie.direction, tie.direction));
    const Point2 along{tie.direction.x / length, tie.direction.y / length};
    double leak = 0;  // of a unit slope along the line into the slope across it
    for (std::size_t i = 0; i < neighbors_.size(); ++i) {
        const double across = column_[y][i] / r_[y][y] * row_weight_[i] * scale;
        leak += across * (along.x * neighbors_[i].offset.x + along.y * neighbors_[i].offset.y);
        stencil_.push_back({neighbors_[i].vertex, {-along.y * across, along.x * across}});
    }
    for (unsigned k = 0; k < tie.count; ++k) {
        const double share = tie.term[k].share / length;
        stencil_.push_back(
            {tie.term[k].vertex, {share * (along.x + along.y * leak), share * (along.y - along.x * leak)}});
    }
}

/// The sum over the stencil of weight times distance: at most so much larger than an error that the slopes
/// to all neighbours have can the gradient's be.
double GradientFit::magnification(VertexId center) const {
    double sum = 0;
    for (const GradientWeight& term : stencil_) {
        sum += std::sqrt(dot(term.weight, term.weight) *
                         squared_distance(tin_.key(center), tin_.key(term.vertex)));
    }
    return sum;
}

}  // namespace tinwright
