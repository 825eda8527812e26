#include "tinwright/delaunay/constrained_tin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "tinwright/breaklines/near_lines.hpp"
#include "tinwright/delaunay/border_points.hpp"
#include "tinwright/delaunay/constrained_delaunay.hpp"
#include "tinwright/delaunay/delaunay.hpp"
#include "tinwright/delaunay/drape.hpp"
#include "tinwright/delaunay/sample_meetings.hpp"
#include "tinwright/delaunay/terrain_ring.hpp"
#include "tinwright/delaunay/water_areas.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

std::vector<Point3> check_lines(std::span<const Breakline> lines) {
    std::vector<Point3> points;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::vector<Point3>& of_line = lines[i].points;
        if (of_line.empty()) {
            throw BreaklineError("a line has no points; remove it", {i});
        }
        const Point2 first{of_line.front().x, of_line.front().y};
        const Point2 last{of_line.back().x, of_line.back().y};
        if (is_polygon_role(lines[i].role) && !(first.x == last.x && first.y == last.y)) {
            throw BreaklineError("the ring of a " + std::string(role_name(lines[i].role)) +
                                     " is not closed: it begins at " + location_text(first) +
                                     " and ends at " + location_text(last) +
                                     "; close it, or give --snap with a distance above the gap",
                                 {i});
        }
        for (const Point3& p : of_line) {
            if (std::isinf(p.z)) {
                throw BreaklineError("the elevation of a line at " + location_text({p.x, p.y}) +
                                         " is infinite; remove the point or give its z",
                                     {i});
            }
        }
        points.insert(points.end(), of_line.begin(), of_line.end());
    }
    return points;
}

// Puts the job's parts together, one after the other.
class Maker {
  public:
    Maker(std::span<const Point3> samples, std::span<const Breakline> lines,
          const ConstrainedTinOptions& options)
        : samples_(samples), lines_(lines), options_(options), line_points_(check_lines(lines)) {}

    ConstrainedTin make() {
        const FoundLattice found = find_lattice(samples_, line_points_);
        result_.bounds = found.bounds;
        result_.lines.lines = lines_.size();
        result_.lines.line_points = line_points_.size();
        sample_vertices_ = make_sample_vertices(samples_, found, options_.duplicates);
        result_.duplicates = sample_vertices_.duplicates;
        prepare_drape();
        node();
        clear_water();
        merge();
        tin().mesh = make_delaunay(tin().keys, spare_vertices());
        if (tin().mesh.count_terrain() > 0) {
            lay_borders();
            insert_pieces();
        }
        resolve_elevations();
        lay_draped();
        if (options_.line_tolerance > 0) {
            report_near_samples();
        }
        return std::move(result_);
    }

  private:
    [[nodiscard]] Tin& tin() { return result_.tin; }
    [[nodiscard]] bool is_ring(std::uint32_t number) const { return number >= lines_.size(); }

    // Memory that is not touched costs nothing; moving a TIN to make room for Steiner points does.
    [[nodiscard]] std::size_t spare_vertices() const {
        return options_.wants_fine_lattice ? noded_.pieces.size() : 0;
    }

    void prepare_drape() {
        if (std::none_of(line_points_.begin(), line_points_.end(),
                         [](const Point3& p) { return std::isnan(p.z); })) {
            return;
        }
        if (sample_vertices_.keys.size() < 3) {
            throw InputError(
                "lines without z cannot be draped: there are not three samples to drape them on; give the "
                "lines' z with z=FIELD or z=NUMBER");
        }
        drape_.emplace(sample_vertices_.keys, sample_vertices_.z);
        result_.terrain_ring =
            find_terrain_ring(lines_, *drape_, sample_vertices_.lattice, sample_vertices_.keys);
        if (result_.terrain_ring) {
            lines_with_ring_.assign(lines_.begin(), lines_.end());
            lines_with_ring_.push_back(*result_.terrain_ring);
        }
    }

