#include "tinwright/io/output_positions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/coordinate_transform.hpp"

namespace tinwright::io {

namespace {

// Written steps to a degree. Positions in the plane are rounded to micrometres, which are 1e-11 degrees:
// decimals of up to nine places, a tenth of a millimetre, come back as they were.
constexpr double kDegreeSteps = 1e10;
constexpr double kLengthSteps = 1e6;  // and to another unit
constexpr double kFiner = 100;        // where vertices would not come back to their places in the plane
constexpr int kNet = 16;              // parts that bounds are divided into each way

double rounded(double value, double steps) {
    const double scaled = value * steps;
    return std::abs(scaled) < 0x1p53 ? std::nearbyint(scaled) / steps + 0.0 : value;
}

/// `longitude` by whole turns to [west, west + 360).
double eastward_from(double west, double longitude) {
    const double turned = longitude - 360 * std::floor((longitude - west) / 360);
    return turned < west + 360 ? turned : turned - 360;  // where the division was rounded
}

/// A net of positions over bounds, its border included.
std::vector<Point2> net_over(const Box& box) {
    std::vector<Point2> net;
    for (int row = 0; row <= kNet; ++row) {
        for (int column = 0; column <= kNet; ++column) {
            net.push_back({box.x_min + (box.x_max - box.x_min) * column / kNet,
                           box.y_min + (box.y_max - box.y_min) * row / kNet});
        }
    }
    return net;
}

/// Where longitudes begin: in the middle of the widest gap between those of `net`, or at -180 where they go
/// all around.
double find_cut(const std::vector<Point2>& net) {
    std::vector<double> longitudes;
    for (const Point2 p : net) {
        if (std::isfinite(p.x)) {
            longitudes.push_back(eastward_from(-180, p.x));
        }
    }
    std::sort(longitudes.begin(), longitudes.end());
    double widest = 0;
    double cut = -180;
    for (std::size_t i = 0; i < longitudes.size(); ++i) {
        const bool is_last = i + 1 == longitudes.size();
        const double next = is_last ? longitudes.front() + 360 : longitudes[i + 1];
        if (next - longitudes[i] > widest) {
            widest = next - longitudes[i];
            // The data's west, which the gap ends at, is to be in [-180, 180).
            cut = (is_last ? longitudes.front() : longitudes[i + 1]) - widest / 2;
        }
    }
    constexpr double kLeastGap = 90;  // a net around a pole has none so wide
    return widest < kLeastGap ? -180 : cut;
}

}  // namespace

struct OutputPositions::State {
    State(const Crs& plane, const Crs& output)
        : transform(plane.horizontal(), output.horizontal()),
          names("from " + plane.name() + " to " + output.name()),
          is_geographic(output.is_geographic()) {}

    [[nodiscard]] Point2 finished(Point2 p, double finer = 1) const {
        const double steps = finer * (is_geographic ? kDegreeSteps : kLengthSteps);
        return {rounded(is_geographic ? eastward_from(cut, p.x) : p.x, steps), rounded(p.y, steps)};
    }
    [[nodiscard]] std::vector<Point3> transformed(std::span<const Point2> positions,
                                                  const Progress& progress) const {
        std::vector<Point3> points;
        points.reserve(positions.size());
        for (const Point2 p : positions) {
            points.push_back({p.x, p.y, 0});
        }
        const std::vector<std::size_t> failed = transform.forward(std::span(points), progress);
        if (!failed.empty()) {
            refuse(positions[failed.front()]);
        }
        return points;
    }
    [[noreturn]] void refuse(Point2 p) const {
        throw InputError("(" + decimal_text(p.x) + ", " + decimal_text(p.y) + ") cannot be transformed " +
                         names + ": choose another --crs");
    }

    CoordinateTransform transform;
    std::string names;
    bool is_geographic;
    double cut = -180;
};

bool OutputPositions::is_geographic() const { return state_ && state_->is_geographic; }

OutputPositions::OutputPositions(const Crs& plane, const Crs& output, const Box& bounds) {
    if (!plane.is_known() || !output.is_known() || plane.is_same_horizontally(output)) {
        return;
    }
    auto state = std::make_shared<State>(plane, output);
    if (state->is_geographic && !bounds.is_empty()) {
        std::vector<Point2> net = net_over(bounds);
        state->transform.forward(std::span(net));
        state->cut = find_cut(net);
    }
    state_ = std::move(state);
}

std::vector<Point2> OutputPositions::transform(std::span<const Point2> positions,
                                               const Progress& progress) const {
    std::vector<Point2> written(positions.begin(), positions.end());
    if (is_identity()) {
        return written;
    }
    const std::vector<Point3> points = state_->transformed(positions, progress);
    for (std::size_t i = 0; i < points.size(); ++i) {
        written[i] = state_->finished({points[i].x, points[i].y});
    }
    return written;
}

std::vector<Point2> OutputPositions::transform_reversibly(std::span<const Point2> positions) const {
    std::vector<Point2> written(positions.begin(), positions.end());
    if (is_identity()) {
        return written;
    }
    const std::vector<Point3> points = state_->transformed(positions, {});
    std::vector<Point3> back;
    back.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        written[i] = state_->finished({points[i].x, points[i].y});
        back.push_back({written[i].x, written[i].y, 0});
    }
    state_->transform.inverse(std::span(back));
    for (std::size_t i = 0; i < points.size(); ++i) {
        // Readers round to the plane's steps.
        const bool is_back = rounded(back[i].x, kLengthSteps) == rounded(positions[i].x, kLengthSteps) &&
                             rounded(back[i].y, kLengthSteps) == rounded(positions[i].y, kLengthSteps);
        if (!is_back) {
            written[i] = state_->finished({points[i].x, points[i].y}, kFiner);
        }
    }
    return written;
}

