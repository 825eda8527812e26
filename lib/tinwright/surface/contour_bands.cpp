#include "tinwright/surface/contour_bands.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/mesh/border.hpp"
#include "tinwright/surface/band_rings.hpp"
#include "tinwright/surface/contour_sites.hpp"

namespace tinwright {

namespace {

/// Which half-edges and faces lie in which bands. Band j lies between the levels j - 1 and j, both included.
/// The piece of a face in a band is convex; here are those with an area.
class BandPieces {
  public:
    BandPieces(const TriangleMesh& mesh, const ContourSites& sites) : mesh_(mesh), sites_(sites) {}

    /// The bands that a face has pieces in.
    [[nodiscard]] LevelRange bands_of(FaceId f) const {
        const ContourSite& a = sites_[mesh_.vertex(f, 0)];
        const ContourSite& b = sites_[mesh_.vertex(f, 1)];
        const ContourSite& c = sites_[mesh_.vertex(f, 2)];
        const std::uint32_t highest = std::max({a.below, b.below, c.below});
        // A level face at a level belongs below it.
        return {std::min({a.reached, b.reached, c.reached, highest}), highest + 1};
    }
    /// The bands that touch a half-edge from the side of its face, in more than a point.
    [[nodiscard]] LevelRange bands_along(HalfEdgeId h) const {
        const ContourSite& a = sites_[mesh_.origin(h)];
        const ContourSite& b = sites_[mesh_.destination(h)];
        if (a.z != b.z) {
            return {std::min(a.reached, b.reached), std::max(a.below, b.below) + 1};
        }
        const std::uint32_t band = sites_[mesh_.origin(previous(h))].z > a.z ? a.reached : a.below;
        return {band, band + 1};
    }
    /// Whether band j ends at a half-edge, from whose face it touches it.
    [[nodiscard]] bool ends_at(HalfEdgeId h, std::uint32_t band) const {
        const HalfEdgeId other = mesh_.twin(h);
        if (!mesh_.is_terrain(face_of(other))) {
            return true;
        }
        const LevelRange bands = bands_along(other);
        return band < bands.first || band >= bands.last;
    }

  private:
    const TriangleMesh& mesh_;
    const ContourSites& sites_;
};

/// Where things are to be found, by band or level.
struct BandLists {
    LevelLists faces_of_levels;  // that a level crosses, something of them being above it
    LevelLists faces;            // of bands
    LevelLists border;           // of bands: border half-edges, as indices
    std::vector<HalfEdgeId> border_edges;
};

/// A side of a band's boundary, the band on its left: a piece of a half-edge, or a way through a face along a
/// level.
struct Side {
    enum class Kind { Edge, Lower, Upper };
    Kind kind = Kind::Edge;
    HalfEdgeId h{};  ///< of an edge; else any of the face
};

/// Finds the polygons of one band after the other, on one thread.
class BandTracer {
  public:
    BandTracer(const TriangleMesh& mesh, const ContourSites& sites, const BandLists& lists)
        : mesh_(mesh),
          sites_(sites),
          lists_(lists),
          pieces_(mesh, sites),
          lower_done_(mesh.slot_count(), 0),
          upper_done_(mesh.slot_count(), 0),
          index_(mesh.slot_count(), 0) {}

    std::vector<BandPolygon> trace(std::uint32_t band) {
        band_ = band;
        join_faces();
        find_edges();
        ways_.clear();
        start_at_lower_level();
        start_at_upper_level();
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (!edges_done_[i]) {
                follow({Side::Kind::Edge, edges_[i]});
            }
        }
        return collect();
    }

  private:
    struct Way {
        std::uint32_t area = 0;  // the connected area it goes around
        std::vector<Point2> points;
    };

    [[nodiscard]] bool has_upper() const { return band_ < sites_.levels().size(); }
    [[nodiscard]] bool is_at_upper(VertexId v) const { return has_upper() && sites_.is_at(v, band_); }
    [[nodiscard]] bool is_at_lower(VertexId v) const { return band_ > 0 && sites_.is_at(v, band_ - 1); }
    [[nodiscard]] bool is_over(VertexId v) const { return sites_[v].below > band_; }
    [[nodiscard]] bool is_under(VertexId v) const { return sites_[v].reached < band_; }

