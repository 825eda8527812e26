// Triangulates a square with a raised centre, using nothing but the installed core.
#include <cstdio>
#include <vector>

#include "tinwright/optimal/triangulate.hpp"

int main() {
    const std::vector<tinwright::Point3> samples{{0, 0, 1}, {10, 0, 1}, {10, 10, 1}, {0, 10, 1}, {5, 5, 3}};
    const tinwright::Triangulated result = tinwright::triangulate(samples);
    std::printf("%zu faces\n", result.report.faces);
    return result.report.faces == 4 ? 0 : 1;
}
