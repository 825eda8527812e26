#ifndef TINWRIGHT_TOOLS_LINE_DRAWING_HPP
#define TINWRIGHT_TOOLS_LINE_DRAWING_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"

namespace tinwright::tools {

struct Color {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
};

/// A picture of lines and words; positions in pixels from the upper left corner.
struct LineDrawing {
    struct Stroke {
        std::vector<Point2> points;  ///< a single one is a dot
        Color color;
        double width = 1;
    };
    enum class Anchor : std::uint8_t { Start, Middle, End };
    struct Label {
        Point2 at;  ///< on the baseline
        std::string text;
        Anchor anchor = Anchor::Start;
        Color color;
        bool is_upward = false;  ///< turned a quarter to the left
    };

    int width = 0;
    int height = 0;
    std::vector<Stroke> strokes;
    std::vector<Label> labels;
};

/// The drawing as a file of its own. Positions are given to a hundredth of a pixel.
std::string svg_text(const LineDrawing& drawing);

/// Pixels, three bytes each, row by row from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> bytes;
};

/// The drawing twice as large, smoothed. Letters come from a small font of our own: capitals, digits and the
/// signs of numbers; others are left blank.
Picture paint(const LineDrawing& drawing);

/// Writes a drawing as the target's extension says, .svg or .png, under a temporary name until it is
/// complete. Throws IoError.
void write_drawing(const LineDrawing& drawing, const std::string& target, bool overwrite);

}  // namespace tinwright::tools

#endif
