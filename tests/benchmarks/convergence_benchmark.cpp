#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <tbb/task_arena.h>

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/contenders.hpp"
#include "benchmarks/held_out_sets.hpp"
#include "benchmarks/report.hpp"
#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright_tests::Random;

constexpr std::array kSides{32, 64, 128, 256};
constexpr std::array kFunctions{1, 4};
constexpr std::size_t kChecks = 20'000;

/// On a decimal lattice, so that samples are where they say.
double to_micro(double value) { return std::round(1e6 * value) / 1e6; }

/// A sample in each cell of a square grid, anywhere in the middle half of it; checks away from the border,
/// where surfaces are as good as what they are made of.
Fold jittered(int side, int function, std::size_t checks) {
    Random random(static_cast<std::uint64_t>(side));
    Fold fold;
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const double x = to_micro((i + 0.25 + 0.5 * random.real()) / side);
            const double y = to_micro((j + 0.25 + 0.5 * random.real()) / side);
            fold.samples.push_back({x, y, franke(function, x, y)});
        }
    }
    for (std::size_t i = 0; i < checks; ++i) {
        const double x = 0.2 + 0.6 * random.real();
        const double y = 0.2 + 0.6 * random.real();
        fold.checks.push_back({x, y, franke(function, x, y)});
    }
    return fold;
}

/// The order that the error is known to fall with at least, where the function is smooth.
double expected_order(tinwright::InterpolationMethod method) {
    using tinwright::InterpolationMethod;
    switch (method) {
        case InterpolationMethod::Nearest:
            return 1;
        case InterpolationMethod::CloughTocher:
            return 3;  // cubic, with gradients that are exact for quadrics
        default:
            return 2;  // that of limited surfaces too, as they are cut at peaks
    }
}

/// Root mean square errors of all contenders, relative to the range of z.
std::vector<double> errors_of(const Fold& fold, const std::vector<Contender>& contenders) {
    const FoldErrors found = find_errors(fold, contenders);
    std::vector<double> sums(contenders.size());
    for (const std::vector<double>& errors : found.errors) {
        for (std::size_t c = 0; c < sums.size(); ++c) {
            sums[c] += errors[c] * errors[c];
        }
    }
    for (double& sum : sums) {
        sum = std::sqrt(sum / static_cast<double>(found.errors.size()));
    }
    return sums;
}

/// The greatest error at a sample over the range of z, for all contenders.
std::vector<double> misses_at_samples(Fold fold, const std::vector<Contender>& contenders) {
    fold.checks = fold.samples;
    const FoldErrors found = find_errors(fold, contenders);
    const auto [low, high] =
        std::minmax_element(fold.samples.begin(), fold.samples.end(),
                            [](const tinwright::Point3& a, const tinwright::Point3& b) { return a.z < b.z; });
    std::vector<double> greatest(contenders.size());
    for (const std::vector<double>& errors : found.errors) {
        for (std::size_t c = 0; c < greatest.size(); ++c) {
            greatest[c] = std::max(greatest[c], std::abs(errors[c]) / (high->z - low->z));
        }
    }
    return greatest;
}

std::string scientific(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1e", value);
    return value == 0 ? "0" : text.data();
}

void measure(const Settings& settings) {
    const std::vector<Contender> contenders = contenders_of(settings.methods);
    const auto checks = std::min(kChecks, settings.count(static_cast<double>(kChecks)));
    std::printf("| RMSE with n x n samples |");
    for (const int side : kSides) {
        std::printf(" n = %d |", settings.side(side));
    }
    std::printf(" order | target | | greatest error at a sample |\n|---|");
    for (std::size_t i = 0; i < kSides.size() + 4; ++i) {
        std::printf("---|");
    }
    std::printf("\n");
    for (const int function : kFunctions) {
        std::vector<std::vector<double>> by_side;
        for (const int side : kSides) {
            by_side.push_back(errors_of(jittered(settings.side(side), function, checks), contenders));
        }
        const std::vector<double> misses =
            misses_at_samples(jittered(settings.side(kSides[1]), function, 0), contenders);
        for (std::size_t c = 0; c < contenders.size(); ++c) {
            std::printf("| f%d, %s |", function, contenders[c].name.c_str());
            for (const std::vector<double>& errors : by_side) {
                std::printf(" %s |", scientific(errors[c]).c_str());
            }
            // Over all halvings together: one alone depends on how its samples happen to lie.
            const double order =
                std::log2(by_side.front()[c] / by_side.back()[c]) / static_cast<double>(kSides.size() - 1);
            const std::optional<Target> target =
                at_least(expected_order(contenders[c].interpolation.method) - 0.1);
            const bool is_good = is_met(*target, order) && misses[c] <= 1e-9;
            std::printf(" %s | %s | %s | %s |\n", number(order).c_str(), to_text(*target).c_str(),
                        is_good ? "met" : "**missed**", scientific(misses[c]).c_str());
            std::fflush(stdout);
        }
    }
}

}  // namespace

void run_convergence(const Settings& settings) {
    tbb::task_arena().execute([&] { measure(settings); });
}

}  // namespace tinwright_benchmarks
