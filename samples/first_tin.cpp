// Five samples become a TIN of four faces: a small pyramid.
#include <exception>
#include <iostream>
#include <vector>

#include "tinwright/optimal/triangulate.hpp"

namespace {

void print_faces(const tinwright::Tin& tin) {
    for (std::uint32_t slot = 0; slot < tin.mesh.slot_count(); ++slot) {
        const tinwright::FaceId face{slot};
        // The mesh also has ghost faces around the hull; the terrain has not.
        if (!tin.mesh.is_terrain(face)) {
            continue;
        }
        std::cout << "face";
        for (const unsigned corner : {0U, 1U, 2U}) {
            const tinwright::Point3 p = tin.position(tin.mesh.vertex(face, corner));
            std::cout << "  (" << p.x << ", " << p.y << ", " << p.z << ')';
        }
        std::cout << '\n';
    }
}

}  // namespace

int main() {
    try {
        const std::vector<tinwright::Point3> samples{
            {0, 0, 100.0}, {10, 0, 100.2}, {10, 10, 100.4}, {0, 10, 100.1}, {5, 5, 103.5}};
        const tinwright::Triangulated result = tinwright::triangulate(samples);
        std::cout << result.report.faces << " faces, quantum " << result.tin.lattice.quantum() << '\n';
        print_faces(result.tin);
    } catch (const std::exception& error) {
        std::cerr << "first_tin: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
