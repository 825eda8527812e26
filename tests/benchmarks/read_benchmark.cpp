#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

#include <cpl_conv.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_samples.hpp"

#include "benchmarks/bare_readers.hpp"
#include "benchmarks/benchmarks.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"

namespace tinwright_benchmarks {

namespace {

using BareReader = std::vector<tinwright::Point3> (*)(const std::string&);

/// On one thread, which is the default.
std::vector<tinwright::Point3> read_ours(const std::string& path) {
    tinwright::io::Source source;
    source.path = path;
    return tinwright::io::read_samples(std::span(&source, 1)).points;
}

/// Notes a checksum of the coordinates, for all readers must have read the same.
Work reading(const std::string& path, BareReader read) {
    return [=](Meter& meter) {
        tinwright::io::register_drivers();  // once a process, whatever is read
        meter.start();
        const std::vector<tinwright::Point3> points = read(path);
        meter.stop();
        double sum = 0;
        for (const tinwright::Point3& p : points) {
            sum += p.x + 2 * p.y + 3 * p.z;
        }
        meter.note(sum);
    };
}

void compare(const std::string& name, const std::string& path, BareReader bare, double target, int rounds,
             ResultTable& table) {
    const std::array<std::function<Measured()>, 2> contenders{
        [&] { return measure_in_child(reading(path, read_ours)); },
        [&] { return measure_in_child(reading(path, bare)); }};
    const std::vector<Measured> results = measure_in_turn(contenders, rounds);
    if (results[0].note != results[1].note) {
        throw std::runtime_error(path + ": the readers disagree about its content");
    }
    table.add(name, in_seconds(results[0].cpu_seconds), in_seconds(results[1].cpu_seconds),
              results[0].cpu_seconds / results[1].cpu_seconds, at_most(target));
}

}  // namespace

void run_read(const Settings& settings) {
    const std::string text = settings.scratch + "/read.xyz";
    const std::string scan_text = settings.scratch + "/read_scan.xyz";
    const std::string geopackage = settings.scratch + "/read.gpkg";
    do_in_child([&] {
        const Points points = survey_points(settings.count(1e6));
        write_xyz(text, points, 3);
        write_geopackage(geopackage, points);
        write_xyz(scan_text, scan_points(settings.count(1e6)), 2);
    });
    ResultTable table("Reading 10^6 points, one thread", "tinwright", "bare loop");
    compare("XYZ text, uniform", text, read_text_barely, 3, settings.rounds, table);
    compare("XYZ text, scan rows", scan_text, read_text_barely, 3, settings.rounds, table);
    compare("GeoPackage", geopackage, read_arrow_barely, 1.2, settings.rounds, table);
}

}  // namespace tinwright_benchmarks
