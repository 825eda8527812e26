#include "tinwright/mesh/border.hpp"

#include <array>
#include <cstddef>

#include <tbb/parallel_for.h>

namespace tinwright {

std::vector<HalfEdgeId> find_border(const TriangleMesh& mesh) {
    constexpr std::size_t kChunks = 64;
    std::array<std::vector<HalfEdgeId>, kChunks> found;
    tbb::parallel_for(std::size_t{0}, kChunks, [&](std::size_t chunk) {
        const std::size_t end = mesh.slot_count() * (chunk + 1) / kChunks;
        for (std::size_t i = mesh.slot_count() * chunk / kChunks; i < end; ++i) {
            const FaceId f{static_cast<std::uint32_t>(i)};
            if (mesh.is_terrain(f)) {
                continue;
            }
            for (const HalfEdgeId twin : mesh.face(f).twin) {
                if (mesh.is_terrain(face_of(twin))) {
                    found[chunk].push_back(twin);
                }
            }
        }
    });
    std::vector<HalfEdgeId> border;
    for (const std::vector<HalfEdgeId>& part : found) {
        border.insert(border.end(), part.begin(), part.end());
    }
    return border;
}

}  // namespace tinwright