    [[nodiscard]] std::uint32_t root(std::uint32_t i) {
        while (parents_[i] != i) {
            parents_[i] = parents_[parents_[i]];
            i = parents_[i];
        }
        return i;
    }

    /// Joins the pieces of faces that share part of an edge.
    void join_faces() {
        const std::span<const std::uint32_t> faces = lists_.faces.of(band_);
        parents_.resize(faces.size());
        std::iota(parents_.begin(), parents_.end(), 0U);
        for (std::uint32_t i = 0; i < faces.size(); ++i) {
            index_[faces[i]] = i;
        }
        for (const std::uint32_t f : faces) {
            for (unsigned corner = 0; corner < 3; ++corner) {
                const HalfEdgeId h = half_edge({f}, corner);
                const FaceId other = face_of(mesh_.twin(h));
                const LevelRange bands = pieces_.bands_along(h);
                if (other.value < f && bands.first <= band_ && band_ < bands.last &&
                    !pieces_.ends_at(h, band_)) {
                    const std::uint32_t a = root(index_[f]);
                    const std::uint32_t b = root(index_[other.value]);
                    parents_[std::max(a, b)] = std::min(a, b);
                }
            }
        }
    }

    /// The half-edges that the band ends at: on the border, or level, with another band behind.
    void find_edges() {
        edges_.clear();
        for (const std::uint32_t i : lists_.border.of(band_)) {
            edges_.push_back(lists_.border_edges[i]);
        }
        const auto add_level_edges = [&](std::uint32_t level) {
            for (const std::uint32_t f : lists_.faces_of_levels.of(level)) {
                for (unsigned corner = 0; corner < 3; ++corner) {
                    const HalfEdgeId h = half_edge({f}, corner);
                    if (sites_.is_at(mesh_.origin(h), level) && sites_.is_at(mesh_.destination(h), level)) {
                        add_level_edge(level + 1 == band_ ? h : mesh_.twin(h));
                    }
                }
            }
        };
        if (band_ > 0) {
            add_level_edges(band_ - 1);
        }
        if (has_upper()) {
            add_level_edges(band_);
        }
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
        edges_done_.assign(edges_.size(), false);
    }

    void add_level_edge(HalfEdgeId h) {
        if (!mesh_.is_terrain(face_of(h))) {
            return;
        }
        if (pieces_.bands_along(h).first == band_ && pieces_.ends_at(h, band_)) {
            edges_.push_back(h);
        }
    }

    /// Whether a level passes through the inside of a face, not only along its edge or at a corner.
    [[nodiscard]] bool is_cut(FaceId f, std::uint32_t level) const {
        for (unsigned corner = 0; corner < 3; ++corner) {
            if (sites_[mesh_.vertex(f, corner)].reached <= level) {
                return true;
            }
        }
        return false;
    }

    void start_at_lower_level() {
        if (band_ == 0) {
            return;
        }
        for (const std::uint32_t f : lists_.faces_of_levels.of(band_ - 1)) {
            if (lower_done_[f] != band_ + 1 && is_cut({f}, band_ - 1)) {
                follow({Side::Kind::Lower, half_edge({f}, 0)});
            }
        }
    }
    void start_at_upper_level() {
        if (!has_upper()) {
            return;
        }
        for (const std::uint32_t f : lists_.faces_of_levels.of(band_)) {
            if (upper_done_[f] != band_ + 1 && is_cut({f}, band_)) {
                follow({Side::Kind::Upper, half_edge({f}, 0)});
            }
        }
    }

