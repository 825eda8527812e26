#include "benchmarks/report.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace tinwright_benchmarks {

std::string to_text(const Target& target, const std::string& unit) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g", target.value);
    return (target.kind == Target::Kind::AtMost ? "at most " : "at least ") + std::string(text.data()) + unit;
}

bool is_met(const Target& target, double figure) {
    return target.kind == Target::Kind::AtMost ? figure <= target.value : figure >= target.value;
}

std::string number(double value) {
    std::array<char, 64> text{};
    const double size = std::fabs(value);
    const int decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string in_seconds(double seconds) { return number(seconds) + " s"; }

std::string in_megabytes(double bytes) { return number(bytes / 1e6) + " MB"; }

ResultTable::ResultTable(const std::string& what, const std::string& ours, const std::string& other) {
    std::printf("| %s | %s | %s | figure | target | |\n|---|---|---|---|---|---|\n", what.c_str(),
                ours.c_str(), other.c_str());
}

void ResultTable::add(const std::string& what, const std::string& ours, const std::string& other,
                      std::optional<double> figure, std::optional<Target> target, const std::string& unit) {
    std::string verdict;
    if (figure && target) {
        verdict = is_met(*target, *figure) ? "met" : "**missed**";
    }
    std::printf("| %s | %s | %s | %s | %s | %s |\n", what.c_str(), ours.c_str(), other.c_str(),
                figure ? (number(*figure) + unit).c_str() : "not measured",
                target ? to_text(*target, unit).c_str() : "", verdict.c_str());
    std::fflush(stdout);
}

}  // namespace tinwright_benchmarks
