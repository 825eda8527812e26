#ifndef TINWRIGHT_TOOLS_OPTIONS_PRODUCTS_HPP
#define TINWRIGHT_TOOLS_OPTIONS_PRODUCTS_HPP

#include <string>
#include <vector>

#include "tinwright/surface/gridding.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

inline constexpr auto kSlopeUnits = std::to_array<std::pair<std::string_view, SlopeUnit>>(
    {{"degree", SlopeUnit::Degree}, {"percent", SlopeUnit::Percent}, {"ratio", SlopeUnit::Ratio}});

/// What a raster's cells tell of the surface.
struct ProductOptions {
    std::vector<std::string> product_texts;
    std::string slope_unit_text;
    std::string z_factor_text;
    std::string azimuth_text;
    std::string altitude_text;

    /// After `finish`.
    GriddingOptions options;

    void add_to(CLI::App& parser);
    /// Reads the texts. Throws UsageError for unknown names, bad numbers, and options of products that were
    /// not asked for.
    void finish();

    /// Whether any product depends on the unit of z being that of x and y.
    [[nodiscard]] bool has_gradients() const;
    /// The options that say what comes out, with a space before each; empty for plain elevations.
    [[nodiscard]] std::string canonical() const;
    /// `{product}` in `path` stands for the product's name: the files, one a product; else the path alone.
    [[nodiscard]] std::vector<std::string> targets(const std::string& path) const;
    /// Names of the products, in order.
    [[nodiscard]] std::vector<std::string> names() const;
};

}  // namespace tinwright::tools

#endif
