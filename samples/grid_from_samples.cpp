// Reads samples from any file that GDAL or the text reader knows and writes a DEM of half the usual cell
// size.
//   grid_from_samples INPUT OUTPUT.tif [CRS]
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/write_grid.hpp"
#include "tinwright/optimal/triangulate.hpp"

namespace {

int run(const std::vector<std::string>& arguments) {
    namespace io = tinwright::io;

    io::ReadOptions read;
    if (arguments.size() == 3) {
        read.crs = io::Crs::parse(arguments[2]);
    }
    const std::vector<io::Source> sources{io::parse_source(arguments[0])};
    const io::Samples samples = io::read_samples(sources, read);

    // Needle faces along the hull hold no terrain: leave them out, as `tinwright grid` does.
    tinwright::TriangulateOptions how;
    how.domain.kind = tinwright::DomainRule::Kind::Trimmed;
    how.threads = 0;
    const tinwright::Triangulated surface = tinwright::triangulate(samples.points, how);

    const double cell = tinwright::median_spacing(surface.tin) / 4;
    const tinwright::GridGeometry grid =
        tinwright::choose_grid(surface.tin, {.resolution = tinwright::Point2{cell, cell}});
    const io::WrittenGrid written =
        io::write_grid(surface.tin, samples.crs, grid, arguments[1], {.overwrite = true, .threads = 0});

    std::cout << samples.points.size() << " samples, " << surface.report.faces << " faces, " << grid.columns
              << " x " << grid.rows << " cells of " << cell << ", " << written.cells_with_value
              << " cells with a value\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.size() < 2 || arguments.size() > 3) {
        std::cerr << "usage: grid_from_samples INPUT OUTPUT.tif [CRS]\n";
        return 2;
    }
    try {
        return run(arguments);
    } catch (const std::exception& error) {
        std::cerr << "grid_from_samples: " << error.what() << '\n';
        return 1;
    }
}
