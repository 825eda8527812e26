#include "tinwright/surface/local_spline.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "support/cases.hpp"
#include "support/point_sets.hpp"

using namespace tinwright;
using namespace tinwright_tests;

namespace {

struct Chosen {
    double exponent;
    Stretch stretch;
};

const std::vector<Chosen>& choices() {
    static const std::vector<Chosen> all{
        {1.5, {}}, {1, {{0.6, 0.8}, 4}}, {2.5, {}}, {2.5, {{0.8, -0.6}, 2.5}}, {3, {}},
        {0.7, {}}, {3, {{0, 1}, 2}}};
    return all;
}

/// Some at random, some in a row, two close together.
std::vector<SplineNode> random_nodes(Random& random, int count) {
    std::vector<SplineNode> nodes{{0, 0, 0}};
    for (int i = 1; i < count; ++i) {
        nodes.push_back({2 * random.real() - 1, 2 * random.real() - 1, 20 * random.real()});
        if (i % 3 == 0) {
            nodes.back().y = 0.5;
        }
    }
    nodes.back() = {nodes[1].x + 1e-2, nodes[1].y, nodes[1].z + 0.1};
    return nodes;
}

/// The interpolant by Gaussian elimination of the whole system, in long double: kernel, plane and conditions.
class SlowSpline {
  public:
    SlowSpline(const std::vector<SplineNode>& nodes, const Chosen& chosen) : nodes_(nodes), chosen_(chosen) {
        const std::size_t n = nodes.size();
        std::vector<std::vector<long double>> rows(n + 3, std::vector<long double>(n + 4, 0.0L));
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                rows[i][j] = kernel(nodes[i].x - nodes[j].x, nodes[i].y - nodes[j].y);
            }
            const std::array<long double, 3> plane{1, nodes[i].x, nodes[i].y};
            for (std::size_t k = 0; k < 3; ++k) {
                rows[i][n + k] = plane[k];
                rows[n + k][i] = plane[k];
            }
            rows[i][n + 3] = nodes[i].z;
        }
        solve(rows);
    }

    [[nodiscard]] long double value(long double x, long double y) const {
        const std::size_t n = nodes_.size();
        long double sum = solution_[n] + solution_[n + 1] * x + solution_[n + 2] * y;
        for (std::size_t i = 0; i < n; ++i) {
            sum += solution_[i] * kernel(x - nodes_[i].x, y - nodes_[i].y);
        }
        return sum;
    }
    [[nodiscard]] long double coefficient(std::size_t i) const { return solution_[i]; }

  private:
    [[nodiscard]] long double kernel(long double x, long double y) const {
        const long double along = chosen_.stretch.along.x * x + chosen_.stretch.along.y * y;
        const long double across = chosen_.stretch.along.x * y - chosen_.stretch.along.y * x;
        return std::pow(std::hypot(along * chosen_.stretch.factor, across),
                        static_cast<long double>(chosen_.exponent));
    }
    void solve(std::vector<std::vector<long double>>& rows) {
        const std::size_t n = rows.size();
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t pivot = k;
            for (std::size_t i = k; i < n; ++i) {
                pivot = std::abs(rows[i][k]) > std::abs(rows[pivot][k]) ? i : pivot;
            }
            std::swap(rows[k], rows[pivot]);
            for (std::size_t i = 0; i < n; ++i) {
                const long double factor = i == k ? 0 : rows[i][k] / rows[k][k];
                for (std::size_t j = k; j <= n; ++j) {
                    rows[i][j] -= factor * rows[k][j];
                }
            }
        }
        for (std::size_t k = 0; k < n; ++k) {
            solution_.push_back(rows[k][n] / rows[k][k]);
        }
    }

    std::vector<SplineNode> nodes_;
    Chosen chosen_;
    std::vector<long double> solution_;
};

double weighted(const std::vector<SplineNode>& nodes, const std::vector<double>& weights) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        sum += weights[i] * nodes[i].z;
    }
    return sum;
}

/// Runs `body(nodes, chosen, spline)` for every kernel, the spline being fitted.
template <class Body>
void for_all(int usual, const Body& body) {
    LocalSpline spline;  // one for all: nothing of the last may be left
    for (int seed = 1; seed <= cases(usual); ++seed) {
        Random random(static_cast<std::uint64_t>(seed));
        const std::vector<SplineNode> nodes =
            random_nodes(random, 5 + static_cast<int>(random.integer(0, 30)));
        for (const Chosen& chosen : choices()) {
            CAPTURE(seed);
            CAPTURE(chosen.exponent);
            REQUIRE(spline.set_nodes(nodes));
            REQUIRE(spline.fit({chosen.exponent}, chosen.stretch));
            body(nodes, chosen, spline, random);
        }
    }
}

}  // namespace

