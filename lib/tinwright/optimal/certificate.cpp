#include "tinwright/optimal/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/optimal/polygon_dp.hpp"

namespace tinwright {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A measure and a bound of its error, both in the criterion's own unit.
struct Measured {
    double value = 0;
    double error = 0;
};

template <FaceCriterion C>
Measured measure_with_error(const C& criterion, const Tin& /*tin*/, VertexId a, VertexId b, VertexId c) {
    const double value = criterion.measure(a, b, c);
    return {value, kTieMargin * std::abs(value)};
}

/// The gradient of a needle is a small difference of great products, which its slope does not show. Its error
/// is relative to the products of its lengths and rises, whichever corner they are taken from.
Measured measure_with_error(const SlopeCriterion& criterion, const Tin& tin, VertexId a, VertexId b,
                            VertexId c) {
    const Key2 origin = tin.key(a);
    const internal::LocalKey u = internal::localize(tin.key(b), origin);
    const internal::LocalKey v = internal::localize(tin.key(c), origin);
    const internal::LocalKey w = internal::localize(tin.key(c), tin.key(b));
    const double area = internal::doubled_area_of(origin, tin.key(b), tin.key(c), u, v);
    const double length = std::sqrt(std::max({u.square, v.square, w.square}));
    const auto [low, high] = std::minmax({tin.z[a.value], tin.z[b.value], tin.z[c.value]});
    const double slope_error = 32 * std::numeric_limits<double>::epsilon() * length * (high - low) / area;
    const double value = criterion.measure(a, b, c);
    return {value, kTieMargin * value + slope_error * (2 * std::sqrt(value) + slope_error)};
}

/// The ends of the edges crossed on one side of the view, the anchor before them, and what is known of the
/// polygons that they make.
class Chain {
  public:
    /// `mirror`: -1 for the chain to the left, which is turned over to be counter-clockwise.
    Chain(const Tin& tin, double mirror, const RingMeasure& measure)
        : tin_(tin), mirror_(mirror), table_(measure) {}

    [[nodiscard]] std::size_t size() const { return vertices_.size(); }
    [[nodiscard]] VertexId operator[](std::uint32_t i) const { return vertices_[i]; }
    void push_back(VertexId v) {
        const Key2 key = tin_.key(v);
        vertices_.push_back(v);
        table_.push_back({mirror_ * key.x, key.y});
    }
    void truncate(std::size_t size) {
        vertices_.resize(size);
        table_.truncate(size);
    }
    /// Whether the polygon between the chain and the line back from its end to its start can be filled.
    [[nodiscard]] bool can_be_filled(const Progress& progress) {
        return table_.cost(0, static_cast<std::uint32_t>(size() - 1), progress) < 0;
    }

  private:
    const Tin& tin_;
    double mirror_;
    std::vector<VertexId> vertices_;
    PolygonTable table_;
};

/// Looks from the anchor of a face through the opposite edge, and tries an edge to every vertex in sight.
/// Letters as in [tan1993, Fig. 3.1]: q anchor, s apex.
template <FaceCriterion C>
class Certifier {
  public:
    Certifier(const Tin& tin, const C& criterion, const CertificateOptions& options)
        : tin_(tin),
          criterion_(criterion),
          options_(options),
          reach_(options.reach.value_or(std::numeric_limits<std::size_t>::max())),
          rights_(tin, 1,
                  [this](auto i, auto k, auto j) {
                      return is_better(rights_[i], rights_[k], rights_[j]) ? -kInfinity : kInfinity;
                  }),
          lefts_(tin, -1, [this](auto i, auto k, auto j) {
              return is_better(lefts_[j], lefts_[k], lefts_[i]) ? -kInfinity : kInfinity;
          }) {}

    Certificate certify();

  private:
    /// An edge to be looked through, between two lines of sight.
    struct View {
        HalfEdgeId edge;      ///< of the nearer face
        VertexId right;       ///< the line of sight through it bounds the view, itself not included
        VertexId left;        ///< the other bound
        bool is_right_moved;  ///< whether `edge` has a new right end rather than a new left one
        std::size_t rights;   ///< how long the chains were before the new end
        std::size_t lefts;
    };

