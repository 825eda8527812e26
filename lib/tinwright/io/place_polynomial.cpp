#include "tinwright/io/place_polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace tinwright::io {

namespace {

constexpr std::size_t kTerms = 8;
// What is said of cells' sizes holds down to cells this much narrower than high: towards the poles cells of
// longitude and latitude have no width.
constexpr double kLeastRatio = 0.01;
// Terms are left out as long as together they come to no more than this part of the tolerance.
constexpr double kNegligible = 0.1;

// Rows, up and down, to the points that tell where north is of a cell: near enough for cells of 10 kilometres
// by a pole, far enough for PROJ's digits in cells of a decimetre.
constexpr double kNearby = 1.0 / 16;

using Row = std::array<Point2, kTerms>;
using Square = std::array<Row, kTerms>;

Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
Point2 operator*(double factor, Point2 p) { return {factor * p.x, factor * p.y}; }
double length(Point2 p) { return std::hypot(p.x, p.y); }
bool is_finite(Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }

/// What does not depend on the block.
struct Chebyshev {
    std::array<double, kTerms> node{};                           // zeros of T8
    std::array<double, kTerms + 1> extreme{};                    // its extremes, ends included
    std::array<std::array<double, kTerms>, kTerms> to_terms{};   // values at nodes to coefficients
    std::array<std::array<double, kTerms>, kTerms> to_powers{};  // [term][power]

    Chebyshev() {
        const double turn = std::numbers::pi / static_cast<double>(kTerms);
        for (std::size_t i = 0; i < kTerms; ++i) {
            node[i] = std::cos(turn * (static_cast<double>(i) + 0.5));
            for (std::size_t k = 0; k < kTerms; ++k) {
                const double angle = turn * static_cast<double>(k) * (static_cast<double>(i) + 0.5);
                to_terms[k][i] = (k == 0 ? 1 : 2) * std::cos(angle) / static_cast<double>(kTerms);
            }
        }
        for (std::size_t i = 0; i <= kTerms; ++i) {
            extreme[i] = std::cos(turn * static_cast<double>(i));
        }
        to_powers[0][0] = 1;
        to_powers[1][1] = 1;
        for (std::size_t k = 2; k < kTerms; ++k) {
            for (std::size_t power = 0; power < kTerms; ++power) {
                to_powers[k][power] =
                    (power == 0 ? 0 : 2 * to_powers[k - 1][power - 1]) - to_powers[k - 2][power];
            }
        }
    }
};

const Chebyshev& chebyshev() {
    static const Chebyshev constants;
    return constants;
}

/// Values at nodes, [row][column], to coefficients of Chebyshev's terms.
Square to_terms(const Square& values) {
    const auto& matrix = chebyshev().to_terms;
    Square along{};
    for (std::size_t i = 0; i < kTerms; ++i) {
        for (std::size_t k = 0; k < kTerms; ++k) {
            for (std::size_t j = 0; j < kTerms; ++j) {
                along[i][k] = along[i][k] + matrix[k][j] * values[i][j];
            }
        }
    }
    Square terms{};
    for (std::size_t k = 0; k < kTerms; ++k) {
        for (std::size_t i = 0; i < kTerms; ++i) {
            for (std::size_t j = 0; j < kTerms; ++j) {
                terms[k][j] = terms[k][j] + matrix[k][i] * along[i][j];
            }
        }
    }
    return terms;
}

/// How many rows and columns of terms matter.
struct Extent {
    std::size_t rows = kTerms;
    std::size_t columns = kTerms;
};

Extent find_extent(const Square& terms, double negligible) {
    std::array<double, kTerms> of_row{};
    std::array<double, kTerms> of_column{};
    for (std::size_t i = 0; i < kTerms; ++i) {
        for (std::size_t j = 0; j < kTerms; ++j) {
            of_row[i] += length(terms[i][j]);
            of_column[j] += length(terms[i][j]);
        }
    }
    const auto count = [negligible](const std::array<double, kTerms>& sizes) {
        std::size_t kept = kTerms;
        for (double left_out = 0; kept > 1 && left_out + sizes[kept - 1] <= negligible; --kept) {
            left_out += sizes[kept - 1];
        }
        return kept;
    };
    return {count(of_row), count(of_column)};
}

/// Chebyshev's terms to powers, row-major.
std::vector<Point2> to_powers(const Square& terms, const Extent& extent) {
    const auto& matrix = chebyshev().to_powers;
    std::vector<Point2> powers(extent.rows * extent.columns);
    for (std::size_t i = 0; i < extent.rows; ++i) {
        for (std::size_t j = 0; j < extent.columns; ++j) {
            for (std::size_t p = 0; p <= i; ++p) {
                for (std::size_t q = 0; q <= j; ++q) {
                    Point2& power = powers[p * extent.columns + q];
                    power = power + (matrix[i][p] * matrix[j][q]) * terms[i][j];
                }
            }
        }
    }
    return powers;
}

/// The polynomial along one row: positions, and their change from row to row.
struct RowPolynomial {
    std::array<double, kTerms> x{};
    std::array<double, kTerms> y{};
    std::array<double, kTerms> down_x{};
    std::array<double, kTerms> down_y{};
    Point2 origin{};
};

template <std::size_t kCount>
double evaluate(const std::array<double, kTerms>& coefficients, double u) {
    double value = coefficients[kCount - 1];
    for (std::size_t j = kCount - 1; j-- > 0;) {
        value = value * u + coefficients[j];
    }
    return value;
}

template <std::size_t kCount>
void evaluate_cells(const RowPolynomial& row, double first, double scale, std::span<CellPlace> places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double u = (first + static_cast<double>(i)) * scale;
        const double north_x = -evaluate<kCount>(row.down_x, u);
        const double north_y = -evaluate<kCount>(row.down_y, u);
        const double size = std::sqrt(north_x * north_x + north_y * north_y);
        places[i].position = {row.origin.x + evaluate<kCount>(row.x, u),
                              row.origin.y + evaluate<kCount>(row.y, u)};
        places[i].north = size > 0 ? Point2{north_x / size, north_y / size} : Point2{0, 1};
    }
}

