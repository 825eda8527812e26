#include "tinwright/surface/traced_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/mesh_edit.hpp"

namespace tinwright {

namespace {

constexpr std::size_t kVertexLimit = 50'000'000;
constexpr std::size_t kGrain = 64;

Key2 middle(Key2 a, Key2 b) { return {std::nearbyint((a.x + b.x) / 2), std::nearbyint((a.y + b.y) / 2)}; }

class Tracer {
  public:
    Tracer(const Tin& tin, const Interpolator& surface, std::span<const double> levels, double tolerance)
        : tin_(tin),
          surface_(surface),
          levels_(levels),
          tolerance_(tolerance),
          lattice_(tin),
          mesh_(tin.mesh),
          z_(tin.z.begin(), tin.z.end()),
          readers_([&surface] { return surface.make_reader(); }) {
        keys_.reserve(tin.vertex_count());
        for (const Key2 key : tin.keys) {
            keys_.push_back(lattice_.scaled(key));
        }
        hosts_.resize(mesh_.slot_count());
        for (std::uint32_t f = 0; f < hosts_.size(); ++f) {
            hosts_[f] = {f};
        }
    }

    TracedSurface trace(const Progress& progress);

  private:
    enum class Verdict : std::uint8_t { Fine, Coarse };

    [[nodiscard]] double read(SurfaceReader& reader, FaceId host, Key2 at) const {
        return reader.elevation({host, at});
    }
    [[nodiscard]] bool is_near_level(double low, double high) const {
        const auto at = std::lower_bound(levels_.begin(), levels_.end(), low);
        return at != levels_.end() && *at <= high;
    }
    void check_faces(const std::vector<FaceId>& faces, std::vector<Verdict>& verdicts);
    Verdict check_face(FaceId f, SurfaceReader& reader);
    double line_error(FaceId f, SurfaceReader& reader) const;
    [[nodiscard]] HalfEdgeId longest_edge(FaceId f) const;
    [[nodiscard]] bool is_longer(HalfEdgeId a, HalfEdgeId b) const;
    [[nodiscard]] bool can_split(HalfEdgeId h, Key2 at) const;
    [[nodiscard]] FaceId canonical_host(FaceId a, FaceId b) const;
    void split(HalfEdgeId h);
    bool halve(FaceId f);
    void read_new_vertices(std::size_t first);
    void number_by_position();

    const Tin& tin_;
    const Interpolator& surface_;
    std::span<const double> levels_;
    double tolerance_;
    QueryLattice lattice_;
    TriangleMesh mesh_;
    std::vector<double> z_;
    std::vector<Key2> keys_;            // in steps of the query lattice
    std::vector<FaceId> hosts_;         // by slot: the face of the TIN that it is part of
    std::vector<FaceId> vertex_hosts_;  // of new vertices
    std::vector<double> errors_;        // by slot: of the lines through it
    std::vector<FaceId> halves_;        // slots that have changed, or are new
    tbb::enumerable_thread_specific<std::unique_ptr<SurfaceReader>> readers_;
};

/// The greatest error of the lines through a face, at their ends and middles.
double Tracer::line_error(FaceId f, SurfaceReader& reader) const {
    std::array<VertexId, 3> v = mesh_.face(f).vertex;
    std::sort(v.begin(), v.end(), [this](VertexId a, VertexId b) { return z_[a.value] < z_[b.value]; });
    const auto z = [&](std::size_t i) { return z_[v[i].value]; };
    const auto place = [&](std::size_t low, std::size_t high, double level) {
        const Key2 a = keys_[v[low].value];
        const Key2 b = keys_[v[high].value];
        const double t = (level - z(low)) / (z(high) - z(low));
        return Key2{std::nearbyint(a.x + t * (b.x - a.x)), std::nearbyint(a.y + t * (b.y - a.y))};
    };
    double error = 0;
    for (auto at = std::lower_bound(levels_.begin(), levels_.end(), z(0)); at != levels_.end() && *at < z(2);
         ++at) {
        const Key2 p = place(0, 2, *at);
        const Key2 q = *at < z(1) ? place(0, 1, *at) : place(1, 2, *at);
        for (const Key2 where : {p, q, middle(p, q)}) {
            error = std::max(error, std::abs(read(reader, hosts_[f.value], where) - *at));
        }
    }
    return error;
}

Tracer::Verdict Tracer::check_face(FaceId f, SurfaceReader& reader) {
    const std::array<VertexId, 3>& v = mesh_.face(f).vertex;
    double low = std::min({z_[v[0].value], z_[v[1].value], z_[v[2].value]});
    double high = std::max({z_[v[0].value], z_[v[1].value], z_[v[2].value]});
    double error = 0;
    const auto compare = [&](Key2 at, double expected) {
        const double found = read(reader, hosts_[f.value], at);
        error = std::max(error, std::abs(found - expected));
        low = std::min(low, found);
        high = std::max(high, found);
    };
    Key2 sum{0, 0};
    double z_sum = 0;
    for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t a = v[i].value;
        const std::uint32_t b = v[next_corner(i)].value;
        compare(middle(keys_[a], keys_[b]), (z_[a] + z_[b]) / 2);
        sum = {sum.x + keys_[a].x, sum.y + keys_[a].y};
        z_sum += z_[a];
    }
    compare({std::nearbyint(sum.x / 3), std::nearbyint(sum.y / 3)}, z_sum / 3);
    errors_[f.value] = 0;
    if (!is_near_level(low - error, high + error)) {
        return Verdict::Fine;
    }
    if (error > tolerance_ / 2) {
        errors_[f.value] = error;  // counts if the face cannot be halved
        return Verdict::Coarse;
    }
    errors_[f.value] = line_error(f, reader);
    return errors_[f.value] > tolerance_ ? Verdict::Coarse : Verdict::Fine;
}

void Tracer::check_faces(const std::vector<FaceId>& faces, std::vector<Verdict>& verdicts) {
    errors_.resize(mesh_.slot_count());
    verdicts.resize(faces.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces.size(), kGrain), [&](const auto& part) {
        SurfaceReader& reader = *readers_.local();
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
            verdicts[i] = check_face(faces[i], reader);
        }
    });
}

