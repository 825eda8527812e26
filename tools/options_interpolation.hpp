#ifndef TINWRIGHT_TOOLS_OPTIONS_INTERPOLATION_HPP
#define TINWRIGHT_TOOLS_OPTIONS_INTERPOLATION_HPP

#include <memory>
#include <string>
#include <vector>

#include "tinwright/surface/interpolation.hpp"

#include "parse_options.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

/// How a surface is read between its vertices.
struct InterpolationChoice {
    std::string method_text = "linear";
    std::string gradients_text;
    std::string kernels_text;
    std::string neighbors_text;
    std::string guard_text;

    /// After `finish`.
    InterpolationOptions options;

    void add_to(CLI::App& parser);
    /// Reads the texts. Throws UsageError for unknown names, bad numbers, and options that the method does
    /// not have.
    void finish();

    [[nodiscard]] bool is_linear() const { return options.method == InterpolationMethod::Linear; }
    /// The options that say what comes out, as one would type them.
    [[nodiscard]] std::string canonical() const;
    /// The surface of a TIN read or made. `threads`: 0 for all processors.
    [[nodiscard]] std::unique_ptr<Interpolator> make(const Surface& surface, int threads) const;
};

}  // namespace tinwright::tools

#endif
