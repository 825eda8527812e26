#ifndef TINWRIGHT_TOOLS_OPTIONS_SAMPLE_HPP
#define TINWRIGHT_TOOLS_OPTIONS_SAMPLE_HPP

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/surface/products.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// "x,y" as a position in the surface's CRS; nothing when the text is not two numbers.
std::optional<Point2> find_coordinate(const std::string& text);

/// A parser takes "-3,4" for an option: such tokens become "--at=-3,4", with or without an --at before them.
std::vector<std::string> rewrite_coordinates(const std::vector<std::string>& arguments);

/// One --at: a position, or a source of points or lines.
using Whereabouts = std::variant<Point2, io::Source>;

/// Where a surface is read, and how that is told.
struct SampleOptions {
    std::vector<std::string> at_texts;
    std::string step_text;
    std::string slope_unit_text = "degree";
    std::string plot;  ///< file; empty: none

    // After `finish`:
    std::vector<Whereabouts> at;
    double step = 0;  ///< 0: none given
    SlopeUnit slope_unit = SlopeUnit::Degree;

    void add_to(CLI::App& parser);
    void add_slope_unit_to(CLI::App& parser);
    /// Reads the texts; `open_options` (--oo) join those of each source. Throws UsageError.
    void finish(const std::vector<std::string>& open_options);

    /// The sources among `at`.
    [[nodiscard]] std::vector<io::Source> sources() const;
    /// The options that say what comes out, as one would type them.
    [[nodiscard]] std::string canonical() const;
};

}  // namespace tinwright::tools

#endif
