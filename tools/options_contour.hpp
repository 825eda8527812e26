#ifndef TINWRIGHT_TOOLS_OPTIONS_CONTOUR_HPP
#define TINWRIGHT_TOOLS_OPTIONS_CONTOUR_HPP

#include <optional>
#include <string>

#include "tinwright/surface/contour_levels.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// Which contours are wanted, and as what.
struct ContourChoice {
    std::string interval_text;
    std::string base_text;
    std::string levels_text;
    std::string index_text;
    std::string tolerance_text;
    bool is_bands = false;

    // After `finish`:
    ContourRequest request;
    std::optional<double> tolerance;

    void add_to(CLI::App& parser);
    /// Reads the texts. Throws UsageError. `is_linear`: lines are cut, not traced.
    void finish(bool is_linear);
    /// The options that say what comes out, as one would type them.
    [[nodiscard]] std::string canonical() const;
};

}  // namespace tinwright::tools

#endif