    void measure_faces();
    [[nodiscard]] std::vector<FaceId> worst_faces() const;
    void examine(FaceId face);
    bool look_from(FaceId face, unsigned corner);
    [[nodiscard]] bool is_open(HalfEdgeId h) const;
    void go_on(const View& view, VertexId q, VertexId s);
    [[nodiscard]] bool is_better(VertexId a, VertexId b, VertexId c) const;
    bool is_improved_by(VertexId s);
    [[nodiscard]] double fill(std::span<const VertexId> ring) const;
    [[nodiscard]] Improvement make_improvement(FaceId face, VertexId s) const;
    [[nodiscard]] int side(VertexId from, VertexId to, VertexId v) const {
        return orient2d(tin_.key(from), tin_.key(to), tin_.key(v));
    }
    bool poll();

    const Tin& tin_;
    const C& criterion_;
    const CertificateOptions& options_;
    std::size_t reach_;
    Certificate certificate_;
    std::vector<double> measure_;  ///< of each slot that is terrain
    double limit_ = 0;             ///< faces worse than this are obstacles
    double wanted_ = 0;            ///< what new faces have to stay below for certain
    double done_ = 0;              ///< fraction
    std::uint32_t steps_ = 0;
    Chain rights_;
    Chain lefts_;
    std::vector<View> views_;  // stack
    Progress poll_ = [this](double) { return poll(); };
};

template <FaceCriterion C>
Certificate Certifier<C>::certify() {
    measure_faces();
    const std::vector<FaceId> faces = worst_faces();
    for (const FaceId face : faces) {
        if (options_.until_improvable && !certificate_.improvements.empty()) {
            break;
        }
        done_ = static_cast<double>(certificate_.faces) / static_cast<double>(faces.size());
        report_progress(options_.progress, done_);
        examine(face);
        ++certificate_.faces;
    }
    report_progress(options_.progress, 1);
    return std::move(certificate_);
}

template <FaceCriterion C>
void Certifier<C>::measure_faces() {
    measure_.resize(tin_.mesh.slot_count());
    for (std::uint32_t f = 0; f < measure_.size(); ++f) {
        if (tin_.mesh.is_terrain({f})) {
            const auto& [a, b, c] = tin_.mesh.face({f}).vertex;
            measure_[f] = criterion_.measure(a, b, c);
        }
    }
}

template <FaceCriterion C>
std::vector<FaceId> Certifier<C>::worst_faces() const {
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < measure_.size(); ++f) {
        if (tin_.mesh.is_terrain({f})) {
            faces.push_back({f});
        }
    }
    const auto is_worse = [this](FaceId a, FaceId b) {
        const double x = measure_[a.value];
        const double y = measure_[b.value];
        return x > y || (x == y && a < b);
    };
    const std::size_t kept = std::min(options_.faces.value_or(faces.size()), faces.size());
    std::partial_sort(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(kept), faces.end(),
                      is_worse);
    faces.resize(kept);
    return faces;
}

template <FaceCriterion C>
void Certifier<C>::examine(FaceId face) {
    const auto& [a, b, c] = tin_.mesh.face(face).vertex;
    const unsigned anchors = criterion_.anchors(a, b, c);
    certificate_.anchorless += anchors == 0 ? 1U : 0U;
    const Measured measured = measure_with_error(criterion_, tin_, a, b, c);
    limit_ = measured.value;
    wanted_ = measured.value - measured.error;
    for (unsigned corner = 0; corner < 3; ++corner) {
        if ((anchors >> corner & 1U) != 0 && look_from(face, corner)) {
            return;
        }
    }
}

/// Whether the view reaches the face behind an edge.
template <FaceCriterion C>
bool Certifier<C>::is_open(HalfEdgeId h) const {
    const FaceId behind = face_of(tin_.mesh.twin(h));
    return !tin_.mesh.is_constrained(h) && tin_.mesh.is_terrain(behind) && measure_[behind.value] <= limit_;
}