/// A total order of edges, by length and then by place: nothing depends on numbers of faces or vertices.
bool Tracer::is_longer(HalfEdgeId a, HalfEdgeId b) const {
    std::array<Key2, 2> p{keys_[mesh_.origin(a).value], keys_[mesh_.destination(a).value]};
    std::array<Key2, 2> q{keys_[mesh_.origin(b).value], keys_[mesh_.destination(b).value]};
    if (const int order = compare_distances(p[0], p[1], q[0], q[1]); order != 0) {
        return order > 0;
    }
    for (std::array<Key2, 2>* const ends : {&p, &q}) {
        if (precedes((*ends)[1], (*ends)[0])) {
            std::swap((*ends)[0], (*ends)[1]);
        }
    }
    return precedes(p[0], q[0]) || (p[0] == q[0] && precedes(p[1], q[1]));
}

HalfEdgeId Tracer::longest_edge(FaceId f) const {
    HalfEdgeId longest = half_edge(f, 0);
    for (unsigned corner = 1; corner < 3; ++corner) {
        const HalfEdgeId h = half_edge(f, corner);
        longest = is_longer(h, longest) ? h : longest;
    }
    return longest;
}

bool Tracer::can_split(HalfEdgeId h, Key2 at) const {
    for (const HalfEdgeId side : {h, mesh_.twin(h)}) {
        if (mesh_.is_ghost(face_of(side))) {
            continue;
        }
        const Key2 apex = keys_[mesh_.origin(previous(side)).value];
        if (orient2d(keys_[mesh_.origin(side).value], at, apex) <= 0 ||
            orient2d(at, keys_[mesh_.destination(side).value], apex) <= 0) {
            return false;
        }
    }
    return true;
}

FaceId Tracer::canonical_host(FaceId a, FaceId b) const {
    // The shore of level water at a level would else be above it here and below it there, by a rounding.
    if (surface_.is_facet(a) != surface_.is_facet(b)) {
        return surface_.is_facet(a) ? a : b;
    }
    const auto corners = [this](FaceId f) {
        std::array<VertexId, 3> v = tin_.mesh.face(f).vertex;
        std::sort(v.begin(), v.end());
        return v;
    };
    return a == b || corners(a) < corners(b) ? a : b;
}

void Tracer::split(HalfEdgeId h) {
    const FaceId f = face_of(h);
    const FaceId g = face_of(mesh_.twin(h));
    const Key2 at = middle(keys_[mesh_.origin(h).value], keys_[mesh_.destination(h).value]);
    const FaceId host_f = hosts_[f.value];
    const FaceId host_g = hosts_[g.value];
    const auto slots = static_cast<std::uint32_t>(mesh_.slot_count());
    split_edge(mesh_, h);  // makes two new slots: first the other half of f
    hosts_.insert(hosts_.end(), {host_f, host_g});
    keys_.push_back(at);
    z_.push_back(0);
    vertex_hosts_.push_back(mesh_.is_terrain(g) ? canonical_host(host_f, host_g) : host_f);
    halves_.insert(halves_.end(), {f, FaceId{slots}});
    if (mesh_.is_terrain(g)) {
        halves_.insert(halves_.end(), {g, FaceId{slots + 1}});
    }
}

