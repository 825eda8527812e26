#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <vector>

#include <gdal_priv.h>

#include "tinwright/geometry/box.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/cgal_peer.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

using tinwright::Box;

namespace {

struct Job {
    std::string name;
    std::string input;       // ours and the composite's
    std::string gdal_input;  // text reaches OGR as CSV through a VRT
    std::string gdal_layer;
    Box extent;
};

std::string text(double value) {
    std::array<char, 64> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", value);
    return digits.data();
}

Box bounds_of(const Points& points) {
    Box box{points[0].x, points[0].y, points[0].x, points[0].y};
    for (const tinwright::Point3& p : points) {
        box = {std::min(box.x_min, p.x), std::min(box.y_min, p.y), std::max(box.x_max, p.x),
               std::max(box.y_max, p.y)};
    }
    return box;
}

Measured run_ours(const Job& job, int side, const Settings& settings, const std::string& output) {
    const std::string cells = std::to_string(side);
    return measure_program({settings.tinwright, "grid", job.input, "-o", output, "--extent",
                            text(job.extent.x_min), text(job.extent.y_min), text(job.extent.x_max),
                            text(job.extent.y_max), "--size", cells, cells, "-j", "1", "--overwrite", "-q"});
}

bool has_gdal_grid() {
    try {
        measure_program({"gdal_grid", "--version"});
        return true;
    } catch (const std::runtime_error&) {
        return false;
    }
}

Measured run_gdal(const Job& job, int side, const std::string& output) {
    const std::string cells = std::to_string(side);
    return measure_program({"gdal_grid",
                            "-q",
                            "-a",
                            "linear:radius=0:nodata=-9999",
                            "-ot",
                            "Float32",
                            "-of",
                            "GTiff",
                            "-txe",
                            text(job.extent.x_min),
                            text(job.extent.x_max),
                            "-tye",
                            text(job.extent.y_max),
                            text(job.extent.y_min),
                            "-outsize",
                            cells,
                            cells,
                            "-l",
                            job.gdal_layer,
                            "--config",
                            "GDAL_NUM_THREADS",
                            "1",
                            job.gdal_input,
                            output});
}

/// By this program once more, so that the start of a process counts for all alike.
Measured run_composite_program(const Job& job, int side, const std::string& output) {
    return measure_program({"/proc/self/exe", "composite", job.input, output, text(job.extent.x_min),
                            text(job.extent.y_min), text(job.extent.x_max), text(job.extent.y_max),
                            std::to_string(side)});
}

std::vector<float> read_cells(const std::string& path) {
    const std::unique_ptr<GDALDataset> dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
    if (!dataset) {
        throw std::runtime_error("cannot read " + path);
    }
    const int columns = dataset->GetRasterXSize();
    const int rows = dataset->GetRasterYSize();
    std::vector<float> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    if (dataset->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, values.data(), columns, rows,
                                            GDT_Float32, 0, 0, nullptr) != CE_None) {
        throw std::runtime_error("cannot read " + path);
    }
    return values;
}

/// The share of `path`'s valid cells that have a value in `reference` too and differ from it by more than a
/// centimetre, in per cent.
double percent_off(const std::string& path, const std::string& reference) {
    const Measured measured = measure_in_child([&](Meter& meter) {
        tinwright::io::register_drivers();
        const std::vector<float> values = read_cells(path);
        const std::vector<float> expected = read_cells(reference);
        std::size_t valid = 0;
        std::size_t off = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (values[i] > -9999 && expected[i] > -9999) {
                ++valid;
                off += std::fabs(values[i] - expected[i]) > 0.01F ? 1 : 0;
            }
        }
        meter.note(100 * static_cast<double>(off) / static_cast<double>(std::max<std::size_t>(valid, 1)));
    });
    return measured.note;
}

