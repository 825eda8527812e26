#include "tinwright/mesh/face_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"
#include "tinwright/mesh/face_overlap.hpp"

namespace tinwright {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

bool is_finite(const Point3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// A face's use of an edge, `low` and `high` being the edge's locations in increasing order.
struct EdgeUse {
    std::uint32_t low;
    std::uint32_t high;
    bool is_backward;  // the face runs from high to low
    std::uint32_t face;

    [[nodiscard]] bool has_same_edge(const EdgeUse& other) const {
        return low == other.low && high == other.high;
    }
    // NOLINTNEXTLINE(readability-implicit-bool-conversion): bool is compared as what it is
    friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

class FaceAudit {
  public:
    FaceAudit(std::span<const Point3> vertices, std::span<const std::uint32_t> corners,
              const FaceCheckOptions& options)
        : vertices_(vertices),
          corners_(corners),
          options_(options),
          number_(corners.size() / 3),
          faces_(corners.size() / 3) {}

    FaceCheckReport run() {
        check_finite();
        make_locations();
        check_cracks();
        check_areas();
        check_repeated();
        const std::vector<EdgeUse> open = check_shared_edges();
        check_vertices_on_edges(open);
        check_overlaps();
        return std::move(report_);
    }

  private:
    void check_finite();
    void make_locations();
    void check_cracks();
    void check_areas();
    void check_repeated();
    std::vector<EdgeUse> check_shared_edges();
    void check_vertices_on_edges(const std::vector<EdgeUse>& open);
    void check_overlaps();

    /// The next tests look at the faces of `faces_` that remain.
    void drop_faces(const std::vector<bool>& is_bad) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            if (!is_bad[i]) {
                faces_[kept] = faces_[i];
                number_[kept++] = number_[i];
            }
        }
        faces_.resize(kept);
        number_.resize(kept);
    }

    void report(std::vector<FaceViolation> found, FaceDefect defect) {
        std::sort(found.begin(), found.end(), [](const FaceViolation& a, const FaceViolation& b) {
            return std::tie(a.face, a.other, a.location.x, a.location.y) <
                   std::tie(b.face, b.other, b.location.x, b.location.y);
        });
        report_.counts[static_cast<std::size_t>(defect)] = found.size();
        found.resize(std::min(found.size(), options_.limit));
        report_.violations.insert(report_.violations.end(), found.begin(), found.end());
    }
    [[nodiscard]] FaceViolation violation(FaceDefect defect, std::size_t i, Point3 location) const {
        return {defect, number_[i], FaceViolation::kNoFace, location, 0};
    }
    [[nodiscard]] Point3 first_corner(std::size_t face) const { return vertices_[corners_[3 * face]]; }
    [[nodiscard]] Point3 position(std::uint32_t location) const { return vertices_[vertex_at_[location]]; }

    std::span<const Point3> vertices_;
    std::span<const std::uint32_t> corners_;
    const FaceCheckOptions& options_;
    FaceCheckReport report_;

    std::vector<std::uint32_t> number_;     // of the faces still looked at: number in the file
    std::vector<FaceCorners> faces_;        // their corners: vertices, then locations
    std::vector<std::uint32_t> location_;   // of each vertex: number of its key in curve order
    std::vector<Key2> keys_;                // of each location
    std::vector<std::uint32_t> vertex_at_;  // of each location: its first vertex
};

void FaceAudit::check_finite() {
    std::vector<FaceViolation> found;
    std::vector<bool> is_bad(faces_.size(), false);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        number_[f] = f;
        std::copy_n(&corners_[3 * std::size_t{f}], 3, faces_[f].begin());
        if (!std::all_of(faces_[f].begin(), faces_[f].end(),
                         [&](std::uint32_t v) { return is_finite(vertices_[v]); })) {
            is_bad[f] = true;
            found.push_back(violation(FaceDefect::NotFinite, f, first_corner(f)));
        }
    }
    drop_faces(is_bad);
    report(std::move(found), FaceDefect::NotFinite);
}

/// Numbers the distinct keys of the remaining faces' vertices and turns `faces_` into locations.
void FaceAudit::make_locations() {
    std::vector<bool> is_used(vertices_.size(), false);
    for (const FaceCorners& face : faces_) {
        for (const std::uint32_t v : face) {
            is_used[v] = true;
        }
    }
    std::vector<std::uint32_t> used;
    std::vector<Point3> positions;
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
        if (is_used[v]) {
            used.push_back(v);
            positions.push_back(vertices_[v]);
        }
    }
    if (used.empty()) {
        return;
    }
    const Lattice lattice = find_lattice(positions).lattice;
    std::vector<Key2> keys(used.size());
    tbb::parallel_for(std::size_t{0}, used.size(), [&](std::size_t i) {
        keys[i] = lattice.key({positions[i].x, positions[i].y});
    });
    location_.assign(vertices_.size(), kNone);
    for (const std::uint32_t i : sort_along_curve(keys)) {
        if (keys_.empty() || !(keys_.back() == keys[i])) {
            keys_.push_back(keys[i]);
            vertex_at_.push_back(used[i]);
        }
        location_[used[i]] = static_cast<std::uint32_t>(keys_.size() - 1);
    }
}

