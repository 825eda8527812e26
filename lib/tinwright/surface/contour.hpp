#ifndef TINWRIGHT_SURFACE_CONTOUR_HPP
#define TINWRIGHT_SURFACE_CONTOUR_HPP

#include <cstddef>
#include <span>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/mesh/tin.hpp"

/// Contour lines, cut from the faces of a TIN.
namespace tinwright {

/// The contour lines of one level, CRS units.
struct LevelLines {
    std::vector<Point2> points;     ///< of one line after the other
    std::vector<std::size_t> ends;  ///< of each line: one past its last point

    [[nodiscard]] std::size_t count() const { return ends.size(); }
    /// Two points or more, no two consecutive ones equal. Closed if the last equals the first.
    [[nodiscard]] std::span<const Point2> line(std::size_t i) const {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return std::span(points).subspan(begin, ends[i] - begin);
    }
};

/// Cuts the terrain of a TIN at levels, ascending and distinct: the lines of each level.
///
/// A level is taken infinitesimally above its value, so a vertex or level face at it is below it, and lines
/// neither branch nor break: every line is as long as it can be, closed, or from border to border of the
/// terrain, with the higher ground on its left. Of a level face at the level the line follows the edges
/// beyond which it rises, through the vertices themselves; along a level valley it runs up one side and down
/// the other, along a level ridge there is none. Where all of a line falls into one point it is left out.
/// Lines of different levels do not cross, and points are shared bit for bit between faces (`ContourSites`);
/// they meet only where crossings lie closer together than doubles can tell.
///
/// Lines are in the order of their smallest edge, an edge being named by its ends' ids, the smaller first;
/// closed ones begin there. Nothing depends on the order of faces, or on the number of threads.
///
/// O(faces + crossings + n log levels), parallel inside the caller's task arena. Memory: 36 bytes a vertex,
/// 20 a face, 32 a crossing of a face and a level, and twice the lines. Throws Cancelled, and UsageError for
/// more than 2 * 10^8 such crossings.
std::vector<LevelLines> make_contours(const Tin& tin, std::span<const double> levels,
                                      const Progress& progress = {});
/// The same of any mesh, with a position for each of its vertices.
std::vector<LevelLines> make_contours(const TriangleMesh& mesh, std::span<const Point3> vertices,
                                      std::span<const double> levels, const Progress& progress = {});

}  // namespace tinwright

#endif
