#include "line_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include <cpl_vsi.h>
#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "stroke_font.hpp"

namespace tinwright::tools {

namespace {

std::string color_text(Color color) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", unsigned{color.red}, unsigned{color.green},
                  unsigned{color.blue});
    return text.data();
}

std::string pixel_text(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", value + 0.0);
    std::string digits = text.data();
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) {
        digits.pop_back();
    }
    return digits == "-0" ? "0" : digits;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string stroke_svg(const LineDrawing::Stroke& stroke) {
    std::string points;
    std::string last;
    for (const Point2 point : stroke.points) {
        std::string text = pixel_text(point.x) + "," + pixel_text(point.y);
        if (text != last) {  // points that no eye tells apart
            points += (points.empty() ? "" : " ") + text;
            last = std::move(text);
        }
    }
    if (points == last) {
        points += " " + last;  // a line of no length with round ends is a dot
    }
    return "<polyline points=\"" + points + "\" stroke=\"" + color_text(stroke.color) + "\" stroke-width=\"" +
           pixel_text(stroke.points.size() == 1 ? 2 * stroke.width : stroke.width) + "\"/>\n";
}

std::string label_svg(const LineDrawing::Label& label) {
    const std::string x = pixel_text(label.at.x);
    const std::string y = pixel_text(label.at.y);
    std::string text = "<text x=\"" + x + "\" y=\"" + y + "\" fill=\"" + color_text(label.color) + "\"";
    if (label.anchor != LineDrawing::Anchor::Start) {
        text +=
            label.anchor == LineDrawing::Anchor::Middle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
    }
    if (label.is_upward) {
        text += " transform=\"rotate(-90 " + x + " " + y + ")\"";
    }
    return text + ">" + escaped(label.text) + "</text>\n";
}

constexpr int kScale = 2;   // pixels painted for one of the drawing
constexpr int kLetter = 6;  // advance of a letter, pixels of the drawing

/// Strokes painted by the distance of pixels from them.
class Painter {
  public:
    explicit Painter(const LineDrawing& drawing)
        : picture_{drawing.width * kScale, drawing.height * kScale, {}} {
        picture_.bytes.assign(
            static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height) * 3, 255);
    }

    void add(const LineDrawing::Stroke& stroke) {
        const double half = kScale * (stroke.points.size() == 1 ? stroke.width : stroke.width / 2);
        for (std::size_t i = 0; i < stroke.points.size(); ++i) {
            const Point2 a = scaled(stroke.points[i == 0 ? 0 : i - 1]);
            const Point2 b = scaled(stroke.points[i]);
            if (i > 0 || stroke.points.size() == 1) {
                add_piece(a, b, half, stroke.color);
            }
        }
    }

    void add(const LineDrawing::Label& label) {
        const double length = kLetter * static_cast<double>(label.text.size());
        const double before = label.anchor == LineDrawing::Anchor::Start ? 0
                              : label.anchor == LineDrawing::Anchor::End ? length
                                                                         : length / 2;
        for (std::size_t i = 0; i < label.text.size(); ++i) {
            const double shift = kLetter * static_cast<double>(i) - before;
            for (const FontStroke& piece : strokes_of(label.text[i])) {
                const auto place = [&](double x, double y) {
                    const double along = shift + x;
                    return label.is_upward ? Point2{label.at.x - y, label.at.y - along}
                                           : Point2{label.at.x + along, label.at.y - y};
                };
                add_piece(scaled(place(piece.x0, piece.y0)), scaled(place(piece.x1, piece.y1)), 0.5 * kScale,
                          label.color);
            }
        }
    }

    Picture take() { return std::move(picture_); }

  private:
    static Point2 scaled(Point2 p) { return {p.x * kScale, p.y * kScale}; }

    void add_piece(Point2 a, Point2 b, double half, Color color) {
        const int left = pixel_below(std::min(a.x, b.x) - half - 1, picture_.width);
        const int right = pixel_below(std::max(a.x, b.x) + half + 1, picture_.width);
        const int top = pixel_below(std::min(a.y, b.y) - half - 1, picture_.height);
        const int bottom = pixel_below(std::max(a.y, b.y) + half + 1, picture_.height);
        const double along_x = b.x - a.x;
        const double along_y = b.y - a.y;
        const double square = along_x * along_x + along_y * along_y;
        for (int row = top; row <= bottom; ++row) {
            for (int column = left; column <= right; ++column) {
                const double x = column + 0.5 - a.x;
                const double y = row + 0.5 - a.y;
                const double part =
                    square > 0 ? std::clamp((x * along_x + y * along_y) / square, 0.0, 1.0) : 0.0;
                const double distance = std::hypot(x - part * along_x, y - part * along_y);
                blend(column, row, color, std::clamp(half + 0.5 - distance, 0.0, 1.0));
            }
        }
    }

    static int pixel_below(double value, int size) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size - 1)));
    }

    void blend(int column, int row, Color color, double cover) {
        if (cover <= 0) {
            return;
        }
        const std::size_t at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture_.width) +
                                    static_cast<std::size_t>(column));
        const std::array channels{color.red, color.green, color.blue};
        for (std::size_t i = 0; i < 3; ++i) {
            // The darker of what is there and what comes: pieces of one stroke overlap at their ends.
            const double value = 255 + cover * (static_cast<double>(channels[i]) - 255);
            const auto byte = static_cast<std::uint8_t>(std::lround(value));
            picture_.bytes[at + i] = cover >= 1 ? byte : std::min(picture_.bytes[at + i], byte);
        }
    }

    Picture picture_;
};