void FaceAudit::check_cracks() {
    // For each location the first corner met there, and the first one met that has another elevation.
    struct Corner {
        std::uint32_t face = kNone;
        std::uint32_t vertex = kNone;
    };
    std::vector<Corner> first(keys_.size());
    std::vector<bool> is_cracked(keys_.size(), false);
    std::vector<FaceViolation> found;
    for (std::uint32_t i = 0; i < faces_.size(); ++i) {
        for (std::uint32_t& v : faces_[i]) {
            const std::uint32_t location = location_[v];
            Corner& known = first[location];
            if (known.face == kNone) {
                known = {i, v};
            } else if (vertices_[v].z != vertices_[known.vertex].z && !is_cracked[location]) {
                is_cracked[location] = true;
                found.push_back({FaceDefect::Crack, number_[i], number_[known.face], vertices_[v],
                                 vertices_[known.vertex].z});
            }
            v = location;
        }
    }
    report(std::move(found), FaceDefect::Crack);
}

void FaceAudit::check_areas() {
    std::vector<FaceViolation> flat;
    std::vector<FaceViolation> clockwise;
    std::vector<bool> is_flat(faces_.size(), false);
    std::vector<signed char> turn(faces_.size());
    tbb::parallel_for(std::size_t{0}, faces_.size(), [&](std::size_t i) {
        const FaceCorners& c = faces_[i];
        turn[i] = static_cast<signed char>(orient2d(keys_[c[0]], keys_[c[1]], keys_[c[2]]));
    });
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        is_flat[i] = turn[i] == 0;
        if (turn[i] == 0) {
            flat.push_back(violation(FaceDefect::ZeroArea, i, first_corner(number_[i])));
        } else if (turn[i] < 0) {
            clockwise.push_back(violation(FaceDefect::Clockwise, i, first_corner(number_[i])));
            std::swap(faces_[i][1], faces_[i][2]);
        }
    }
    drop_faces(is_flat);
    report(std::move(flat), FaceDefect::ZeroArea);
    report(std::move(clockwise), FaceDefect::Clockwise);
}

void FaceAudit::check_repeated() {
    struct Entry {
        FaceCorners corners;
        std::uint32_t i;
    };
    std::vector<Entry> entries(faces_.size());
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(faces_.size()), [&](std::uint32_t i) {
        entries[i] = {faces_[i], i};
        std::sort(entries[i].corners.begin(), entries[i].corners.end());
    });
    tbb::parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.i < b.i;
    });
    std::vector<bool> is_repeated(faces_.size(), false);
    std::vector<FaceViolation> found;
    for (std::size_t e = 1, original = 0; e < entries.size(); ++e) {
        if (entries[e].corners != entries[original].corners) {
            original = e;
            continue;
        }
        const std::uint32_t i = entries[e].i;
        is_repeated[i] = true;
        found.push_back(violation(FaceDefect::Repeated, i, first_corner(number_[i])));
        found.back().other = number_[entries[original].i];
    }
    drop_faces(is_repeated);
    report(std::move(found), FaceDefect::Repeated);
}

/// Returns the edges that have faces on one side only.
std::vector<EdgeUse> FaceAudit::check_shared_edges() {
    std::vector<EdgeUse> uses(3 * faces_.size());
    tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(faces_.size()), [&](std::uint32_t i) {
        for (unsigned k = 0; k < 3; ++k) {
            const std::uint32_t a = faces_[i][k];
            const std::uint32_t b = faces_[i][(k + 1) % 3];
            uses[3 * std::size_t{i} + k] = {std::min(a, b), std::max(a, b), a > b, i};
        }
    });
    tbb::parallel_sort(uses.begin(), uses.end());
    std::vector<FaceViolation> found;
    std::vector<EdgeUse> open;
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
        const EdgeUse& first = uses[begin];
        for (end = begin + 1; end < uses.size() && uses[end].has_same_edge(first); ++end) {
        }
        if (uses[end - 1].is_backward == first.is_backward) {
            open.push_back(first);
        }
        std::size_t first_on_side = begin;
        for (std::size_t u = begin + 1; u < end; ++u) {
            if (uses[u].is_backward != uses[first_on_side].is_backward) {
                first_on_side = u;
                continue;
            }
            const Point3 a = position(first.low);
            const Point3 b = position(first.high);
            const Point3 middle{a.x + 0.5 * (b.x - a.x), a.y + 0.5 * (b.y - a.y), a.z + 0.5 * (b.z - a.z)};
            found.push_back(violation(FaceDefect::SharedEdge, uses[u].face, middle));
            found.back().other = number_[uses[first_on_side].face];
        }
    }
    report(std::move(found), FaceDefect::SharedEdge);
    return open;
}