    /// Marks a side as done; false if it was.
    bool take(const Side& side) {
        if (side.kind == Side::Kind::Edge) {
            const auto at = static_cast<std::size_t>(std::lower_bound(edges_.begin(), edges_.end(), side.h) -
                                                     edges_.begin());
            const bool is_new = !edges_done_[at];
            edges_done_[at] = true;
            return is_new;
        }
        std::vector<std::uint32_t>& done = side.kind == Side::Kind::Lower ? lower_done_ : upper_done_;
        std::uint32_t& mark = done[face_of(side.h).value];
        const bool is_new = mark != band_ + 1;
        mark = band_ + 1;
        return is_new;
    }

    /// Follows the boundary of the band from a side until it comes back.
    void follow(Side side) {
        Way way;
        way.area = root(index_[face_of(side.h).value]);
        while (take(side)) {
            const Point2 from = start_of(side);
            if (way.points.empty() || way.points.back() != from) {
                way.points.push_back(from);
            }
            side = next_side(side);
        }
        if (way.points.size() > 1 && way.points.front() == way.points.back()) {
            way.points.pop_back();
        }
        ways_.push_back(std::move(way));
    }

    /// The half-edge of a face that falls or rises through a level.
    [[nodiscard]] HalfEdgeId through(FaceId f, std::uint32_t level, bool is_falling) const {
        unsigned corner = 0;
        while (!(sites_.is_above(mesh_.vertex(f, corner), level) == is_falling &&
                 sites_.is_above(mesh_.vertex(f, next_corner(corner)), level) != is_falling)) {
            ++corner;
        }
        return half_edge(f, corner);
    }
    [[nodiscard]] Point2 vertex_point(VertexId v) const { return {sites_[v].x, sites_[v].y}; }
    [[nodiscard]] Point2 crossing(HalfEdgeId h, std::uint32_t level) const {
        return sites_.crossing(mesh_.origin(h), mesh_.destination(h), level);
    }

    /// Along the lower level a way enters a face where its edge falls through the level, along the upper one,
    /// which has the band below it, where it rises.
    [[nodiscard]] Point2 start_of(const Side& side) const {
        switch (side.kind) {
            case Side::Kind::Lower:
                return crossing(through(face_of(side.h), band_ - 1, true), band_ - 1);
            case Side::Kind::Upper:
                return crossing(through(face_of(side.h), band_, false), band_);
            default:
                break;
        }
        const VertexId from = mesh_.origin(side.h);
        if (is_under(from)) {
            return crossing(side.h, band_ - 1);
        }
        return is_over(from) ? crossing(side.h, band_) : vertex_point(from);
    }

    [[nodiscard]] Side next_side(const Side& side) const {
        const FaceId f = face_of(side.h);
        if (side.kind == Side::Kind::Edge) {
            const VertexId to = mesh_.destination(side.h);
            if (is_over(to)) {
                return {Side::Kind::Upper, half_edge(f, 0)};
            }
            return is_under(to) ? Side{Side::Kind::Lower, half_edge(f, 0)} : turn(next(side.h));
        }
        const bool is_lower = side.kind == Side::Kind::Lower;
        const HalfEdgeId out = through(f, is_lower ? band_ - 1 : band_, !is_lower);
        if (is_lower && is_at_lower(mesh_.origin(out))) {
            return turn(out);
        }
        if (!is_lower && is_at_upper(mesh_.destination(out))) {
            return turn(next(out));
        }
        const FaceId behind = face_of(mesh_.twin(out));
        return mesh_.is_terrain(behind) ? Side{side.kind, half_edge(behind, 0)} : Side{Side::Kind::Edge, out};
    }

    /// The first side of the band's boundary from the origin of `h` on, clockwise, beginning with `h`; the
    /// band touches `h` from its face, or has no more of that face than a corner cut off at the origin.
    [[nodiscard]] Side turn(HalfEdgeId h) const {
        for (;; h = next(mesh_.twin(h))) {
            const VertexId from = mesh_.origin(h);
            const VertexId to = mesh_.destination(h);
            if (is_at_upper(from) && is_over(to)) {
                return {Side::Kind::Upper, half_edge(face_of(h), 0)};
            }
            if (is_at_lower(from) && is_under(to)) {
                return {Side::Kind::Lower, half_edge(face_of(h), 0)};
            }
            if (pieces_.ends_at(h, band_)) {
                return {Side::Kind::Edge, h};
            }
        }
    }