    // Cuts the lines on the refined lattice, and goes back to the plain one if nothing needs the refined.
    void node() {
        const Lattice& plain = sample_vertices_.lattice;
        const Key2 corner = plain.key({result_.bounds.x_max, result_.bounds.y_max});
        const int bits = plain.refinement_room(std::max(corner.x, corner.y));
        const Lattice fine = plain.refined(bits);
        noded_ = node_lines(result_.terrain_ring ? std::span<const Breakline>(lines_with_ring_) : lines_,
                            fine, options_.noding);
        const double scale = std::ldexp(1.0, bits);
        const auto is_plain = [scale](Key2 key) {
            return std::floor(key.x / scale) * scale == key.x && std::floor(key.y / scale) * scale == key.y;
        };
        for (std::uint32_t i = 0; i <= lines_.size(); ++i) {
            is_draped_.push_back(is_draped_line(i));
        }
        const bool has_draped_border =
            std::any_of(noded_.pieces.begin(), noded_.pieces.end(),
                        [this](const NodedPiece& piece) { return is_draped_border(piece); });
        if (options_.wants_fine_lattice || has_draped_border ||
            !std::all_of(noded_.keys.begin(), noded_.keys.end(), is_plain)) {
            tin().lattice = fine;
            // The drape looks at these keys too; a Delaunay triangulation stays one when they are scaled.
            for (Key2& key : sample_vertices_.keys) {
                key = {key.x * scale, key.y * scale};
            }
        } else {
            tin().lattice = plain;
            for (Key2& key : noded_.keys) {
                key = {key.x / scale, key.y / scale};
            }
        }
        first_line_.assign(noded_.keys.size(), LineConflict::kNone);
        is_on_ring_.assign(noded_.keys.size(), false);
        has_water_.assign(noded_.keys.size(), false);
        for (const NodedPiece& piece : noded_.pieces) {
            for (const std::uint32_t end : {piece.a, piece.b}) {
                first_line_[end] = std::min(first_line_[end], piece.line);
                has_water_[end] = has_water_[end] || is_water_line(piece.line);
                is_on_ring_[end] = is_on_ring_[end] || is_ring(piece.line);
            }
        }
        for (LineConflict& conflict : noded_.conflicts) {
            const bool is_of_ring = (conflict.line_a != LineConflict::kNone && is_ring(conflict.line_a)) ||
                                    (conflict.line_b != LineConflict::kNone && is_ring(conflict.line_b));
            if (!is_of_ring) {
                result_.lines.conflicts.push_back(conflict);
            }
        }
    }

    // What counts for nothing, as water is there.
    void clear_water() {
        water_.emplace(noded_, lines_);
        cleared_ = clear_areas(*water_, lines_, sample_vertices_.keys, noded_);
        result_.lines.cleared_samples = cleared_.sample_count;
        result_.lines.cleared_pieces = cleared_.piece_count;
    }

    [[nodiscard]] bool is_water_line(std::uint32_t number) const {
        return !is_ring(number) && is_water_role(lines_[number].role);
    }

    // A line that is draped all along, whatever it has got where it meets others. So is the ring.
    [[nodiscard]] bool is_draped_line(std::uint32_t number) const {
        return is_ring(number) || std::all_of(lines_[number].points.begin(), lines_[number].points.end(),
                                              [](const Point3& p) { return std::isnan(p.z); });
    }

    [[nodiscard]] bool is_draped_border(const NodedPiece& piece) const {
        return !is_ring(piece.line) && is_draped_[piece.line] && is_polygon_role(lines_[piece.line].role);
    }

    // A border takes nothing from the terrain: where it is draped, it gets a vertex at every edge it crosses,
    // so that the surface inside stays as it was.
    void lay_borders() {
        std::vector<Segment> borders;
        for (const NodedPiece& piece : noded_.pieces) {
            if (is_draped_border(piece)) {
                borders.push_back({vertex_of_[piece.a], vertex_of_[piece.b]});
            }
        }
        if (borders.empty()) {
            return;
        }
        border_points_ = find_border_points(tin().mesh, tin().keys, borders);
        merge();
        tin().mesh = make_delaunay(tin().keys, spare_vertices());
    }

