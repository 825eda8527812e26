// Reads one surface in several ways: compares the methods with the true terrain, then walks a line.
//   read_surface SURVEY.csv
#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
#include <string>

#include "tinwright/io/read_samples.hpp"
#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/interpolation.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/products.hpp"

#include "invented_terrain.hpp"

namespace {

// The survey's coordinates are those of the terrain, moved to where a map might have it.
constexpr double kWest = 598000;
constexpr double kSouth = 5402000;

/// Root mean square error at places five metres apart, away from lake and road, which need breaklines.
double error_of(const tinwright::SurfaceLocator& locator, const tinwright::Interpolator& surface) {
    const auto reader = surface.make_reader();
    double squares = 0;
    int places = 0;
    for (double x = 0; x < invented::kWidth; x += 5) {
        for (double y = 0; y < invented::kHeight; y += 5) {
            const auto place = locator.find(tinwright::Point2{kWest + x, kSouth + y});
            const bool is_natural = !invented::is_in_lake({x, y}) && invented::distance_to_road({x, y}) > 30;
            if (place && is_natural) {
                const double error = reader->elevation(*place) - invented::elevation({x, y});
                squares += error * error;
                ++places;
            }
        }
    }
    return std::sqrt(squares / places);
}

int run(const std::string& survey) {
    namespace io = tinwright::io;
    const io::Samples samples = io::read_samples({{io::parse_source(survey)}}, {});
    tinwright::TriangulateOptions how;
    how.domain.kind = tinwright::DomainRule::Kind::Trimmed;
    const tinwright::Triangulated made = tinwright::triangulate(samples.points, how);
    const tinwright::SurfaceLocator locator(made.tin);

    std::cout << std::fixed << std::setprecision(3);
    for (const auto& [name, method] : tinwright::kInterpolationMethods) {
        const auto surface = tinwright::make_interpolator(made.tin, {}, {.method = method, .threads = 0});
        std::cout << std::left << std::setw(26) << name << " error " << error_of(locator, *surface) << " m\n";
    }

    const auto smooth = tinwright::make_interpolator(
        made.tin, {}, {.method = tinwright::InterpolationMethod::Smooth, .threads = 0});
    const auto reader = smooth->make_reader();
    for (double x = 200; x <= 1000; x += 200) {
        if (const auto place = locator.find(tinwright::Point2{kWest + x, kSouth + 600})) {
            const tinwright::SurfaceReading here = reader->read(*place);
            std::cout << "at " << x << " m: elevation " << here.z << ", slope "
                      << tinwright::slope_of(here.gradient, tinwright::SlopeUnit::Percent) << " %\n";
        }
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: read_surface SURVEY.csv\n";
        return 2;
    }
    try {
        return run(argv[1]);
    } catch (const std::exception& error) {
        std::cerr << "read_surface: " << error.what() << '\n';
        return 1;
    }
}