    /// All ways around one connected area make one polygon.
    std::vector<BandPolygon> collect() {
        std::stable_sort(ways_.begin(), ways_.end(),
                         [](const Way& a, const Way& b) { return a.area < b.area; });
        std::vector<BandPolygon> polygons;
        std::vector<BandRing> rings;
        for (std::size_t i = 0; i < ways_.size(); ++i) {
            cut_rings(std::move(ways_[i].points), rings);
            if (i + 1 == ways_.size() || ways_[i + 1].area != ways_[i].area) {
                if (!rings.empty()) {
                    polygons.push_back(as_polygon(std::move(rings)));
                }
                rings.clear();
            }
        }
        std::sort(polygons.begin(), polygons.end(),
                  [](const BandPolygon& a, const BandPolygon& b) { return precedes(a, b); });
        return polygons;
    }

    const TriangleMesh& mesh_;
    const ContourSites& sites_;
    const BandLists& lists_;
    BandPieces pieces_;
    std::vector<std::uint32_t> lower_done_;  // by face: the last band it was done for, plus one
    std::vector<std::uint32_t> upper_done_;
    std::vector<std::uint32_t> index_;    // of a face among those of the band
    std::vector<std::uint32_t> parents_;  // by index
    std::vector<HalfEdgeId> edges_;       // sorted
    std::vector<bool> edges_done_;
    std::vector<Way> ways_;
    std::uint32_t band_ = 0;
};

BandLists make_lists(const TriangleMesh& mesh, const ContourSites& sites) {
    const std::size_t levels = sites.levels().size();
    const BandPieces pieces(mesh, sites);
    BandLists lists;
    LargeVector<LevelRange> ranges = crossed_levels(mesh, sites);
    lists.faces_of_levels = list_by_level(ranges, levels);
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        ranges[f] = mesh.is_terrain({f}) ? pieces.bands_of({f}) : LevelRange{0, 0};
    }
    lists.faces = list_by_level(ranges, levels + 1);
    lists.border_edges = find_border(mesh);
    ranges.clear();
    for (const HalfEdgeId h : lists.border_edges) {
        ranges.push_back(pieces.bands_along(h));
    }
    lists.border = list_by_level(ranges, levels + 1);
    return lists;
}

std::vector<Band> divide(const TriangleMesh& mesh, const ContourSites& sites, const Progress& progress) {
    report_progress(progress, 0);
    const std::span<const double> levels = sites.levels();
    const BandLists lists = make_lists(mesh, sites);
    report_progress(progress, 0.2);
    std::vector<Band> bands(levels.size() + 1);
    tbb::enumerable_thread_specific<BandTracer> tracers([&] { return BandTracer(mesh, sites, lists); });
    tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t band) {
        bands[band].polygons = tracers.local().trace(static_cast<std::uint32_t>(band));
    });
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        for (unsigned corner = 0; corner < 3 && mesh.is_terrain({f}); ++corner) {
            lowest = std::min(lowest, sites[mesh.vertex({f}, corner)].z);
            highest = std::max(highest, sites[mesh.vertex({f}, corner)].z);
        }
    }
    for (std::size_t band = 0; band < bands.size(); ++band) {
        bands[band].low = band == 0 ? lowest : std::max(lowest, levels[band - 1]);
        bands[band].high = band == levels.size() ? highest : std::min(highest, levels[band]);
    }
    std::erase_if(bands, [](const Band& band) { return band.polygons.empty(); });
    report_progress(progress, 1);
    return bands;
}

}  // namespace

std::vector<Band> make_bands(const Tin& tin, std::span<const double> levels, const Progress& progress) {
    return divide(tin.mesh, ContourSites(tin, levels), progress);
}

std::vector<Band> make_bands(const TriangleMesh& mesh, std::span<const Point3> vertices,
                             std::span<const double> levels, const Progress& progress) {
    return divide(mesh, ContourSites(vertices, levels), progress);
}

}  // namespace tinwright