Point2 OutputPositions::transform(Point2 position) const {
    if (is_identity()) {
        return position;
    }
    Point2 p = position;
    state_->transform.forward(std::span(&p, 1));
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
        state_->refuse(position);
    }
    return state_->finished(p);
}

void OutputPositions::apply_to(std::span<Point3> points) const {
    if (is_identity()) {
        return;
    }
    std::vector<Point2> positions;
    positions.reserve(points.size());
    for (const Point3& p : points) {
        positions.push_back({p.x, p.y});
    }
    positions = transform(positions);
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].x = positions[i].x;
        points[i].y = positions[i].y;
    }
}

Box OutputPositions::bounds(const Box& of_plane) const {
    if (is_identity() || of_plane.is_empty()) {
        return of_plane;
    }
    Box box;
    std::vector<Point2> net = net_over(of_plane);
    state_->transform.forward(std::span(net));
    for (const Point2 p : net) {
        if (std::isfinite(p.x) && std::isfinite(p.y)) {
            const Point2 written = state_->finished(p);
            box.add(written.x, written.y);
        }
    }
    return box;
}

std::vector<Point2> written_vertices(const Tin& tin, const OutputPositions& positions) {
    if (positions.is_identity()) {
        return {};
    }
    std::vector<Point2> vertices;
    vertices.reserve(tin.vertex_count());
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        const Point3 p = tin.position({v});
        vertices.push_back({p.x, p.y});
    }
    return positions.transform_reversibly(vertices);
}

namespace {

/// Chains of points, which get further ones between theirs where chords need them.
class ChordDivider {
  public:
    explicit ChordDivider(const OutputPositions& positions) : positions_(positions) {}

    /// Collects the points of a chain; all that are collected are transformed together.
    void collect(std::span<const Point2> chain) {
        ends_.insert(ends_.end(), chain.begin(), chain.end());
        for (std::size_t i = 0; i < chain.size(); ++i) {
            middles_.push_back(i + 1 < chain.size() ? middle(chain[i], chain[i + 1]) : chain[i]);
        }
    }
    void transform() {
        written_ends_ = positions_.transform(ends_);
        written_middles_ = positions_.transform(middles_);
    }

    /// Appends the next of the chains collected, which has so many points, as it is written.
    void take(std::size_t count, std::vector<Point2>& written) {
        for (std::size_t i = next_; i < next_ + count; ++i) {
            written.push_back(written_ends_[i]);
            if (i + 1 < next_ + count) {
                divide(place(i), place(i + 1), written_middles_[i], 0, written);
            }
        }
        next_ += count;
    }

  private:
    struct Place {
        Point2 plane;
        Point2 output;
    };

    [[nodiscard]] Place place(std::size_t i) const { return {ends_[i], written_ends_[i]}; }
    static Point2 middle(Point2 a, Point2 b) { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; }
    /// In units of which there are as many to a length whichever way it goes.
    [[nodiscard]] double written_distance(Point2 a, Point2 b) const {
        constexpr double kRadians = std::numbers::pi / 180;
        const double narrowing = positions_.is_geographic() ? std::cos((a.y + b.y) / 2 * kRadians) : 1;
        return std::hypot((b.x - a.x) * narrowing, b.y - a.y);
    }

    void divide(const Place& a, const Place& b, Point2 output_middle, int depth,
                std::vector<Point2>& written) const {
        constexpr int kDeepest = 12;
        const double chord = written_distance(a.output, b.output);
        const double off = written_distance(middle(a.output, b.output), output_middle);
        // In units of the plane, by how long the chord is in both.
        const double in_plane = off * std::hypot(b.plane.x - a.plane.x, b.plane.y - a.plane.y);
        if (depth == kDeepest || !(in_plane > kChordTolerance * chord)) {
            return;
        }
        const Place m{middle(a.plane, b.plane), output_middle};
        divide(a, m, positions_.transform(middle(a.plane, m.plane)), depth + 1, written);
        written.push_back(m.output);
        divide(m, b, positions_.transform(middle(m.plane, b.plane)), depth + 1, written);
    }

    const OutputPositions& positions_;
    std::vector<Point2> ends_;
    std::vector<Point2> middles_;  // behind each end
    std::vector<Point2> written_ends_;
    std::vector<Point2> written_middles_;
    std::size_t next_ = 0;
};

}  // namespace

std::vector<LevelLines> written_lines(std::span<const LevelLines> lines, const OutputPositions& positions) {
    std::vector<LevelLines> written;
    for (const LevelLines& of_level : lines) {
        ChordDivider divider(positions);
        for (std::size_t i = 0; i < of_level.count(); ++i) {
            divider.collect(of_level.line(i));
        }
        divider.transform();
        LevelLines& level = written.emplace_back();
        for (std::size_t i = 0; i < of_level.count(); ++i) {
            divider.take(of_level.line(i).size(), level.points);
            level.ends.push_back(level.points.size());
        }
    }
    return written;
}

std::vector<Band> written_bands(std::span<const Band> bands, const OutputPositions& positions) {
    std::vector<Band> written;
    for (const Band& band : bands) {
        ChordDivider divider(positions);
        for (const BandPolygon& polygon : band.polygons) {
            for (const BandRing& ring : polygon) {
                divider.collect(ring);
            }
        }
        divider.transform();
        Band& made = written.emplace_back(Band{band.low, band.high, {}});
        for (const BandPolygon& polygon : band.polygons) {
            BandPolygon& rings = made.polygons.emplace_back();
            for (const BandRing& ring : polygon) {
                divider.take(ring.size(), rings.emplace_back());
            }
        }
    }
    return written;
}

}  // namespace tinwright::io