std::vector<Job> make_jobs(const Settings& settings) {
    const std::string survey = settings.scratch + "/survey";
    const std::string scan = settings.scratch + "/scan";
    const std::string boxes = settings.scratch + "/boxes";
    // In a child: the size of this process would count as memory of the programs it starts.
    do_in_child([&] {
        const Points survey_set = survey_points(settings.count(1e6));
        write_xyz(survey + ".xyz", survey_set, 3);
        write_csv(survey + ".csv", survey_set, 3);
        write_geopackage(survey + ".gpkg", survey_set);
        const Points scan_set = scan_points(settings.count(1e6));
        write_xyz(scan + ".xyz", scan_set, 2);
        write_csv(scan + ".csv", scan_set, 2);
        const std::array<Box, 2> found{bounds_of(survey_set), bounds_of(scan_set)};
        const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(boxes.c_str(), "wb"),
                                                                   std::fclose);
        if (!file || std::fwrite(found.data(), sizeof(Box), found.size(), file.get()) != found.size()) {
            throw std::runtime_error("cannot write " + boxes);
        }
    });
    std::array<Box, 2> found;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(boxes.c_str(), "rb"), std::fclose);
    if (!file || std::fread(found.data(), sizeof(Box), found.size(), file.get()) != found.size()) {
        throw std::runtime_error("cannot read " + boxes);
    }
    return {Job{"XYZ text, uniform", survey + ".xyz", survey + ".csv.vrt", "survey", found[0]},
            Job{"GeoPackage, uniform", survey + ".gpkg", survey + ".gpkg", "points", found[0]},
            Job{"XYZ text, scan rows", scan + ".xyz", scan + ".csv.vrt", "scan", found[1]}};
}

void measure_job(const Job& job, const Settings& settings, ResultTable& table) {
    const int side = settings.side(4000);
    const std::string ours_file = settings.scratch + "/ours.tif";
    const std::string composite_file = settings.scratch + "/composite.tif";
    const std::string gdal_file = settings.scratch + "/gdal_grid.tif";
    std::vector<std::function<Measured()>> contenders{
        [&] { return run_ours(job, side, settings, ours_file); }};
    if (has_cgal()) {
        contenders.emplace_back([&] { return run_composite_program(job, side, composite_file); });
    }
    const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
    const Measured& ours = results[0];
    if (has_gdal_grid()) {
        const Measured gdal = run_gdal(job, side, gdal_file);
        table.add(job.name + ": CPU time, `gdal_grid -a linear` over ours", in_seconds(ours.cpu_seconds),
                  "`gdal_grid`: " + in_seconds(gdal.cpu_seconds), gdal.cpu_seconds / ours.cpu_seconds,
                  at_least(12), "x");
        table.add(job.name + ": peak memory, ours over `gdal_grid`", in_megabytes(ours.peak_bytes),
                  "`gdal_grid`: " + in_megabytes(gdal.peak_bytes), ours.peak_bytes / gdal.peak_bytes,
                  at_most(0.5));
        table.add(job.name + ": valid cells of `gdal_grid` off by more than 1 cm from ours", "", "",
                  percent_off(gdal_file, ours_file), std::nullopt, " %");
    } else {
        table.add(job.name + ": CPU time, `gdal_grid -a linear` over ours", in_seconds(ours.cpu_seconds),
                  "`gdal_grid` is not installed", std::nullopt, at_least(12), "x");
    }
    if (has_cgal()) {
        table.add(job.name + ": CPU time, ours over the composite", in_seconds(ours.cpu_seconds),
                  "composite: " + in_seconds(results[1].cpu_seconds),
                  ours.cpu_seconds / results[1].cpu_seconds, at_most(0.6));
        table.add(job.name + ": peak memory, ours over the composite", in_megabytes(ours.peak_bytes),
                  "composite: " + in_megabytes(results[1].peak_bytes),
                  ours.peak_bytes / results[1].peak_bytes);
        table.add(job.name + ": valid cells of ours off by more than 1 cm from the composite's", "", "",
                  percent_off(ours_file, composite_file), std::nullopt, " %");
    }
}

}  // namespace

void run_job(const Settings& settings) {
    const std::vector<Job> jobs = make_jobs(settings);
    ResultTable table("10^6 points to a 4000 x 4000 GeoTIFF, one thread", "`tinwright grid -j 1`",
                      cgal_name() + ", GDAL " + GDALVersionInfo("RELEASE_NAME"));
    for (const Job& job : jobs) {
        measure_job(job, settings, table);
    }
}

}  // namespace tinwright_benchmarks
