#ifndef TINWRIGHT_IO_TIN_TRIANGLES_HPP
#define TINWRIGHT_IO_TIN_TRIANGLES_HPP

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"

class OGRGeometry;

/// Private to the TIN reader: triangles out of OGR's geometries, and their shared vertices.
namespace tinwright::io {

using Triangle = std::array<Point3, 3>;

/// Appends the triangles of a geometry: a closed 3-D ring of three corners, or any collection of them (TIN,
/// PolyhedralSurface, MultiPolygon). Returns why not, half a sentence, when it is something else; then
/// `triangles` holds what came before.
std::optional<std::string> append_triangles(const OGRGeometry* geometry, std::vector<Triangle>& triangles);

/// Distinct points, numbered in order of arrival. Equal means equal in x, y and z; negative zero is zero.
class VertexTable {
  public:
    VertexTable();
    /// The number of a point, a new one if it was not there. Amortised O(1).
    std::uint32_t insert(Point3 point);
    [[nodiscard]] std::optional<std::uint32_t> find(Point3 point) const;
    [[nodiscard]] const std::vector<Point3>& points() const { return points_; }
    /// Gives the points away and leaves the table empty.
    std::vector<Point3> take();

  private:
    [[nodiscard]] std::size_t slot_of(const Point3& point) const;
    void grow();

    std::vector<Point3> points_;
    std::vector<std::uint32_t> slots_;  // a power of two, kFree or an index
};

}  // namespace tinwright::io

#endif
