#include "tinwright/mesh/tin_check.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/face_overlap.hpp"

namespace tinwright {
namespace {

class TinAudit {
  public:
    TinAudit(const Tin& tin, const TinCheckOptions& options)
        : tin_(tin), mesh_(tin.mesh), options_(options) {}

    TinCheckReport check_every_tin() {
        if (check_sizes()) {
            check_keys();
            check_elevations();
            check_orientation();
            // A convex border lets G6 follow from G5; overlaps are looked for where it does not.
            if (report_.count != 0 || find_border_defect().text != nullptr) {
                check_overlaps();
            }
        }
        return std::move(report_);
    }

    TinCheckReport check_delaunay_tin() {
        if (check_sizes()) {
            check_keys();
            check_elevations();
            check_orientation();
            check_hull();
            check_every_vertex_used();
            check_circles();
        }
        return std::move(report_);
    }

  private:
    template <class MakeText>
    void report(int invariant, bool is_face, std::size_t index, VertexId where, const MakeText& make_text) {
        ++report_.count;
        if (report_.violations.size() < options_.limit) {
            const Point2 location =
                where.value < tin_.keys.size() ? tin_.lattice.position(tin_.key(where)) : Point2{};
            report_.violations.push_back({invariant, is_face, index, location, make_text()});
        }
    }
    template <class MakeText>
    void report_vertex(int invariant, std::size_t v, const MakeText& make_text) {
        report(invariant, false, v, {static_cast<std::uint32_t>(v)}, make_text);
    }
    template <class MakeText>
    void report_face(int invariant, FaceId f, const MakeText& make_text) {
        report(invariant, true, f.value, mesh_.vertex(f, 0), make_text);
    }

    bool check_sizes() {
        const std::size_t n = mesh_.vertex_count();
        if (tin_.keys.size() == n && tin_.z.size() == n && tin_.sample.size() == n) {
            return true;
        }
        report(1, false, 0, kGhostVertex, [&] {
            return "the mesh has " + std::to_string(n) + " vertices, but there are " +
                   std::to_string(tin_.keys.size()) + " keys, " + std::to_string(tin_.z.size()) +
                   " elevations and " + std::to_string(tin_.sample.size()) + " sample numbers";
        });
        return false;
    }

    void check_keys() {
        const auto is_key = [](double c) { return c >= 0 && c < kKeyLimit && std::floor(c) == c; };
        for (std::size_t v = 0; v < tin_.keys.size(); ++v) {
            if (!is_key(tin_.keys[v].x) || !is_key(tin_.keys[v].y)) {
                report_vertex(2, v, [&] {
                    return "vertex " + std::to_string(v) +
                           ": its key is no pair of integers within the limit";
                });
            } else if (v > 0 && !precedes_on_curve(tin_.keys[v - 1], tin_.keys[v])) {
                report_vertex(3, v, [&] {
                    return "vertex " + std::to_string(v) +
                           (tin_.keys[v - 1] == tin_.keys[v] ? " is where the vertex before it is"
                                                             : " comes before its predecessor on the curve");
                });
            }
        }
    }

    void check_elevations() {
        for (std::size_t v = 0; v < tin_.z.size(); ++v) {
            if (!std::isfinite(tin_.z[v])) {
                report_vertex(
                    4, v, [&] { return "vertex " + std::to_string(v) + ": its elevation is not finite"; });
            }
        }
    }

    [[nodiscard]] Key2 corner(FaceId f, unsigned i) const { return tin_.key(mesh_.vertex(f, i)); }

    void check_orientation() {
        for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
            if (!mesh_.is_ghost({f}) && orient2d(corner({f}, 0), corner({f}, 1), corner({f}, 2)) <= 0) {
                report_face(5, {f},
                            [&] { return "face " + std::to_string(f) + " is not counter-clockwise"; });
            }
        }
    }

