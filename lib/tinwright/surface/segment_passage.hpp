#ifndef TINWRIGHT_SURFACE_SEGMENT_PASSAGE_HPP
#define TINWRIGHT_SURFACE_SEGMENT_PASSAGE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tinwright/surface/face_tree.hpp"

/// Private to profiles: the faces that one segment passes.
namespace tinwright {

/// Where a segment comes upon or leaves a face.
struct PassageMark {
    enum class Kind : std::uint8_t { Start, Vertex, Edge, End };
    Kind kind = Kind::Start;
    Key2 p{};  ///< the vertex; of an edge the end to the left of the segment
    Key2 q{};  ///< of an edge the end to the right
};

/// The marks along a segment in order, the start first and the end last; between two of them, face or none.
struct SegmentPassage {
    std::vector<PassageMark> marks;
    std::vector<std::optional<FaceId>> touched;  ///< one a mark: the face of smallest id that is there
    std::vector<std::optional<FaceId>> covers;   ///< from each mark to the next, likewise
};

/// The passage from a to b, which differ and are near (`QueryLattice::is_near`). Order and incidence are
/// exact. Faces may even overlap. O(log n + k log k) for k faces met.
SegmentPassage find_passage(const FaceTree& faces, Key2 a, Key2 b);

}  // namespace tinwright

#endif
