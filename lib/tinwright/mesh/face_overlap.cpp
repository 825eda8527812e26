#include "tinwright/mesh/face_overlap.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/predicates.hpp"
#include "tinwright/mesh/box_tree.hpp"

namespace tinwright {
namespace {

using Triangle = std::array<Key2, 3>;

bool lies_right_of_an_edge(const Triangle& face, const Triangle& edges) {
    for (unsigned i = 0; i < 3; ++i) {
        const Key2 a = edges[i];
        const Key2 b = edges[(i + 1) % 3];
        if (orient2d(a, b, face[0]) <= 0 && orient2d(a, b, face[1]) <= 0 && orient2d(a, b, face[2]) <= 0) {
            return true;
        }
    }
    return false;
}

/// Two convex polygons have disjoint interiors exactly if the line of one of their edges separates them.
bool do_interiors_meet(const Triangle& a, const Triangle& b) {
    return !lies_right_of_an_edge(b, a) && !lies_right_of_an_edge(a, b);
}

bool is_right_of_an_edge(const KeyBox& box, const Triangle& face) {
    return side_of_line(face[0], face[1], box) < 0 || side_of_line(face[1], face[2], box) < 0 ||
           side_of_line(face[2], face[0], box) < 0;
}

double half_perimeter(const KeyBox& box) { return (box.high.x - box.low.x) + (box.high.y - box.low.y); }

}  // namespace

std::vector<std::uint32_t> find_overlaps(std::span<const Key2> keys, std::span<const FaceCorners> faces) {
    const auto triangle = [&](std::size_t f) {
        return Triangle{keys[faces[f][0]], keys[faces[f][1]], keys[faces[f][2]]};
    };
    std::vector<KeyBox> boxes(faces.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        boxes[f] = KeyBox::of(triangle(f));
    }
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> found(faces.size(), kNoFaceFound);
    const auto look_from = [&](std::uint32_t f) {
        const Triangle here = triangle(f);
        const KeyBox& box = boxes[f];
        tree.visit_meeting(
            box,
            // Only boxes smaller than the face's are worth comparing with its edges.
            [&](const KeyBox& node) {
                return half_perimeter(node) < half_perimeter(box) && is_right_of_an_edge(node, here);
            },
            [&](std::uint32_t other) {
                if (other < f && do_interiors_meet(here, triangle(other))) {
                    found[f] = other;
                }
                return found[f] == kNoFaceFound;
            });
    };
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              look_from(tree.order()[i]);
                          }
                      });
    return found;
}

}  // namespace tinwright