/// Halves a face, and whatever must be halved before; false if it is too small for it.
bool Tracer::halve(FaceId f) {
    const std::array<VertexId, 3> corners = mesh_.face(f).vertex;
    while (mesh_.face(f).vertex == corners) {
        // From face to face over ever longer edges, to one that is the longest of both its faces.
        HalfEdgeId h = longest_edge(f);
        for (;;) {
            const FaceId behind = face_of(mesh_.twin(h));
            if (!mesh_.is_terrain(behind)) {
                break;
            }
            const HalfEdgeId longer = longest_edge(behind);
            if (longer == mesh_.twin(h)) {
                break;
            }
            h = longer;
        }
        if (!can_split(h, middle(keys_[mesh_.origin(h).value], keys_[mesh_.destination(h).value]))) {
            return false;
        }
        split(h);
        if (keys_.size() - tin_.vertex_count() > kVertexLimit) {
            throw UsageError("lines within " + decimal_text(tolerance_) +
                             " of the surface need more than 50 million points: choose a larger --tolerance");
        }
    }
    return true;
}

void Tracer::read_new_vertices(std::size_t first) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(first, keys_.size(), kGrain), [&](const auto& part) {
        SurfaceReader& reader = *readers_.local();
        for (std::size_t v = part.begin(); v < part.end(); ++v) {
            z_[v] = read(reader, vertex_hosts_[v - tin_.vertex_count()], keys_[v]);
        }
    });
}

/// New vertices came in the order of the work; lines are to be in an order of their own.
void Tracer::number_by_position() {
    std::vector<std::uint32_t> order(keys_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(tin_.vertex_count()), order.end(),
              [this](std::uint32_t a, std::uint32_t b) { return precedes(keys_[a], keys_[b]); });
    std::vector<VertexId> new_ids(order.size());
    std::vector<Key2> keys(order.size());
    std::vector<double> z(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        new_ids[order[i]] = {i};
        keys[i] = keys_[order[i]];
        z[i] = z_[order[i]];
    }
    renumber_vertices(mesh_, new_ids);
    keys_ = std::move(keys);
    z_ = std::move(z);
}

TracedSurface Tracer::trace(const Progress& progress) {
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
        if (mesh_.is_terrain({f})) {
            faces.push_back({f});
        }
    }
    TracedSurface traced;
    std::vector<Verdict> verdicts;
    for (int round = 0; !faces.empty(); ++round) {
        report_progress(progress, 1 - std::pow(0.8, round));
        check_faces(faces, verdicts);
        halves_.clear();
        const std::size_t first = keys_.size();
        // A face that was halved for another one's sake is checked anew before it is halved again.
        std::vector<std::array<VertexId, 3>> corners;
        corners.reserve(faces.size());
        for (const FaceId f : faces) {
            corners.push_back(mesh_.face(f).vertex);
        }
        for (std::size_t i = 0; i < faces.size(); ++i) {
            if (verdicts[i] == Verdict::Coarse && mesh_.face(faces[i]).vertex == corners[i] &&
                !halve(faces[i])) {
                ++traced.unresolved;
            }
        }
        read_new_vertices(first);
        std::sort(halves_.begin(), halves_.end());
        halves_.erase(std::unique(halves_.begin(), halves_.end()), halves_.end());
        faces = halves_;
    }
    for (std::uint32_t f = 0; f < errors_.size(); ++f) {
        if (mesh_.is_terrain({f})) {
            traced.largest_error = std::max(traced.largest_error, errors_[f]);
        }
    }
    number_by_position();
    traced.vertices.reserve(keys_.size());
    for (std::size_t v = 0; v < keys_.size(); ++v) {
        const Point2 p = lattice_.position(keys_[v]);
        traced.vertices.push_back({p.x, p.y, z_[v]});
    }
    traced.mesh = std::move(mesh_);
    report_progress(progress, 1);
    return traced;
}

}  // namespace

TracedSurface trace_surface(const Tin& tin, const Interpolator& surface, std::span<const double> levels,
                            double tolerance, const Progress& progress) {
    if (!(std::isfinite(tolerance) && tolerance > 0)) {
        throw UsageError("the tolerance of contours must be above zero, not " + decimal_text(tolerance));
    }
    return Tracer(tin, surface, levels, tolerance).trace(progress);
}

}  // namespace tinwright
