#include "profile_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tinwright/geometry/box.hpp"
#include "tinwright/geometry/decimal.hpp"

namespace tinwright::tools {

namespace {

constexpr int kWidth = 960;
constexpr int kHeight = 480;
constexpr double kLeft = 90;
constexpr double kRight = 24;
constexpr double kTop = 24;
constexpr double kBottom = 64;
constexpr std::size_t kNamed = 8;  // curves that have a colour and a name of their own

constexpr Color kInk{40, 40, 40};
constexpr Color kGrid{224, 224, 224};
// Told apart in grey and by people who see few colours.
constexpr std::array<Color, kNamed> kColors{{{0, 92, 158},
                                             {200, 82, 0},
                                             {0, 128, 96},
                                             {160, 40, 120},
                                             {110, 110, 0},
                                             {90, 150, 210},
                                             {120, 70, 30},
                                             {70, 70, 70}}};

Box bounds_of(const std::vector<ProfileCurve>& curves) {
    Box bounds;
    for (const ProfileCurve& curve : curves) {
        for (const std::vector<Point2>& part : curve.parts) {
            for (const Point2 point : part) {
                bounds.add(point.x, point.y);
            }
        }
    }
    return bounds;
}

/// One axis: from where to where, in numbers and in pixels, and every how much there is a number.
struct Axis {
    double low = 0;
    double high = 1;
    double tick = 1;
    int decimals = 0;
    double first_pixel = 0;
    double last_pixel = 1;

    [[nodiscard]] double pixel(double value) const {
        return first_pixel + (value - low) / (high - low) * (last_pixel - first_pixel);
    }
    [[nodiscard]] std::string text(double value) const {
        std::array<char, 64> text{};
        std::snprintf(text.data(), text.size(), "%.*f", decimals, value + 0.0);
        return text.data();
    }
};

/// 1, 2 or 5 times a power of ten, about a `parts`th of the span.
Axis make_axis(double low, double high, double parts, double first_pixel, double last_pixel) {
    if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) {
        const double room = std::max(1e-3 * std::max(std::abs(low), std::abs(high)), 0.5);
        low -= room;
        high += room;
    }
    const double rough = (high - low) / parts;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    Axis axis{low, high, 1, 0, first_pixel, last_pixel};
    axis.tick = power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
    axis.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(axis.tick) + 1e-9)));
    return axis;
}

template <class Visit>
void for_each_tick(const Axis& axis, const Visit& visit) {
    const double first = std::ceil(axis.low / axis.tick - 1e-9);
    const double last = std::floor(axis.high / axis.tick + 1e-9);
    for (double i = first; i <= last; ++i) {
        visit(i * axis.tick);
    }
}

std::string with_unit(const std::string& what, const std::string& unit) {
    return unit.empty() ? what : what + ", " + unit;
}

class ProfileDrawing {
  public:
    ProfileDrawing(const Box& bounds, const ProfileUnits& units) : units_(units) {
        const double room = 0.06 * (bounds.y_max - bounds.y_min);
        across_ = make_axis(bounds.x_min, bounds.x_max, 9, kLeft, kWidth - kRight);
        up_ = make_axis(bounds.y_min - room, bounds.y_max + room, 6, kHeight - kBottom, kTop);
        drawing_.width = kWidth;
        drawing_.height = kHeight;
    }

    void add_axes() {
        const double floor = up_.first_pixel;
        for_each_tick(across_, [&](double value) {
            const double x = across_.pixel(value);
            drawing_.strokes.push_back({{{x, kTop}, {x, floor}}, kGrid, 1});
            drawing_.labels.push_back(
                {{x, floor + 18}, across_.text(value), LineDrawing::Anchor::Middle, kInk, false});
        });
        for_each_tick(up_, [&](double value) {
            const double y = up_.pixel(value);
            drawing_.strokes.push_back({{{kLeft, y}, {across_.last_pixel, y}}, kGrid, 1});
            drawing_.labels.push_back(
                {{kLeft - 8, y + 4}, up_.text(value), LineDrawing::Anchor::End, kInk, false});
        });
        drawing_.strokes.push_back({{{kLeft, kTop}, {kLeft, floor}, {across_.last_pixel, floor}}, kInk, 1});
        drawing_.labels.push_back({{(kLeft + across_.last_pixel) / 2, kHeight - 22.0},
                                   with_unit("distance", units_.distance),
                                   LineDrawing::Anchor::Middle,
                                   kInk,
                                   false});
        drawing_.labels.push_back({{20, (kTop + floor) / 2},
                                   with_unit("elevation", units_.elevation),
                                   LineDrawing::Anchor::Middle,
                                   kInk,
                                   true});
        add_exaggeration();
    }

    void add_curve(const ProfileCurve& curve, Color color) {
        for (const std::vector<Point2>& part : curve.parts) {
            LineDrawing::Stroke stroke{{}, color, 1.6};
            for (const Point2 point : part) {
                stroke.points.push_back({across_.pixel(point.x), up_.pixel(point.y)});
            }
            drawing_.strokes.push_back(std::move(stroke));
        }
    }

    void add_name(std::size_t place, const std::string& name, Color color) {
        drawing_.labels.push_back({{across_.last_pixel - 8, kTop + 16 + 16 * static_cast<double>(place)},
                                   name,
                                   LineDrawing::Anchor::End,
                                   color,
                                   false});
    }

    LineDrawing take() { return std::move(drawing_); }

  private:
    void add_exaggeration() {
        if (units_.distance.empty() || units_.distance != units_.elevation) {
            return;
        }
        const double across = (across_.last_pixel - across_.first_pixel) / (across_.high - across_.low);
        const double up = (up_.first_pixel - up_.last_pixel) / (up_.high - up_.low);
        std::array<char, 32> number{};
        std::snprintf(number.data(), number.size(), "%.3g", up / across);
        drawing_.labels.push_back({{across_.last_pixel, kHeight - 22.0},
                                   "heights x " + std::string(number.data()),
                                   LineDrawing::Anchor::End,
                                   kInk,
                                   false});
    }

    const ProfileUnits& units_;
    Axis across_;
    Axis up_;
    LineDrawing drawing_;
};

}  // namespace

LineDrawing draw_profiles(const std::vector<ProfileCurve>& curves, const ProfileUnits& units) {
    Box bounds = bounds_of(curves);
    if (bounds.is_empty()) {
        bounds = {0, 0, 1, 1};
    }
    ProfileDrawing drawing(bounds, units);
    drawing.add_axes();
    for (std::size_t i = 0; i < curves.size(); ++i) {
        drawing.add_curve(curves[i], kColors[i % kNamed]);
    }
    for (std::size_t i = 0; i < std::min(curves.size(), kNamed) && curves.size() > 1; ++i) {
        drawing.add_name(i, curves[i].name, kColors[i]);
    }
    if (curves.size() > kNamed) {
        drawing.add_name(kNamed, "and " + std::to_string(curves.size() - kNamed) + " more", kInk);
    }
    return drawing.take();
}

}  // namespace tinwright::tools