    // All sets of vertices are in the curve's order; where they meet, a sample and lines share a vertex.
    void merge() {
        const auto& keys = sample_vertices_.keys;
        const auto& noded = noded_.keys;
        vertex_of_.resize(noded.size());
        tin().keys.clear();
        tin().z.clear();
        tin().sample.clear();
        draped_.clear();
        meetings_.clear();
        result_.lines.crossing_vertices = 0;
        result_.lines.draped_vertices = border_points_.size();
        const std::size_t most = keys.size() + noded.size() + border_points_.size() + spare_vertices();
        tin().keys.reserve(most);
        tin().z.reserve(most);
        tin().sample.reserve(most);
        std::size_t i = 0;
        std::size_t k = 0;
        auto border_point = border_points_.begin();
        for (;;) {
            i = next_kept(cleared_.samples, i);
            k = next_kept(cleared_.vertices, k);
            const VertexId v{static_cast<std::uint32_t>(tin().keys.size())};
            const bool has_border_point = border_point != border_points_.end() &&
                                          (i == keys.size() || precedes_on_curve(*border_point, keys[i])) &&
                                          (k == noded.size() || precedes_on_curve(*border_point, noded[k]));
            if (has_border_point) {
                add_vertex(*border_point++, kDraped, Tin::kCrossing);
                draped_.push_back(v);
                continue;
            }
            if (i == keys.size() && k == noded.size()) {
                return;
            }
            const bool has_sample =
                i < keys.size() && (k == noded.size() || !precedes_on_curve(noded[k], keys[i]));
            const bool has_line = k < noded.size() && (!has_sample || noded[k] == keys[i]);
            if (has_sample) {
                add_vertex(keys[i], sample_vertices_.z[i], sample_vertices_.sample[i]);
            } else {
                add_line_vertex(k);
            }
            if (has_line) {
                vertex_of_[k] = v;
            }
            if (has_line && has_sample && !std::isnan(noded_.z[k])) {
                meetings_.push_back({v, noded_.z[k], first_line_[k], has_water_[k]});
            }
            i += has_sample ? 1U : 0U;
            k += has_line ? 1U : 0U;
        }
    }

    /// The first from `i` on that is not left out.
    static std::size_t next_kept(const std::vector<char>& is_cleared, std::size_t i) {
        while (i < is_cleared.size() && is_cleared[i] != 0) {
            ++i;
        }
        return i;
    }

    void add_vertex(Key2 key, double z, std::uint32_t sample) {
        tin().keys.push_back(key);
        tin().z.push_back(z);
        tin().sample.push_back(sample);
    }

    /// A vertex of lines alone.
    void add_line_vertex(std::size_t k) {
        const bool is_crossing = noded_.origin[k] == NodedLines::kCrossing;
        const bool is_draped = std::isnan(noded_.z[k]);
        if (is_draped) {
            draped_.push_back({static_cast<std::uint32_t>(tin().keys.size())});
        }
        result_.lines.crossing_vertices += is_crossing && !is_on_ring_[k] ? 1U : 0U;
        result_.lines.draped_vertices += is_draped && !is_on_ring_[k] ? 1U : 0U;
        add_vertex(
            noded_.keys[k], noded_.z[k],
            is_crossing ? Tin::kCrossing : static_cast<std::uint32_t>(samples_.size()) + noded_.origin[k]);
    }

    void insert_pieces() {
        const std::vector<NodedPiece>& pieces = noded_.pieces;
        std::vector<Segment> segments;
        std::vector<std::size_t> first_piece;  // of each segment: several lines may run along it
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            if (p == 0 || pieces[p].a != pieces[p - 1].a || pieces[p].b != pieces[p - 1].b) {
                segments.push_back({vertex_of_[pieces[p].a], vertex_of_[pieces[p].b]});
                first_piece.push_back(p);
            }
        }
        first_piece.push_back(pieces.size());
        const std::vector<SegmentEdge> edges = insert_segments(tin().mesh, tin().keys, segments);

