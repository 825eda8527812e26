#ifndef TINWRIGHT_TESTS_BENCHMARKS_BENCHMARKS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_BENCHMARKS_HPP

#include <cstddef>
#include <string>

/// One function a table of docs/benchmarks.md; each prints its table on stdout.
namespace tinwright_benchmarks {

struct Settings {
    int rounds = 5;         ///< interleaved runs of which the median is taken
    double scale = 1;       ///< of the numbers of points and cells; below 1 for a quick look
    std::string scratch;    ///< folder for large files
    std::string tinwright;  ///< the command that is measured
    std::string images;     ///< folder for pictures; empty: none are made
    std::string data;       ///< folder of the data sets that accuracy is measured on; empty: there is none
    std::string sets;       ///< beginnings of the names of the sets, separated by commas; empty: all
    std::string methods;    ///< surfaces to compare, separated by commas; empty: all

    [[nodiscard]] std::size_t count(double full) const;
    /// Columns or rows of a raster, or of a grid of points: their product scales.
    [[nodiscard]] int side(double full) const;
};

void run_delaunay(const Settings& settings);
void run_raster(const Settings& settings);
void run_job(const Settings& settings);
void run_read(const Settings& settings);
/// Ratios to our own Delaunay, growth up to 10^6 points with its picture, and the hardest point sets.
void run_criteria(const Settings& settings);
void run_criteria_growth(const Settings& settings);
void run_criteria_worst(const Settings& settings);
/// Min-max length and proximity graphs: ratios to our own Delaunay mesh, growth, and huge polygons.
void run_length(const Settings& settings);
void run_length_growth(const Settings& settings);
void run_length_worst(const Settings& settings);
/// Lines cut where they meet.
void run_noding(const Settings& settings);
/// Lines in the triangulation: constrained Delaunay, and what makes it conforming.
void run_constrained(const Settings& settings);
void run_conforming(const Settings& settings);
/// Contour lines and bands.
void run_contour(const Settings& settings);
/// Clough-Tocher surfaces and their gradients, and scipy's.
void run_clough_tocher(const Settings& settings);
/// Errors of surfaces where elevations are known: of data sets, and on functions as the samples get denser.
void run_accuracy(const Settings& settings);
void run_convergence(const Settings& settings);
/// Rasters by natural neighbours.
void run_natural_neighbor(const Settings& settings);
/// Splines of vertices: preparation, reading, memory.
void run_smooth(const Settings& settings);
/// Coordinates of many points from one system to another.
void run_transform(const Settings& settings);
/// Rasters in another system than the surface's plane.
void run_grid_crs(const Settings& settings);

}  // namespace tinwright_benchmarks

#endif