/// Whether an edge was found that improves the face. A view is a wedge of lines of sight from q, open at its
/// sides, that all cross the same edges. The vertex behind its edge is in sight if it lies within; it divides
/// the view in two, or else all goes on through one of the two edges that it ends.
template <FaceCriterion C>
bool Certifier<C>::look_from(FaceId face, unsigned corner) {
    const HalfEdgeId opposite = half_edge(face, next_corner(corner));
    const VertexId q = tin_.mesh.vertex(face, corner);
    const VertexId right = tin_.mesh.origin(opposite);
    rights_.truncate(0);
    rights_.push_back(q);
    rights_.push_back(right);
    lefts_.truncate(0);
    lefts_.push_back(q);
    views_.assign(1, {opposite, right, tin_.mesh.destination(opposite), false, 2, 1});
    while (!views_.empty()) {
        report_progress(poll_, done_);
        const View view = views_.back();
        views_.pop_back();
        rights_.truncate(view.rights);
        lefts_.truncate(view.lefts);
        if (view.is_right_moved) {
            rights_.push_back(tin_.mesh.origin(view.edge));
        } else {
            lefts_.push_back(tin_.mesh.destination(view.edge));
        }
        if (!is_open(view.edge)) {
            continue;
        }
        // An edge crosses one face more than edges, which have one end more than there are of them.
        if (rights_.size() + lefts_.size() - 2 > reach_) {
            ++certificate_.cut;
            continue;
        }
        const VertexId s = tin_.mesh.origin(previous(tin_.mesh.twin(view.edge)));
        if (side(q, view.right, s) > 0 && side(q, view.left, s) < 0 && is_improved_by(s)) {
            certificate_.improvements.push_back(make_improvement(face, s));
            return true;
        }
        go_on(view, q, s);
    }
    return false;
}

template <FaceCriterion C>
void Certifier<C>::go_on(const View& view, VertexId q, VertexId s) {
    const HalfEdgeId behind = tin_.mesh.twin(view.edge);
    // Seen from behind, the edge runs from left to right, then on to s.
    const HalfEdgeId to_the_right = next(behind);
    const HalfEdgeId to_the_left = previous(behind);
    const bool is_past_right = side(q, view.right, s) > 0;
    const bool is_before_left = side(q, view.left, s) < 0;
    if (is_before_left) {
        views_.push_back(
            {to_the_left, is_past_right ? s : view.right, view.left, true, rights_.size(), lefts_.size()});
    }
    if (is_past_right) {
        views_.push_back(
            {to_the_right, view.right, is_before_left ? s : view.left, false, rights_.size(), lefts_.size()});
    }
}

/// Whether a new face is better than the one examined, for certain.
template <FaceCriterion C>
bool Certifier<C>::is_better(VertexId a, VertexId b, VertexId c) const {
    const Measured measured = measure_with_error(criterion_, tin_, a, b, c);
    return measured.value + measured.error < wanted_;
}

/// Whether both sides of the edge to `s` can be filled with better faces.
template <FaceCriterion C>
bool Certifier<C>::is_improved_by(VertexId s) {
    ++certificate_.edges;
    rights_.push_back(s);
    lefts_.push_back(s);
    const bool is_improved = rights_.can_be_filled(poll_) && lefts_.can_be_filled(poll_);
    rights_.truncate(rights_.size() - 1);
    lefts_.truncate(lefts_.size() - 1);
    return is_improved;
}

template <FaceCriterion C>
Improvement Certifier<C>::make_improvement(FaceId face, VertexId s) const {
    std::vector<VertexId> right;
    for (std::uint32_t i = 0; i < rights_.size(); ++i) {
        right.push_back(rights_[i]);
    }
    right.push_back(s);
    std::vector<VertexId> left{s};
    for (auto i = static_cast<std::uint32_t>(lefts_.size()); i-- > 0;) {
        left.push_back(lefts_[i]);
    }
    const double improved = std::max(fill(right), fill(left));
    return {face, rights_[0], s, criterion_.to_report(limit_), criterion_.to_report(improved)};
}

/// The least maximum of faces that are all better than the one examined; the ring is counter-clockwise.
template <FaceCriterion C>
double Certifier<C>::fill(std::span<const VertexId> ring) const {
    std::vector<Key2> keys;
    for (const VertexId v : ring) {
        keys.push_back(tin_.key(v));
    }
    const auto filled = triangulate_polygon(
        keys,
        [&](std::uint32_t i, std::uint32_t k, std::uint32_t j) {
            return is_better(ring[i], ring[k], ring[j]) ? criterion_.measure(ring[i], ring[k], ring[j])
                                                        : kInfinity;
        },
        PolygonCost::Maximum, poll_);
    return filled->cost;
}

/// Often enough to be stopped, seldom enough to cost nothing.
template <FaceCriterion C>
bool Certifier<C>::poll() {
    return (++steps_ & 0xFFFU) != 0 || !options_.progress || options_.progress(done_);
}

}  // namespace

Certificate certify(const Tin& tin, const CertificateOptions& options) {
    Certificate certificate = visit_criterion(options.criterion, tin, [&](const auto& criterion) {
        return Certifier(tin, criterion, options).certify();
    });
    certificate.worst = find_worst(tin, options.criterion);
    return certificate;
}

}  // namespace tinwright
