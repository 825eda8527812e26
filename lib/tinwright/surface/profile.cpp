#include "tinwright/surface/profile.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/surface/segment_passage.hpp"

namespace tinwright {

struct ProfileCutter::State {
    explicit State(const Tin& tin) : faces(tin) {}

    FaceTree faces;
};

namespace {

using Kind = ProfilePoint::Kind;

constexpr double kMostPoints = 1e8;

/// Places are near enough for predicates up to twice as far out.
constexpr double kReach = 0x1p51;

/// Moves the end `a` of a segment to where the coordinate `axis` of keys comes within reach. False: it never
/// does.
bool clip_end(Key2& a, Key2 b, double Key2::*axis, double Key2::*other) {
    const double bound = std::clamp(a.*axis, -kReach, kReach);
    if (a.*axis == bound) {
        return true;
    }
    if ((b.*axis - bound) * (a.*axis - bound) >= 0) {
        return false;
    }
    const double part = (bound - a.*axis) / (b.*axis - a.*axis);
    a.*other = std::nearbyint(a.*other + part * (b.*other - a.*other));
    a.*axis = bound;
    return true;
}

/// The part of a segment that lies in the square of places twice as far out as vertices may be, its ends
/// rounded; empty where there is none.
std::optional<std::pair<Key2, Key2>> near_part(Key2 a, Key2 b) {
    for (const auto& [axis, other] : {std::pair{&Key2::x, &Key2::y}, std::pair{&Key2::y, &Key2::x}}) {
        if (!clip_end(a, b, axis, other) || !clip_end(b, a, axis, other)) {
            return std::nullopt;
        }
    }
    return std::pair{a, b};
}

/// A place that the line passes, and what lies behind it.
struct Station {
    Key2 at{};
    Point2 position{};
    double chainage = 0;
    Kind kind = Kind::Line;
    std::optional<FaceId> touched;
    std::optional<FaceId> cover;  ///< up to the next station
    bool is_step = false;         ///< a whole number of steps from the start, whatever else it is
};

class ProfileMaker {
  public:
    ProfileMaker(const FaceTree& faces, const ProfileOptions& options)
        : faces_(faces),
          options_(options),
          steps_per_unit_(faces.tin.lattice.steps_per_unit() * faces.lattice.scale()) {}

    void add_line(std::span<const Point2> line) {
        for (const Point2 position : line) {
            require_finite(position);
            const Key2 at = faces_.lattice.at(position);
            if (stations_.empty()) {
                stations_.push_back({at, position, 0, Kind::Line, {}, {}});
            } else if (at != stations_.back().at) {
                add_segment(position, at);
            }
        }
        if (stations_.size() == 1) {
            stations_.front().touched = face_at(stations_.front().at);
        }
    }

    std::vector<ProfilePoint> take_points() const {
        std::vector<ProfilePoint> points;
        points.reserve(stations_.size());
        std::uint32_t parts = 0;
        std::optional<FaceId> before;
        for (const Station& station : stations_) {
            const std::optional<FaceId> face = station.cover ? station.cover
                                               : before      ? before
                                                             : station.touched;
            if (face && !before) {
                ++parts;
            }
            const bool is_cut =
                !station.is_step && (station.kind == Kind::Vertex || station.kind == Kind::Edge);
            if (options_.has_cuts || !is_cut || !before || !station.cover) {
                ProfilePoint point{
                    station.position, station.chainage, station.kind, ProfilePoint::kOutside, {}};
                if (face) {
                    point.part = parts - 1;
                    point.place = SurfacePlace{*face, station.at};
                }
                points.push_back(point);
            }
            before = station.cover;
        }
        return points;
    }

  private:
    static void require_finite(Point2 position) {
        if (!std::isfinite(position.x) || !std::isfinite(position.y)) {
            throw InputError("a line has a position that is not finite: (" + decimal_text(position.x) + ", " +
                             decimal_text(position.y) + "); take it out");
        }
    }

    [[nodiscard]] std::optional<FaceId> face_at(Key2 at) const {
        if (!QueryLattice::is_near(at)) {
            return std::nullopt;
        }
        // To the nearest lattice point and no farther: what it touches at the start is what holds it.
        return find_passage(faces_, at, {at.x + 1, at.y}).touched.front();
    }

    [[nodiscard]] double distance(Key2 a, Key2 b) const {
        return options_.ground.is_geodesic()
                   ? options_.ground.length(faces_.lattice.position(a), faces_.lattice.position(b))
                   : std::hypot(b.x - a.x, b.y - a.y) / steps_per_unit_;
    }

