#include "options_interpolation.hpp"

#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/surface/facets.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

/// One kernel of --smooth-kernels: EXPONENT[xSTRETCH[*HANDICAP]].
SmoothOptions::Kernel parse_kernel(const std::string& text) {
    const auto fail = [&]() -> UsageError {
        return UsageError(
            "--smooth-kernels takes kernels EXPONENT[xSTRETCH[*HANDICAP]] with commas between, as "
            "1.5,1x4*1.04,2.5, not " +
            io::quoted(text));
    };
    SmoothOptions::Kernel kernel{0, 1, 1};
    std::string rest = text;
    const auto take = [&](char separator, double& value) {
        const std::size_t at = rest.find(separator);
        if (at == std::string::npos) {
            return;
        }
        const std::optional<double> number = find_number(rest.substr(at + 1));
        if (!number) {
            throw fail();
        }
        value = *number;
        rest.resize(at);
    };
    take('*', kernel.handicap);
    take('x', kernel.stretch);
    const std::optional<double> exponent = find_number(rest);
    if (!exponent) {
        throw fail();
    }
    kernel.exponent = *exponent;
    return kernel;
}

std::vector<SmoothOptions::Kernel> parse_kernels(const std::string& text) {
    std::vector<SmoothOptions::Kernel> kernels;
    for (std::size_t start = 0; start <= text.size();) {
        const std::size_t end = std::min(text.find(',', start), text.size());
        kernels.push_back(parse_kernel(text.substr(start, end - start)));
        start = end + 1;
    }
    return kernels;
}

std::string kernels_name(const std::vector<SmoothOptions::Kernel>& kernels) {
    std::string text;
    for (const SmoothOptions::Kernel& kernel : kernels) {
        text += (text.empty() ? "" : ",") + decimal_text(kernel.exponent);
        // A handicap follows a stretch, were it one.
        text += kernel.stretch != 1 || kernel.handicap != 1 ? "x" + decimal_text(kernel.stretch) : "";
        text += kernel.handicap != 1 ? "*" + decimal_text(kernel.handicap) : "";
    }
    return text;
}

bool has_gradients(InterpolationMethod method) {
    return method == InterpolationMethod::NaturalNeighborC1 || method == InterpolationMethod::CloughTocher ||
           method == InterpolationMethod::CloughTocherLimit;
}

bool is_smooth(InterpolationMethod method) {
    return method == InterpolationMethod::Smooth || method == InterpolationMethod::SmoothC1;
}

}  // namespace

void InterpolationChoice::add_to(CLI::App& parser) {
    add_value(parser, "--method", method_text, "NAME", "linear, natural-neighbor, ..., smooth");
    add_value(parser, "--gradients", gradients_text, "NAME", "octant (default), ring or sibson");
    // For those who know what they do: in the manual page, not on the screen of --help.
    add_value(parser, "--smooth-kernels", kernels_text, "LIST", "exponents to choose from")->group("");
    add_value(parser, "--smooth-neighbors", neighbors_text, "N", "neighbours of a vertex")->group("");
    add_value(parser, "--smooth-guard", guard_text, "SHARE|none", "how far to leave their range")->group("");
}

void InterpolationChoice::finish() {
    options.method = choice_value("--method", method_text, kInterpolationMethods);
    if (!gradients_text.empty()) {
        options.gradients = choice_value("--gradients", gradients_text, kGradientMethods);
        if (!has_gradients(options.method)) {
            throw UsageError(
                "--gradients is for the methods natural-neighbor:c1 and clough-tocher, not for " +
                method_text);
        }
    }
    for (const auto& [name, text] :
         {std::pair{"--smooth-kernels", &kernels_text}, std::pair{"--smooth-neighbors", &neighbors_text},
          std::pair{"--smooth-guard", &guard_text}}) {
        if (!text->empty() && !is_smooth(options.method)) {
            throw UsageError(std::string(name) + " is for the methods smooth and smooth:c1, not for " +
                             method_text);
        }
    }
    if (!kernels_text.empty()) {
        options.smooth.kernels = parse_kernels(kernels_text);
    }
    if (!neighbors_text.empty()) {
        options.smooth.neighbors = static_cast<int>(whole_value("--smooth-neighbors", neighbors_text, 0));
    }
    if (!guard_text.empty()) {
        options.smooth.guard = guard_text == "none" ? std::numeric_limits<double>::infinity()
                                                    : number_value("--smooth-guard", guard_text);
    }
    options.smooth.is_c1 = options.method == InterpolationMethod::SmoothC1;
    check_interpolation(options);
}

std::string InterpolationChoice::canonical() const {
    std::string text = "--method " + method_text;
    const InterpolationOptions usual;
    if (options.gradients != usual.gradients) {
        text += " --gradients " + choice_name(options.gradients, kGradientMethods);
    }
    if (options.smooth.kernels != usual.smooth.kernels) {
        text += " --smooth-kernels " + kernels_name(options.smooth.kernels);
    }
    if (options.smooth.neighbors != usual.smooth.neighbors) {
        text += " --smooth-neighbors " + std::to_string(options.smooth.neighbors);
    }
    if (options.smooth.guard != usual.smooth.guard) {
        text += " --smooth-guard " +
                (std::isinf(options.smooth.guard) ? "none" : decimal_text(options.smooth.guard));
    }
    return text;
}

std::unique_ptr<Interpolator> InterpolationChoice::make(const Surface& surface, int threads) const {
    InterpolationOptions threaded = options;
    threaded.threads = threads;
    auto made = make_interpolator(surface.tin, SharpEdges(surface.tin, surface.is_line_sharp), threaded);
    return is_linear() ? std::move(made) : keep_facets(surface.tin, std::move(made), surface.is_water_face);
}

}  // namespace tinwright::tools
