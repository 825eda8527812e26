#include "tinwright/water/bays.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

#include "tinwright/geometry/constructions.hpp"

namespace tinwright {

namespace {

double distance(Point2 a, Point2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Takes the faces off, always that of which the branch behind it is shortest among those with one neighbour
// left, until only faces between islands are left, or one: the one in the middle.
class BranchStripper {
  public:
    explicit BranchStripper(const WaterMesh& water)
        : water_(water),
          neighbors_(water.mesh.slot_count(), 0),
          exit_(water.mesh.slot_count(), kNone),
          depth_(water.mesh.slot_count(), 0) {}

    std::vector<bool> find() {
        strip();
        const TriangleMesh& mesh = water_.mesh;
        std::vector<bool> is_open(mesh.slot_count(), false);
        for (FaceId f{0}; f.value < mesh.slot_count(); ++f.value) {
            is_open[f.value] = mesh.is_terrain(f) && exit_[f.value] == kNone;
        }
        // Faces nearer to the middle come first.
        for (auto f = stripped_.rbegin(); f != stripped_.rend(); ++f) {
            is_open[f->value] = is_open[face_before(*f).value] && !is_bay(*f);
        }
        return is_open;
    }

  private:
    static constexpr HalfEdgeId kNone{0xFFFFFFFFU};
    using Entry = std::pair<double, std::uint32_t>;  // depth, face

    [[nodiscard]] bool is_inner(HalfEdgeId h) const { return !water_.mesh.is_constrained(h); }
    [[nodiscard]] FaceId face_before(FaceId f) const { return face_of(water_.mesh.twin(exit_[f.value])); }

    [[nodiscard]] unsigned count_inner(FaceId f) const {
        unsigned count = 0;
        for (unsigned corner = 0; corner < 3; ++corner) {
            count += is_inner(half_edge(f, corner)) ? 1U : 0U;
        }
        return count;
    }

    void strip() {
        const TriangleMesh& mesh = water_.mesh;
        for (FaceId f{0}; f.value < mesh.slot_count(); ++f.value) {
            if (mesh.is_terrain(f)) {
                neighbors_[f.value] = static_cast<std::uint8_t>(count_inner(f));
                if (neighbors_[f.value] == 1) {
                    find_exit(f);
                }
            }
        }
        while (!queue_.empty()) {
            const FaceId f{queue_.top().second};
            queue_.pop();
            if (neighbors_[f.value] == 0) {
                exit_[f.value] = kNone;
                continue;
            }
            stripped_.push_back(f);
            neighbors_[f.value] = 0;
            const FaceId before = face_before(f);
            if (--neighbors_[before.value] == 1) {
                find_exit(before);
            }
        }
    }

    // Of a face with one neighbour left.
    void find_exit(FaceId f) {
        const TriangleMesh& mesh = water_.mesh;
        for (unsigned corner = 0; corner < 3; ++corner) {
            const HalfEdgeId h = half_edge(f, corner);
            if (is_inner(h) && !is_stripped_through(mesh.twin(h))) {
                exit_[f.value] = h;
            }
        }
        const HalfEdgeId exit = exit_[f.value];
        const Point2 from = water_.middle(exit);
        double depth = 0;
        for (const HalfEdgeId h : {next(exit), previous(exit)}) {
            if (is_inner(h)) {
                const FaceId behind = face_of(mesh.twin(h));
                depth = std::max(depth, distance(from, water_.middle(h)) + depth_[behind.value]);
            }
        }
        if (depth == 0) {  // the end of a branch
            const Key2 tip = water_.key(mesh.origin(previous(exit)));
            depth = distance(from, {tip.x, tip.y});
        }
        depth_[f.value] = depth;
        queue_.push({depth, f.value});
    }

    // Whether the face that the half-edge belongs to has been taken off, and hung on to the rest by it.
    [[nodiscard]] bool is_stripped_through(HalfEdgeId h) const {
        const FaceId f = face_of(h);
        return neighbors_[f.value] == 0 && exit_[f.value] == h;
    }

    // Whether the branch that begins with the face, its exit known, is one.
    [[nodiscard]] bool is_bay(FaceId f) const {
        const HalfEdgeId mouth = exit_[f.value];
        const FaceId before = face_before(f);
        if (count_inner(before) < 3) {
            return false;
        }
        const auto& corner = water_.mesh.face(before).vertex;
        const double width = water_.length(mouth);
        const double height =
            doubled_area(water_.key(corner[0]), water_.key(corner[1]), water_.key(corner[2])) / width;
        return depth_[f.value] < std::max(width, height / 2);
    }

    const WaterMesh& water_;
    std::vector<std::uint8_t> neighbors_;  // of each face, not taken off
    std::vector<HalfEdgeId> exit_;         // towards the middle
    std::vector<double> depth_;            // from the exit to the far end of what lies behind
    std::vector<FaceId> stripped_;         // in this order
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<bool> find_open_water(const WaterMesh& water) { return BranchStripper(water).find(); }

}  // namespace tinwright