void FaceAudit::check_vertices_on_edges(const std::vector<EdgeUse>& open) {
    // A vertex inside an edge that has faces on both sides lies under one of them: that is an overlap.
    std::vector<bool> is_end(keys_.size(), false);
    for (const EdgeUse& use : open) {
        is_end[use.low] = is_end[use.high] = true;
    }
    std::vector<std::uint32_t> ends;
    std::vector<KeyBox> boxes;
    for (std::uint32_t location = 0; location < keys_.size(); ++location) {
        if (is_end[location]) {
            ends.push_back(location);
            boxes.push_back({keys_[location], keys_[location]});
        }
    }
    const BoxTree tree(boxes);
    std::vector<FaceViolation> found;
    for (const EdgeUse& use : open) {
        const Key2 a = keys_[use.low];
        const Key2 b = keys_[use.high];
        tree.visit_meeting(
            KeyBox::of(std::array{a, b}), [&](const KeyBox& node) { return side_of_line(a, b, node) != 0; },
            [&](std::uint32_t end) {
                const std::uint32_t v = ends[end];
                if (v != use.low && v != use.high && orient2d(a, b, keys_[v]) == 0) {
                    found.push_back(violation(FaceDefect::VertexOnEdge, use.face, position(v)));
                }
                return true;
            });
    }
    report(std::move(found), FaceDefect::VertexOnEdge);
}

/// The middle of the corners that the common part of two counter-clockwise triangles has, about.
Point3 middle_of_overlap(const std::array<Point3, 3>& a, const std::array<Point3, 3>& b) {
    std::vector<Point3> part(a.begin(), a.end());
    for (unsigned i = 0; i < 3 && !part.empty(); ++i) {
        const Point3& p = b[i];
        const Point3& q = b[(i + 1) % 3];
        const auto height = [&](const Point3& r) {
            return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        };
        std::vector<Point3> rest;
        rest.reserve(part.size() + 1);
        for (std::size_t k = 0; k < part.size(); ++k) {
            const Point3& from = part[k];
            const Point3& to = part[(k + 1) % part.size()];
            const double h = height(from);
            const double g = height(to);
            if (h >= 0) {
                rest.push_back(from);
            }
            if ((h < 0) != (g < 0)) {
                const double t = h / (h - g);
                rest.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                                from.z + t * (to.z - from.z)});
            }
        }
        part = std::move(rest);
    }
    if (part.empty()) {
        return a[0];  // thinner than rounding
    }
    Point3 middle = part[0];
    for (const Point3& p : part) {
        const auto share = static_cast<double>(part.size());
        middle.x += (p.x - part[0].x) / share;
        middle.y += (p.y - part[0].y) / share;
        middle.z += (p.z - part[0].z) / share;
    }
    return middle;
}

void FaceAudit::check_overlaps() {
    const std::vector<std::uint32_t> overlaps = find_overlaps(keys_, faces_);
    const auto triangle = [&](std::size_t i) {
        return std::array{position(faces_[i][0]), position(faces_[i][1]), position(faces_[i][2])};
    };
    const auto share_edge = [&](const FaceCorners& a, const FaceCorners& b) {
        const auto is_corner = [&](std::uint32_t v) { return std::count(b.begin(), b.end(), v); };
        return is_corner(a[0]) + is_corner(a[1]) + is_corner(a[2]) == 2;
    };
    std::vector<FaceViolation> found;
    for (std::size_t i = 0; i < overlaps.size(); ++i) {
        const std::uint32_t other = overlaps[i];
        if (other == kNoFaceFound || share_edge(faces_[i], faces_[other])) {
            continue;  // two faces that overlap and share an edge are listed as SharedEdge
        }
        found.push_back(violation(FaceDefect::Overlap, i, {}));
        found.back().other = number_[other];
        if (found.size() <= options_.limit) {
            found.back().location = middle_of_overlap(triangle(i), triangle(other));
        }
    }
    report(std::move(found), FaceDefect::Overlap);
}

}  // namespace

std::string_view text_of(FaceDefect defect) {
    switch (defect) {
        case FaceDefect::NotFinite:
            return "a coordinate is not a finite number";
        case FaceDefect::ZeroArea:
            return "no area";
        case FaceDefect::Clockwise:
            return "clockwise corners";
        case FaceDefect::Repeated:
            return "repeats another face";
        case FaceDefect::SharedEdge:
            return "an edge has two faces on one side";
        case FaceDefect::Crack:
            return "two elevations at one location";
        case FaceDefect::VertexOnEdge:
            return "a vertex lies on an edge";
        case FaceDefect::Overlap:
            return "overlaps another face";
    }
    return "";
}

FaceCheckReport check_faces(std::span<const Point3> vertices, std::span<const std::uint32_t> corners,
                            const FaceCheckOptions& options) {
    if (corners.size() % 3 != 0 || corners.size() / 3 >= kNone || vertices.size() >= kNone) {
        throw InputError("cannot audit " + std::to_string(corners.size()) + " corners of faces and " +
                         std::to_string(vertices.size()) + " vertices");
    }
    for (std::size_t c = 0; c < corners.size(); ++c) {
        if (corners[c] >= vertices.size()) {
            throw InputError("face " + std::to_string(c / 3) + ": corner " + std::to_string(corners[c]) +
                             " is not one of the " + std::to_string(vertices.size()) + " vertices");
        }
    }
    return FaceAudit(vertices, corners, options).run();
}

}  // namespace tinwright
