#ifndef TINWRIGHT_TOOLS_STROKE_FONT_HPP
#define TINWRIGHT_TOOLS_STROKE_FONT_HPP

#include <vector>

namespace tinwright::tools {

/// A straight piece of a letter, in units of which a capital is four wide and eight high; y goes up from the
/// baseline.
struct FontStroke {
    double x0;
    double y0;
    double x1;
    double y1;
};

/// The pieces of a letter, small ones as capitals; none for a blank and for what the font does not have.
std::vector<FontStroke> strokes_of(char letter);

}  // namespace tinwright::tools

#endif
