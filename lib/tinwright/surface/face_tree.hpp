#ifndef TINWRIGHT_SURFACE_FACE_TREE_HPP
#define TINWRIGHT_SURFACE_FACE_TREE_HPP

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "tinwright/mesh/box_tree.hpp"
#include "tinwright/mesh/tin.hpp"
#include "tinwright/surface/surface_place.hpp"

/// Private to those who look for faces.
namespace tinwright {

/// Faces of a TIN in a tree, all of its terrain or some, and the lattice of the places asked about.
class FaceTree {
  public:
    /// `tin` must outlive it. O(slots log slots).
    explicit FaceTree(const Tin& of) : FaceTree(of, terrain_faces(of)) {}
    FaceTree(const Tin& of, std::vector<FaceId> faces)
        : tin(of), lattice(of), faces_(std::move(faces)), tree_(boxes()) {}

    [[nodiscard]] bool is_empty() const { return faces_.empty(); }

    /// The corner of a face, in steps of the lattice.
    [[nodiscard]] Key2 corner(FaceId f, unsigned i) const {
        return lattice.scaled(tin.key(tin.mesh.vertex(f, i)));
    }
    [[nodiscard]] KeyBox box_of(FaceId f) const {
        return KeyBox::of(std::array{corner(f, 0), corner(f, 1), corner(f, 2)});
    }
    /// `BoxTree::visit_meeting`, in steps of the lattice, of faces.
    template <class IsApart, class Visit>
    void visit_meeting(const KeyBox& box, const IsApart& is_apart, const Visit& visit) const {
        // Boxes are kept in keys of the TIN; the scale is a power of two, so nothing rounds.
        const double scale = lattice.scale();
        const auto key_of = [scale](Key2 at) { return Key2{at.x / scale, at.y / scale}; };
        tree_.visit_meeting(
            {key_of(box.low), key_of(box.high)},
            [&](const KeyBox& node) {
                return is_apart(KeyBox{lattice.scaled(node.low), lattice.scaled(node.high)});
            },
            [&](std::uint32_t item) { return visit(faces_[item]); });
    }

    const Tin& tin;
    QueryLattice lattice;

  private:
    static std::vector<FaceId> terrain_faces(const Tin& tin) {
        std::vector<FaceId> faces;
        faces.reserve(tin.mesh.slot_count());
        for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
            if (tin.mesh.is_terrain({f})) {
                faces.push_back({f});
            }
        }
        return faces;
    }
    [[nodiscard]] std::vector<KeyBox> boxes() const {
        std::vector<KeyBox> boxes;
        boxes.reserve(faces_.size());
        for (const FaceId f : faces_) {
            const auto& v = tin.mesh.face(f).vertex;
            boxes.push_back(KeyBox::of(std::array{tin.key(v[0]), tin.key(v[1]), tin.key(v[2])}));
        }
        return boxes;
    }

    std::vector<FaceId> faces_;
    BoxTree tree_;
};

}  // namespace tinwright

#endif
