#include "options_products.hpp"

#include <algorithm>
#include <string_view>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr std::string_view kPlaceholder = "{product}";

/// Products by the names of --product: `gradient` is two of them.
std::vector<Product> products_named(const std::string& name) {
    if (name == "gradient") {
        return {Product::GradientX, Product::GradientY};
    }
    for (const auto& [candidate, product] : kProducts) {
        if (candidate == name && product != Product::GradientX && product != Product::GradientY) {
            return {product};
        }
    }
    throw UsageError(
        "--product takes elevation, slope, aspect, gradient, hillshade, nearest-distance or face-id, with "
        "commas between several, not " +
        io::quoted(name));
}

std::vector<Product> parse_products(const std::vector<std::string>& texts) {
    std::vector<Product> products;
    for (const std::string& text : texts) {
        for (std::size_t start = 0; start <= text.size();) {
            const std::size_t end = std::min(text.find(',', start), text.size());
            for (const Product product : products_named(text.substr(start, end - start))) {
                if (std::find(products.begin(), products.end(), product) != products.end()) {
                    throw UsageError("--product names " + text.substr(start, end - start) + " twice");
                }
                products.push_back(product);
            }
            start = end + 1;
        }
    }
    return products;
}

}  // namespace

void ProductOptions::add_to(CLI::App& parser) {
    add_repeatable(parser, "--product", product_texts, "NAME,...",
                   "elevation, slope, aspect, hillshade, ...");
    add_value(parser, "--slope-unit", slope_unit_text, "UNIT", "degree (default), percent or ratio");
    add_value(parser, "--z-factor", z_factor_text, "FACTOR", "heights count times this in slopes");
    // In the manual page, not on the screen of --help.
    add_value(parser, "--azimuth", azimuth_text, "DEGREES", "of the light, clockwise from north")->group("");
    add_value(parser, "--altitude", altitude_text, "DEGREES", "of the light above the horizon")->group("");
}

bool ProductOptions::has_gradients() const {
    return std::any_of(options.products.begin(), options.products.end(), is_from_gradient);
}

void ProductOptions::finish() {
    if (!product_texts.empty()) {
        options.products = parse_products(product_texts);
    }
    const auto has = [&](Product product) {
        return std::find(options.products.begin(), options.products.end(), product) != options.products.end();
    };
    if (!slope_unit_text.empty()) {
        options.slope_unit = choice_value("--slope-unit", slope_unit_text, kSlopeUnits);
        if (!has(Product::Slope)) {
            throw UsageError("--slope-unit is for --product slope");
        }
    }
    if (!z_factor_text.empty()) {
        options.z_factor = positive_value("--z-factor", z_factor_text);
        if (!has_gradients()) {
            throw UsageError("--z-factor is for --product slope, gradient, aspect and hillshade");
        }
    }
    if (!azimuth_text.empty()) {
        options.light.azimuth = number_value("--azimuth", azimuth_text);
    }
    if (!altitude_text.empty()) {
        options.light.altitude = number_value("--altitude", altitude_text);
        if (!(options.light.altitude > 0 && options.light.altitude <= 90)) {
            throw UsageError("--altitude takes degrees above 0 and up to 90, not " + altitude_text);
        }
    }
    if (!has(Product::Hillshade) && !(azimuth_text.empty() && altitude_text.empty())) {
        throw UsageError(std::string(azimuth_text.empty() ? "--altitude" : "--azimuth") +
                         " is for --product hillshade");
    }
}

std::string ProductOptions::canonical() const {
    if (options.products == std::vector{Product::Elevation}) {
        return {};
    }
    std::string text = " --product ";
    for (std::size_t i = 0; i < options.products.size(); ++i) {
        const Product product = options.products[i];
        if (product != Product::GradientY) {
            text += (i == 0 ? "" : ",") +
                    std::string(product == Product::GradientX ? "gradient" : product_name(product));
        }
    }
    const GriddingOptions usual;
    if (options.slope_unit != usual.slope_unit) {
        text += " --slope-unit " + choice_name(options.slope_unit, kSlopeUnits);
    }
    const auto add = [&](const std::string& name, double value, double usual_value) {
        text += value == usual_value ? "" : " --" + name + " " + decimal_text(value);
    };
    add("z-factor", options.z_factor, usual.z_factor);
    add("azimuth", options.light.azimuth, usual.light.azimuth);
    add("altitude", options.light.altitude, usual.light.altitude);
    return text;
}

std::vector<std::string> ProductOptions::names() const {
    std::vector<std::string> texts;
    for (const Product product : options.products) {
        texts.emplace_back(product_name(product));
    }
    return texts;
}

std::vector<std::string> ProductOptions::targets(const std::string& path) const {
    const std::size_t at = path.find(kPlaceholder);
    if (at == std::string::npos) {
        return {path};
    }
    std::vector<std::string> files;
    for (const std::string& name : names()) {
        files.push_back(path.substr(0, at) + name + path.substr(at + kPlaceholder.size()));
    }
    return files;
}

}  // namespace tinwright::tools