        std::vector<LineTrace>& traces = tin().traces;
        for (const SegmentEdge& edge : edges) {
            const NodedPiece* with_elevation = nullptr;
            for (std::size_t p = first_piece[edge.segment]; p < first_piece[edge.segment + 1]; ++p) {
                traces.push_back({edge.a, edge.b, pieces[p].line, pieces[p].runs});
                const bool has_elevation = !is_draped_[pieces[p].line];
                if (has_elevation && (with_elevation == nullptr || is_water_line(pieces[p].line))) {
                    with_elevation = &pieces[p];
                }
            }
            if (with_elevation != nullptr) {
                meet_samples(edge, segments[edge.segment], *with_elevation);
            }
        }
        std::sort(traces.begin(), traces.end());
        // Collinear pieces that overlap share edges.
        std::size_t kept = 0;
        for (const LineTrace& trace : traces) {
            if (kept > 0 && traces[kept - 1].a == trace.a && traces[kept - 1].b == trace.b &&
                traces[kept - 1].line == trace.line) {
                traces[kept - 1].runs += trace.runs;
            } else {
                traces[kept++] = trace;
            }
        }
        traces.resize(kept);
    }

    // Samples that a segment passes through, once each: as the later end of an edge.
    void meet_samples(const SegmentEdge& edge, const Segment& segment, const NodedPiece& piece) {
        const double z_a = noded_.z[piece.a];
        const double z_b = noded_.z[piece.b];
        if (std::isnan(z_a) || std::isnan(z_b)) {
            return;
        }
        const Key2 from = tin().key(segment.a);
        const Key2 to = tin().key(segment.b);
        const double length = squared_distance(from, to);
        const auto way = [&](VertexId v) { return inner_product(tin().key(v), from, to) / length; };
        const VertexId v = way(edge.a) < way(edge.b) ? edge.b : edge.a;
        if (v != segment.a && v != segment.b) {
            meetings_.push_back({v, z_a + way(v) * (z_b - z_a), piece.line, is_water_line(piece.line)});
        }
    }

    void resolve_elevations() {
        const std::vector<LineConflict> clashes =
            resolve_meetings(tin(), std::move(meetings_), options_.duplicates, result_.duplicates);
        result_.lines.conflicts.insert(result_.lines.conflicts.end(), clashes.begin(), clashes.end());
    }

    void lay_draped() {
        std::vector<VertexId> outside;
        for (const VertexId v : draped_) {
            if (const auto polygon = water_->around(tin().key(v))) {
                tin().z[v.value] = water_->level(*polygon, tin().key(v));
                continue;
            }
            const Drape::Elevation found = drape_->at(tin().key(v));
            tin().z[v.value] = found.z;
            if (found.is_outside) {
                outside.push_back(v);
            }
        }
        for (const std::uint32_t k : cleared_.borders) {
            const Key2 key = noded_.keys[k];
            tin().z[vertex_of_[k].value] = water_->level(*water_->around(key), key);
        }
        for (std::uint32_t k = 0, i = 0; k < vertex_of_.size(); ++k) {
            if (cleared_.vertices[k] != 0) {
                continue;
            }
            while (i < outside.size() && outside[i] < vertex_of_[k]) {
                ++i;  // of a border, between its points
            }
            if (i == outside.size() || vertex_of_[k] != outside[i] || is_on_ring_[k]) {
                continue;
            }
            LineConflict conflict;
            conflict.kind = LineConflict::Kind::OutsideSamples;
            conflict.action = LineConflict::Action::Clamped;
            conflict.line_a = first_line_[k];
            conflict.location = tin().lattice.position(tin().key(outside[i]));
            conflict.z_a = tin().z[outside[i].value];
            result_.lines.conflicts.push_back(conflict);
        }
    }

    void report_near_samples() {
        std::vector<CleanLine> on_lattice(lines_.size());
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            CleanLine& line = on_lattice[i];
            for (const Point3& p : lines_[i].points) {
                const Key2 key = tin().lattice.key({p.x, p.y});
                if (line.keys.empty() || line.keys.back() != key) {
                    line.keys.push_back(key);
                    line.z.push_back(p.z);
                }
            }
        }
        std::vector<Key2> keys;
        keys.reserve(samples_.size());
        for (const Point3& p : samples_) {
            keys.push_back(tin().lattice.key({p.x, p.y}));
        }
        const double reach = options_.line_tolerance / tin().lattice.quantum();
        constexpr double kAnyElevation = std::numeric_limits<double>::infinity();
        for (FoundConflict& found :
             find_samples_at_lines(samples_, keys, LineSegments(on_lattice), {kAnyElevation, reach})) {
            found.conflict.location = tin().lattice.position(found.key);
            result_.lines.conflicts.push_back(found.conflict);
        }
    }

    std::span<const Point3> samples_;
    std::span<const Breakline> lines_;
    const ConstrainedTinOptions& options_;
    std::vector<Point3> line_points_;
    std::vector<Breakline> lines_with_ring_;
    SampleVertices sample_vertices_;
    std::optional<Drape> drape_;
    NodedLines noded_;
    std::vector<VertexId> vertex_of_;        // of the noded vertices
    std::vector<std::uint32_t> first_line_;  // through each of the noded vertices
    std::vector<bool> is_on_ring_;           // each of the noded vertices
    std::vector<bool> has_water_;            // a line of water through each of the noded vertices
    std::optional<WaterAreas> water_;
    ClearedAreas cleared_;
    std::vector<bool> is_draped_;      // each line, and the ring
    std::vector<Key2> border_points_;  // vertices of draped borders, between those of their own
    std::vector<VertexId> draped_;     // vertices whose elevation is yet to be taken from the samples' TIN
    std::vector<SampleMeeting> meetings_;
    ConstrainedTin result_;
};

}  // namespace

ConstrainedTin make_constrained_tin(std::span<const Point3> samples, std::span<const Breakline> lines,
                                    const ConstrainedTinOptions& options) {
    return Maker(samples, lines, options).make();
}

}  // namespace tinwright