void write_svg(const LineDrawing& drawing, const std::string& path) {
    const std::string text = svg_text(drawing);
    VSILFILE* const file = VSIFOpenL(path.c_str(), "wb");
    const bool is_written = file != nullptr && VSIFWriteL(text.data(), 1, text.size(), file) == text.size();
    if ((file != nullptr && VSIFCloseL(file) != 0) || !is_written) {
        throw IoError("");
    }
}

void write_png(const LineDrawing& drawing, const std::string& path) {
    io::register_drivers();
    Picture picture = paint(drawing);
    GDALDriver* const memory = GetGDALDriverManager()->GetDriverByName("MEM");
    GDALDriver* const png = GetGDALDriverManager()->GetDriverByName("PNG");
    if (memory == nullptr || png == nullptr) {
        throw IoError("");
    }
    const std::unique_ptr<GDALDataset> image(
        memory->Create("", picture.width, picture.height, 3, GDT_Byte, nullptr));
    const bool is_filled =
        image != nullptr &&
        image->RasterIO(GF_Write, 0, 0, picture.width, picture.height, picture.bytes.data(), picture.width,
                        picture.height, GDT_Byte, 3, nullptr, 3, 3 * picture.width, 1, nullptr) == CE_None;
    const std::unique_ptr<GDALDataset> copy(
        is_filled ? png->CreateCopy(path.c_str(), image.get(), FALSE, nullptr, nullptr, nullptr) : nullptr);
    if (copy == nullptr) {
        throw IoError("");
    }
}

}  // namespace

std::string svg_text(const LineDrawing& drawing) {
    const std::string width = std::to_string(drawing.width);
    const std::string height = std::to_string(drawing.height);
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" +
                       height + "\" viewBox=\"0 0 " + width + " " + height +
                       "\" font-family=\"sans-serif\" font-size=\"12\">\n"
                       "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n"
                       "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    for (const LineDrawing::Stroke& stroke : drawing.strokes) {
        text += stroke_svg(stroke);
    }
    text += "</g>\n";
    for (const LineDrawing::Label& label : drawing.labels) {
        text += label_svg(label);
    }
    return text + "</svg>\n";
}

Picture paint(const LineDrawing& drawing) {
    Painter painter(drawing);
    for (const LineDrawing::Stroke& stroke : drawing.strokes) {
        painter.add(stroke);
    }
    for (const LineDrawing::Label& label : drawing.labels) {
        painter.add(label);
    }
    return painter.take();
}

void write_drawing(const LineDrawing& drawing, const std::string& target, bool overwrite) {
    const io::GdalMessages messages;
    io::AtomicOutput output(target, overwrite);
    try {
        if (target.ends_with(".png")) {
            write_png(drawing, output.path());
        } else {
            write_svg(drawing, output.path());
        }
    } catch (const IoError&) {
        throw IoError("cannot write " + io::quoted(target) + messages.suffix());
    }
    output.commit();
}

}  // namespace tinwright::tools