using Evaluator = void (*)(const RowPolynomial&, double, double, std::span<CellPlace>);
constexpr std::array<Evaluator, kTerms> kEvaluators{
    &evaluate_cells<1>, &evaluate_cells<2>, &evaluate_cells<3>, &evaluate_cells<4>,
    &evaluate_cells<5>, &evaluate_cells<6>, &evaluate_cells<7>, &evaluate_cells<8>};

}  // namespace

void ExactPlaces::find(std::span<Point2> cells) const {
    for (Point2& cell : cells) {
        cell = {grid_.x_min + (cell.x + 0.5) * grid_.cell_width,
                grid_.y_max - (cell.y + 0.5) * grid_.cell_height};
    }
    transform_.forward(cells);
}

void ExactPlaces::find(std::int64_t row, std::int64_t first, std::span<CellPlace> places) const {
    std::vector<Point2> points;
    points.reserve(3 * places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto column = static_cast<double>(first + static_cast<std::int64_t>(i));
        const auto middle = static_cast<double>(row);
        points.insert(points.end(),
                      {{column, middle}, {column, middle - kNearby}, {column, middle + kNearby}});
    }
    find(std::span<Point2>(points));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Point2 center = points[3 * i];
        const Point2 above = is_finite(points[3 * i + 1]) ? points[3 * i + 1] : center;
        const Point2 below = is_finite(points[3 * i + 2]) ? points[3 * i + 2] : center;
        const Point2 up = above - below;
        const double size = length(up);
        places[i] = {center, size > 0 ? (1 / size) * up : Point2{0, 1}};
    }
}

std::optional<PlacePolynomial> PlacePolynomial::fit(const CellBlock& block, const ExactPlaces& exact,
                                                    double tolerance) {
    PlacePolynomial polynomial;
    // A single row or column gets the width of a cell.
    const Point2 half{std::max(static_cast<double>(block.columns - 1) / 2, 0.5),
                      std::max(static_cast<double>(block.rows - 1) / 2, 0.5)};
    polynomial.middle_ = {static_cast<double>(block.column) + static_cast<double>(block.columns - 1) / 2,
                          static_cast<double>(block.row) + static_cast<double>(block.rows - 1) / 2};
    polynomial.scale_ = {1 / half.x, 1 / half.y};
    const auto cell_at = [&](double u, double v) {
        return Point2{polynomial.middle_.x + u * half.x, polynomial.middle_.y + v * half.y};
    };
    std::vector<Point2> points;
    points.reserve(static_cast<std::size_t>(kExactPoints));
    for (const double v : chebyshev().node) {
        for (const double u : chebyshev().node) {
            points.push_back(cell_at(u, v));
        }
    }
    for (const double v : chebyshev().extreme) {
        for (const double u : chebyshev().extreme) {
            points.push_back(cell_at(u, v));
        }
    }
    exact.find(std::span<Point2>(points));
    if (!std::all_of(points.begin(), points.end(), is_finite)) {
        return std::nullopt;
    }
    polynomial.origin_ = points[kTerms * kTerms / 2];
    Square values{};
    double largest = 0;
    for (std::size_t i = 0; i < kTerms * kTerms; ++i) {
        values[i / kTerms][i % kTerms] = points[i] - polynomial.origin_;
        largest = std::max({largest, std::abs(points[i].x), std::abs(points[i].y)});
    }
    const Square terms = to_terms(values);
    const double width = length(terms[0][1]) / half.x;
    const double height = length(terms[1][0]) / half.y;
    const double size = std::max(std::min(width, height), kLeastRatio * std::max(width, height));
    // Coordinates themselves have no more digits.
    const double allowed = tolerance * size + 4 * std::numeric_limits<double>::epsilon() * largest;
    const Extent extent = find_extent(terms, kNegligible * allowed);
    polynomial.columns_ = extent.columns;
    polynomial.coefficients_ = to_powers(terms, extent);
    std::size_t i = kTerms * kTerms;
    for (const double v : chebyshev().extreme) {
        for (const double u : chebyshev().extreme) {
            if (!(length(polynomial.at(u, v) - points[i++]) <= allowed)) {
                return std::nullopt;
            }
        }
    }
    return polynomial;
}

Point2 PlacePolynomial::at(double u, double v) const {
    Point2 sum{};
    for (std::size_t i = coefficients_.size() / columns_; i-- > 0;) {
        Point2 of_row{};
        for (std::size_t j = columns_; j-- > 0;) {
            of_row = u * of_row + coefficients_[i * columns_ + j];
        }
        sum = v * sum + of_row;
    }
    return origin_ + sum;
}

void PlacePolynomial::find(std::int64_t row, std::int64_t first, std::span<CellPlace> places) const {
    const double v = (static_cast<double>(row) - middle_.y) * scale_.y;
    RowPolynomial along;
    along.origin = origin_;
    for (std::size_t j = 0; j < columns_; ++j) {
        Point2 value{};
        Point2 down{};
        for (std::size_t i = coefficients_.size() / columns_; i-- > 0;) {
            down = v * down + value;
            value = v * value + coefficients_[i * columns_ + j];
        }
        along.x[j] = value.x;
        along.y[j] = value.y;
        along.down_x[j] = down.x;
        along.down_y[j] = down.y;
    }
    kEvaluators[columns_ - 1](along, static_cast<double>(first) - middle_.x, scale_.x, places);
}

}  // namespace tinwright::io