TEST_SUITE("surface/local_spline") {
    TEST_CASE("coefficients and plane are those of the whole system, solved slowly") {
        for_all(10, [](const auto& nodes, const Chosen& chosen, LocalSpline& spline, Random& /*random*/) {
            const SlowSpline slow(nodes, chosen);
            double largest = 0;
            for (const double c : spline.coefficients()) {
                largest = std::max(largest, std::abs(c));
            }
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                REQUIRE(std::abs(spline.coefficients()[i] - static_cast<double>(slow.coefficient(i))) <=
                        1e-7 * largest);
            }
            const std::size_t n = nodes.size();
            REQUIRE(spline.gradient().x ==
                    doctest::Approx(static_cast<double>(slow.coefficient(n + 1))).epsilon(1e-6));
            REQUIRE(spline.gradient().y ==
                    doctest::Approx(static_cast<double>(slow.coefficient(n + 2))).epsilon(1e-6));
        });
    }

    TEST_CASE("errors are those of fitting without the node") {
        for_all(5, [](const auto& nodes, const Chosen& chosen, LocalSpline& spline, Random& /*random*/) {
            for (std::size_t left_out = 0; left_out < nodes.size(); ++left_out) {
                std::vector<SplineNode> others = nodes;
                others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
                const SlowSpline slow(others, chosen);
                const double error =
                    nodes[left_out].z - static_cast<double>(slow.value(nodes[left_out].x, nodes[left_out].y));
                REQUIRE(std::abs(spline.errors()[left_out] - error) <= 1e-7 * (20 + std::abs(error)));
            }
        });
    }

    TEST_CASE("weights give each node to itself, reproduce planes, and make the spline's value") {
        for_all(5, [](const auto& nodes, const Chosen& chosen, LocalSpline& spline, Random& random) {
            std::vector<double> weights(nodes.size());
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                spline.find_weights({nodes[i].x, nodes[i].y}, weights);
                for (std::size_t j = 0; j < nodes.size(); ++j) {
                    REQUIRE(std::abs(weights[j] - (i == j ? 1 : 0)) < 1e-6);
                }
            }
            const SlowSpline slow(nodes, chosen);
            for (int k = 0; k < 10; ++k) {
                const Point2 at{2 * random.real() - 1, 2 * random.real() - 1};
                spline.find_weights(at, weights);
                double sum = 0;
                double x = 0;
                double y = 0;
                for (std::size_t i = 0; i < nodes.size(); ++i) {
                    sum += weights[i];
                    x += weights[i] * nodes[i].x;
                    y += weights[i] * nodes[i].y;
                }
                REQUIRE(std::abs(sum - 1) < 1e-8);
                REQUIRE(std::abs(x - at.x) < 1e-8);
                REQUIRE(std::abs(y - at.y) < 1e-8);
                REQUIRE(weighted(nodes, weights) ==
                        doctest::Approx(static_cast<double>(slow.value(at.x, at.y))).epsilon(1e-6));
            }
        });
    }

    TEST_CASE("nodes of a plane have no error and no coefficients") {
        for_all(5, [](auto nodes, const Chosen& chosen, LocalSpline& spline, Random& /*random*/) {
            for (SplineNode& node : nodes) {
                node.z = 3 * node.x - 2 * node.y;
            }
            REQUIRE(spline.set_nodes(nodes));
            REQUIRE(spline.fit({chosen.exponent}, chosen.stretch));
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                REQUIRE(std::abs(spline.errors()[i]) < 1e-11);
            }
            REQUIRE(std::abs(spline.gradient().x - 3) < 1e-9);
            REQUIRE(std::abs(spline.gradient().y + 2) < 1e-9);
        });
    }

    TEST_CASE("nodes in a row, or fewer than four, make no spline; the same node twice has no kernel") {
        LocalSpline spline;
        CHECK_FALSE(spline.set_nodes(std::vector<SplineNode>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
        std::vector<SplineNode> row;
        for (int i = 0; i < 9; ++i) {
            row.push_back({0.1 * i, 0.3 * i, 1.0 * i});
        }
        CHECK_FALSE(spline.set_nodes(row));
        row.push_back({-0.5, 0.5, 0});
        row.push_back({-0.5, 0.6, 2});
        CHECK(spline.set_nodes(row));
        CHECK(spline.fit({1.5}, {}));
        row.push_back(row.back());
        CHECK(spline.set_nodes(row));
        CHECK_FALSE(spline.fit({1.5}, {}));
    }

    TEST_CASE("the gradient of a sum of kernels is that of differences") {
        Random random(5);
        for (const Chosen& chosen : choices()) {
            CAPTURE(chosen.exponent);
            std::array<double, 8> x{};
            std::array<double, 8> y{};
            std::array<double, 8> c{};
            for (std::size_t i = 0; i < x.size(); ++i) {
                x[i] = random.real();
                y[i] = random.real();
                c[i] = random.real() - 0.5;
            }
            const auto sum = [&](double px, double py) {
                return sum_kernel({chosen.exponent}, x, y, c, {px, py});
            };
            const double h = 1e-5;
            const Point2 gradient = sum_kernel_gradient({chosen.exponent}, x, y, c, {1.5, -0.25});
            CHECK(std::abs(gradient.x - (sum(1.5 + h, -0.25) - sum(1.5 - h, -0.25)) / (2 * h)) < 1e-8);
            CHECK(std::abs(gradient.y - (sum(1.5, -0.25 + h) - sum(1.5, -0.25 - h)) / (2 * h)) < 1e-8);
        }
    }
}
