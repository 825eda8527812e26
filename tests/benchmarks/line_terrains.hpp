#ifndef TINWRIGHT_TESTS_BENCHMARKS_LINE_TERRAINS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_LINE_TERRAINS_HPP

#include <cstddef>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"

#include "benchmarks/point_files.hpp"

/// The sets of samples and lines on which constrained and conforming triangulations are measured. All are
/// seeded, to the centimetre, and no two lines of a set cross.
namespace tinwright_benchmarks {

struct LineTerrain {
    Points samples;
    std::vector<tinwright::Breakline> lines;
};

/// Uniform samples, one a square metre, and a hundredth as many polylines of 20 segments: wiggly, each in
/// its own cell of a grid.
LineTerrain samples_and_lines(std::size_t samples);
/// Closed contours of a hill, `apart` metres from one to the next, a vertex every `step` metres.
LineTerrain contours(std::size_t rings, double apart, double step);
/// The same 0.3 m apart, with vertices 1 to 6 hundredths of a radian apart at random.
LineTerrain irregular_contours(std::size_t rings);
/// Six segments from one point, 1 to 9 degrees from one to the next, many times.
LineTerrain sharp_fans(std::size_t fans);
/// The lower bound of [tan1993, Fig. 6.1]: `edges` parallel edges a centimetre apart, and `pairs` pairs of
/// samples, those of a pair facing each other across the edges.
LineTerrain close_parallel_edges(std::size_t edges, std::size_t pairs);

}  // namespace tinwright_benchmarks

#endif
