#include "gdal_spellings.hpp"

#include <array>
#include <string_view>
#include <utility>

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kSpellings{{
    {"-of", "--of"},
    {"-co", "--co"},
    {"-te", "--extent"},
    {"-tr", "--resolution"},
    {"-ts", "--size"},
    {"-tap", "--tap"},
    {"-a_srs", "--source-crs"},
    {"-a_nodata", "--nodata"},
    {"-oo", "--oo"},
    {"-lco", "--lco"},
    {"-ot", "--ot"},
    {"-nln", "--layer-name"},
    {"-overwrite", "--overwrite"},
}};

std::string long_spelling(const std::string& token) {
    for (const auto& [ours, theirs] : kSpellings) {
        if (token == ours) {
            return std::string(theirs);
        }
    }
    return token;
}

/// A parser that knows short options takes "-.5" for one of them, but "-0.5" for a number.
std::string with_leading_zero(const std::string& token) {
    return token.starts_with("-.") && find_number(token) ? "-0" + token.substr(1) : token;
}

}  // namespace

std::vector<std::string> rewrite_gdal_spellings(const std::vector<std::string>& arguments) {
    std::vector<std::string> rewritten;
    rewritten.reserve(arguments.size());
    std::size_t i = 0;
    while (i < arguments.size() && arguments[i] != "--") {
        const std::string token = long_spelling(arguments[i++]);
        rewritten.push_back(with_leading_zero(token));
        const bool is_resolution = token == "--resolution" || token.starts_with("--resolution=");
        if (!is_resolution) {
            continue;
        }
        if (token == "--resolution" && i < arguments.size()) {
            rewritten.push_back(with_leading_zero(arguments[i++]));
        }
        if (i < arguments.size() && find_number(rewritten.back().substr(rewritten.back().find('=') + 1)) &&
            find_number(arguments[i])) {
            rewritten.back() += "," + arguments[i++];
        }
    }
    rewritten.insert(rewritten.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
    return rewritten;
}

}  // namespace tinwright::tools