    void check_overlaps() {
        std::vector<FaceCorners> faces;
        std::vector<std::uint32_t> slot;
        for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
            if (!mesh_.is_ghost({f}) && orient2d(corner({f}, 0), corner({f}, 1), corner({f}, 2)) > 0) {
                const auto& v = mesh_.face({f}).vertex;
                faces.push_back({v[0].value, v[1].value, v[2].value});
                slot.push_back(f);
            }
        }
        const std::vector<std::uint32_t> found = find_overlaps(tin_.keys, faces);
        for (std::size_t i = 0; i < found.size(); ++i) {
            if (found[i] != kNoFaceFound) {
                report_face(6, {slot[i]}, [&] {
                    return "face " + std::to_string(slot[i]) + " overlaps face " +
                           std::to_string(slot[found[i]]);
                });
            }
        }
    }

    struct BorderDefect {
        FaceId ghost{0};
        const char* text = nullptr;  // null: the border is one convex loop that turns once
    };

    /// Follows the ghosts clockwise around the border; corner 0 to corner 1 of a ghost runs clockwise too.
    [[nodiscard]] BorderDefect find_border_defect() const {
        std::size_t ghosts = 0;
        FaceId first{0};
        for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
            if (mesh_.is_ghost({f})) {
                first = {f};
                ++ghosts;
            }
        }
        if (ghosts == 0) {
            return {{0}, "there is no border"};  // nor a plane drawing: the mesh closes on itself
        }
        std::size_t met = 0;
        std::size_t lows = 0;  // vertices that precede both neighbours: as many as the border turns round
        FaceId ghost = first;
        do {
            const FaceId following = face_of(mesh_.twin(half_edge(ghost, 1)));
            const Key2 a = corner(ghost, 0);
            const Key2 b = corner(ghost, 1);
            const Key2 c = corner(following, 1);
            if (!(corner(following, 0) == b) || orient2d(a, b, c) > 0) {
                return {ghost, "the border is not convex"};
            }
            if (orient2d(a, b, c) == 0 && precedes(a, b) != precedes(b, c)) {
                return {ghost, "the border turns back"};
            }
            lows += precedes(b, a) && precedes(b, c) ? 1 : 0;
            ghost = following;
            ++met;
        } while (ghost != first && met <= ghosts);
        if (met != ghosts || ghost != first) {
            return {first, "the border is more than one loop"};
        }
        return {first, lows == 1 ? nullptr : "the border turns more than once"};
    }

    void check_hull() {
        const BorderDefect defect = find_border_defect();
        if (mesh_.slot_count() == 0) {
            report(7, false, 0, kGhostVertex, [] { return "there is no face"; });
        } else if (defect.text != nullptr) {
            report_face(7, defect.ghost, [&] { return std::string(defect.text); });
        }
    }

    void check_every_vertex_used() {
        std::vector<bool> is_used(mesh_.vertex_count(), false);
        for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
            for (const VertexId v : mesh_.face({f}).vertex) {
                if (v != kGhostVertex) {
                    is_used[v.value] = true;
                }
            }
        }
        for (std::size_t v = 0; v < is_used.size(); ++v) {
            if (!is_used[v]) {
                report_vertex(8, v,
                              [&] { return "vertex " + std::to_string(v) + " is a corner of no face"; });
            }
        }
    }

    void check_circles() {
        for (std::uint32_t f = 0; f < mesh_.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && !mesh_.is_ghost({f}); ++i) {
                const HalfEdgeId across = mesh_.twin(half_edge({f}, i));
                const VertexId apex = mesh_.origin(previous(across));
                // One of two neighbours is enough: being inside the other's circle is mutual.
                if (face_of(across).value < f || apex == kGhostVertex) {
                    continue;
                }
                if (incircle_perturbed(corner({f}, 0), corner({f}, 1), corner({f}, 2), tin_.key(apex)) >= 0) {
                    report_face(9, {f}, [&] {
                        return "vertex " + std::to_string(apex.value) + " lies in the circle of face " +
                               std::to_string(f);
                    });
                }
            }
        }
    }

    const Tin& tin_;
    const TriangleMesh& mesh_;
    const TinCheckOptions& options_;
    TinCheckReport report_;
};

}  // namespace

TinCheckReport check_tin(const Tin& tin, const TinCheckOptions& options) {
    return TinAudit(tin, options).check_every_tin();
}

TinCheckReport check_delaunay(const Tin& tin, const TinCheckOptions& options) {
    return TinAudit(tin, options).check_delaunay_tin();
}

}  // namespace tinwright