    /// The part of the way from one place to another, `length` apart, after which `wanted` of it lies behind.
    /// In the plane the same everywhere; on the ground by secants, which start from that, or from the part
    /// that the step before missed.
    [[nodiscard]] double part_at(Key2 from, Key2 to, double wanted, double length) const {
        const double part = wanted / length;
        if (!options_.ground.is_geodesic()) {
            return part;
        }
        constexpr double kNear = 1e-7;  // of a unit on the ground, and no nearer than doubles tell
        constexpr int kMostSteps = 50;
        const Point2 a = faces_.lattice.position(from);
        const Point2 b = faces_.lattice.position(to);
        const double tolerance = std::max(kNear, 4e-16 * length);
        double found = part + last_miss_;
        for (int i = 0; i < kMostSteps; ++i) {
            const Point2 at{a.x + found * (b.x - a.x), a.y + found * (b.y - a.y)};
            const double off = wanted - options_.ground.length(a, at);
            if (!(std::abs(off) > tolerance)) {  // or it cannot be measured
                break;
            }
            found += off / length;  // scales differ little within a plane: each step gains digits
        }
        found = std::min(found, 1.0);
        last_miss_ = found - part;
        return found;
    }

    /// From the last station, which is the segment's start.
    void add_segment(Point2 position, Key2 to) {
        const Key2 from = stations_.back().at;
        const double start = stations_.back().chainage;
        const double length = distance(from, to);
        const std::size_t first = stations_.size() - 1;
        if (const auto part = near_part(from, to); part && part->first != part->second) {
            add_passage(find_passage(faces_, part->first, part->second), from, start);
        }
        if (stations_.size() - 1 > first && stations_.back().at == to) {
            end_touch_ = smaller(end_touch_, stations_.back().touched);
            stations_.pop_back();
        }
        const double chainage = std::max(stations_.back().chainage, start + length);
        stations_.push_back({to, position, chainage, Kind::Line, end_touch_, {}});
        end_touch_.reset();
        if (options_.step > 0) {
            add_steps(first, length);
        }
    }

    void add_passage(const SegmentPassage& passage, Key2 from, double start) {
        end_touch_ = passage.touched.back();
        stations_.back().touched = smaller(stations_.back().touched, passage.touched.front());
        stations_.back().cover = passage.covers.front();
        for (std::size_t i = 1; i + 1 < passage.marks.size(); ++i) {
            const PassageMark& mark = passage.marks[i];
            const Key2 at = mark.kind == PassageMark::Kind::Vertex ? mark.p : crossing_of(passage, mark);
            Station& last = stations_.back();
            if (at == last.at) {
                last.touched = smaller(last.touched, passage.touched[i]);
                last.cover = passage.covers[i];
                continue;
            }
            const Kind kind = mark.kind == PassageMark::Kind::Vertex ? Kind::Vertex : Kind::Edge;
            const double chainage = std::max(last.chainage, start + distance(from, at));
            stations_.push_back(
                {at, faces_.lattice.position(at), chainage, kind, passage.touched[i], passage.covers[i]});
        }
    }

    static Key2 crossing_of(const SegmentPassage& passage, const PassageMark& mark) {
        return round_crossing(passage.marks.front().p, passage.marks.back().p, mark.p, mark.q).key;
    }

    static std::optional<FaceId> smaller(std::optional<FaceId> a, std::optional<FaceId> b) {
        return !a || (b && *b < *a) ? b : a;
    }

    /// Into the segment from station `first` to the last one.
    void add_steps(std::size_t first, double length) {
        const Station start = stations_[first];
        const Key2 to = stations_.back().at;
        const double step = options_.step;
        if ((start.chainage + length) / step > kMostPoints) {
            throw InputError("a step of " + decimal_text(step) +
                             " makes more than 100 million points of a line " +
                             decimal_text(start.chainage + length) + " long: choose a longer --step");
        }
        std::vector<Station> with_steps;
        last_miss_ = 0;
        for (std::size_t i = first; i + 1 < stations_.size(); ++i) {
            Station& next = stations_[i + 1];
            with_steps.push_back(stations_[i]);
            for (double k = std::floor(stations_[i].chainage / step) + 1; k * step <= next.chainage; ++k) {
                const double part = part_at(start.at, to, k * step - start.chainage, length);
                const Key2 at{std::nearbyint(start.at.x + part * (to.x - start.at.x)),
                              std::nearbyint(start.at.y + part * (to.y - start.at.y))};
                if (at == next.at) {
                    next.is_step = true;
                } else if (at != with_steps.back().at) {
                    const std::optional<FaceId> face = stations_[i].cover;
                    with_steps.push_back(
                        {at, faces_.lattice.position(at), k * step, Kind::Step, face, face, true});
                } else {
                    with_steps.back().is_step = true;
                }
            }
        }
        with_steps.push_back(stations_.back());
        stations_.resize(first);
        stations_.insert(stations_.end(), with_steps.begin(), with_steps.end());
    }

    const FaceTree& faces_;
    const ProfileOptions& options_;
    double steps_per_unit_;
    std::vector<Station> stations_;
    std::optional<FaceId> end_touch_;  ///< of the segment at hand
    mutable double last_miss_ = 0;     ///< by how much `part_at` was off what the plane says
};

}  // namespace

ProfileCutter::ProfileCutter(const Tin& tin) : state_(std::make_unique<State>(tin)) {}
ProfileCutter::~ProfileCutter() = default;

std::vector<ProfilePoint> ProfileCutter::cut(std::span<const Point2> line,
                                             const ProfileOptions& options) const {
    ProfileMaker maker(state_->faces, options);
    maker.add_line(line);
    return maker.take_points();
}

}  // namespace tinwright
