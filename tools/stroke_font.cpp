#include "stroke_font.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace tinwright::tools {

namespace {

/// Chains of points "xy", each point two digits; a slash begins a new chain, and a chain of one point twice
/// is a dot.
constexpr auto kLetters = std::to_array<std::pair<char, std::string_view>>({
    {'0', "18 07 01 10 30 41 47 38 18"},
    {'1', "06 28 20/10 30"},
    {'2', "07 18 38 47 45 00 40"},
    {'3', "07 18 38 47 45 34 14/34 43 41 30 10 01"},
    {'4', "30 38 03 43"},
    {'5', "48 08 05 35 44 41 30 10 01"},
    {'6', "47 38 18 07 01 10 30 41 43 34 14 03"},
    {'7', "08 48 10"},
    {'8', "14 05 07 18 38 47 45 34 14 03 01 10 30 41 43 34"},
    {'9', "01 10 30 41 47 38 18 07 05 14 34 45"},
    {'-', "04 44"},
    {'.', "20 20"},
    {',', "21 10"},
    {'+', "04 44/22 26"},
    {'(', "38 26 22 30"},
    {')', "18 26 22 10"},
    {'/', "00 48"},
    {':', "26 26/22 22"},
    {'A', "00 05 28 45 40/03 43"},
    {'B', "00 08 38 47 45 34 04/34 43 41 30 00"},
    {'C', "47 38 18 07 01 10 30 41"},
    {'D', "00 08 28 46 42 20 00"},
    {'E', "48 08 00 40/04 34"},
    {'F', "48 08 00/04 34"},
    {'G', "47 38 18 07 01 10 30 41 44 24"},
    {'H', "00 08/40 48/04 44"},
    {'I', "10 30/20 28/18 38"},
    {'J', "48 41 30 10 01"},
    {'K', "00 08/48 04 40"},
    {'L', "08 00 40"},
    {'M', "00 08 24 48 40"},
    {'N', "00 08 40 48"},
    {'O', "18 07 01 10 30 41 47 38 18"},
    {'P', "00 08 38 47 45 34 04"},
    {'Q', "18 07 01 10 30 41 47 38 18/22 40"},
    {'R', "00 08 38 47 45 34 04/24 40"},
    {'S', "47 38 18 07 05 14 34 43 41 30 10 01"},
    {'T', "08 48/28 20"},
    {'U', "08 01 10 30 41 48"},
    {'V', "08 20 48"},
    {'W', "08 10 24 30 48"},
    {'X', "00 48/08 40"},
    {'Y', "08 24 48/24 20"},
    {'Z', "08 48 00 40"},
});

double digit(char c) { return static_cast<double>(c - '0'); }

}  // namespace

std::vector<FontStroke> strokes_of(char letter) {
    const char capital = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
    std::vector<FontStroke> strokes;
    for (const auto& [known, chains] : kLetters) {
        // Points are three characters apart, the third being a blank or a slash.
        for (std::size_t i = 3; known == capital && i + 1 < chains.size(); i += 3) {
            if (chains[i - 1] == ' ') {
                strokes.push_back(
                    {digit(chains[i - 3]), digit(chains[i - 2]), digit(chains[i]), digit(chains[i + 1])});
            }
        }
    }
    return strokes;
}

}  // namespace tinwright::tools
