#include "benchmarks/growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace tinwright_benchmarks {

namespace {

constexpr double kWidth = 640;
constexpr double kHeight = 360;
constexpr double kLeft = 60;
constexpr double kRight = 470;  // the names of the curves stand to the right of it
constexpr double kTop = 20;
constexpr double kBottom = 310;
constexpr std::array kColours{"#1f77b4", "#2ca02c", "#d62728", "#9467bd"};

std::string count_text(double count) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.0f", count);
    return text.data();
}

void print_head(const std::string& what, const std::vector<std::string>& columns, bool has_target) {
    std::printf("| %s |", what.c_str());
    for (const std::string& column : columns) {
        std::printf(" %s |", column.c_str());
    }
    std::printf(" exponent |%s\n|---|", has_target ? " target | |" : "");
    for (std::size_t i = 0; i < columns.size() + (has_target ? 3 : 1); ++i) {
        std::printf("---|");
    }
    std::printf("\n");
}

/// A line between decimal logarithms and pixels.
struct Scale {
    double low = 0;
    double high = 0;
    double from = 0;
    double to = 0;

    [[nodiscard]] double operator()(double value) const {
        return from + (to - from) * (std::log10(value) - low) / (high - low);
    }
};

std::string pixels(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f", value);
    return text.data();
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
    return "<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" text-anchor=\"" + anchor + "\">" + text +
           "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1) {
    return "<line x1=\"" + pixels(x0) + "\" y1=\"" + pixels(y0) + "\" x2=\"" + pixels(x1) + "\" y2=\"" +
           pixels(y1) + "\"/>\n";
}

double microseconds(const Growth::Step& step) { return 1e6 * step.seconds / step.count; }

std::string axes(const Scale& x, const Scale& y) {
    std::string svg = "<g stroke=\"#ccc\">\n";
    for (double decade = x.low; decade <= x.high; ++decade) {
        svg += line(x(std::pow(10, decade)), kTop, x(std::pow(10, decade)), kBottom);
    }
    std::vector<double> levels;
    for (double decade = y.low; decade <= y.high; ++decade) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const double level = factor * std::pow(10, decade);
            if (std::log10(level) <= y.high + 1e-9) {
                levels.push_back(level);
            }
        }
    }
    for (const double level : levels) {
        svg += line(kLeft, y(level), kRight, y(level));
    }
    svg += "</g>\n<g fill=\"#333\">\n";
    for (double decade = x.low; decade <= x.high; ++decade) {
        svg += label(x(std::pow(10, decade)), kBottom + 18, "middle", count_text(std::pow(10, decade)));
    }
    for (const double level : levels) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%g", level);
        svg += label(kLeft - 6, y(level) + 4, "end", text.data());
    }
    svg += label((kLeft + kRight) / 2, kBottom + 38, "middle", "points");
    return svg + label(kLeft, kTop - 7, "start", "microseconds a point") + "</g>\n";
}

}  // namespace

std::optional<double> Growth::exponent() const {
    if (steps.size() < 2) {
        return std::nullopt;
    }
    double mean_x = 0;
    double mean_y = 0;
    for (const Step& step : steps) {
        mean_x += std::log(step.count) / static_cast<double>(steps.size());
        mean_y += std::log(step.seconds) / static_cast<double>(steps.size());
    }
    double xx = 0;
    double xy = 0;
    for (const Step& step : steps) {
        const double x = std::log(step.count) - mean_x;
        xx += x * x;
        xy += x * (std::log(step.seconds) - mean_y);
    }
    return xx > 0 ? std::optional(xy / xx) : std::nullopt;
}

GrowthTable::GrowthTable(const std::string& what, std::span<const std::size_t> counts,
                         std::optional<Target> target)
    : columns_(counts.size()), tells_counts_(false), target_(target) {
    std::vector<std::string> columns;
    for (const std::size_t count : counts) {
        columns.push_back(std::to_string(count));
    }
    print_head(what, columns, target.has_value());
}

GrowthTable::GrowthTable(const std::string& what, std::size_t columns)
    : columns_(columns), tells_counts_(true) {
    print_head(what, std::vector<std::string>(columns, "points: seconds"), false);
}

void GrowthTable::add(const Growth& growth) {
    std::printf("| %s |", growth.name.c_str());
    for (std::size_t i = 0; i < columns_; ++i) {
        if (i >= growth.steps.size()) {
            std::printf(" not finished |");
            continue;
        }
        const Growth::Step& step = growth.steps[i];
        std::printf(" %s%s |", tells_counts_ ? (count_text(step.count) + ": ").c_str() : "",
                    in_seconds(step.seconds).c_str());
    }
    const std::optional<double> exponent = growth.exponent();
    std::printf(" %s |", exponent ? number(*exponent).c_str() : "");
    if (target_) {
        std::printf(" %s | %s |", to_text(*target_).c_str(),
                    !exponent                     ? ""
                    : is_met(*target_, *exponent) ? "met"
                                                  : "**missed**");
    }
    std::printf("\n");
    std::fflush(stdout);
}

void plot_growth(const std::string& path, std::span<const Growth> curves) {
    double least_count = 1e300;
    double most_count = 0;
    double least_time = 1e300;
    double most_time = 0;
    for (const Growth& curve : curves) {
        for (const Growth::Step& step : curve.steps) {
            least_count = std::min(least_count, step.count);
            most_count = std::max(most_count, step.count);
            least_time = std::min(least_time, microseconds(step));
            most_time = std::max(most_time, microseconds(step));
        }
    }
    if (most_count <= 0) {
        return;
    }
    const Scale x{std::floor(std::log10(least_count) + 0.01), std::ceil(std::log10(most_count) - 0.01), kLeft,
                  kRight};
    const Scale y{std::floor(std::log10(least_time)), std::log10(1.1 * most_time), kBottom, kTop};
    std::ofstream file(path);
    file << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << kWidth << ' ' << kHeight
         << "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" "
            "fill=\"#fff\"/>\n"
         << axes(x, y);
    std::vector<std::pair<double, std::string>> names;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Growth& curve = curves[i];
        const std::string colour = kColours[i % kColours.size()];
        const char* dashes = i < kColours.size() ? "" : " stroke-dasharray=\"6 3\"";
        if (curve.steps.empty()) {
            continue;
        }
        file << "<polyline fill=\"none\" stroke-width=\"2\" stroke=\"" << colour << "\"" << dashes
             << " points=\"";
        for (const Growth::Step& step : curve.steps) {
            file << pixels(x(step.count)) << ',' << pixels(y(microseconds(step))) << ' ';
        }
        file << "\"/>\n";
        names.emplace_back(y(microseconds(curve.steps.back())), "fill=\"" + colour + "\">" + curve.name);
    }
    // Names that would cover each other are moved down.
    std::sort(names.begin(), names.end());
    double last = 0;
    for (const auto& [height, text] : names) {
        last = std::max(height + 4, last + 14);
        file << "<text x=\"" << pixels(kRight + 8) << "\" y=\"" << pixels(last) << "\" " << text
             << "</text>\n";
    }
    file << "</svg>\n";
    if (!file.flush()) {
        throw std::runtime_error("cannot write " + path);
    }
}

}  // namespace tinwright_benchmarks
