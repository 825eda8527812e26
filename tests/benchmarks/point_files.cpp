#include "benchmarks/point_files.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include <ogrsf_frmts.h>

#include "tinwright/io/gdal_session.hpp"

#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

using tinwright::Point3;
using tinwright_tests::Random;

namespace {

constexpr double kExtent = 4000;

/// A rolling terrain, to the centimetre.
double elevation(double x, double y) {
    const double z = 200 + 30 * std::sin(x / 310) * std::cos(y / 270) + 8 * std::sin((x + 2 * y) / 83) +
                     1.5 * std::cos((3 * x - y) / 29);
    return std::round(z * 100) / 100;
}

void write_rows(const std::string& path, const char* header, char separator, std::span<const Point3> points,
                int decimals) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "wb"), std::fclose);
    if (!file) {
        throw std::runtime_error("cannot write " + path);
    }
    std::fputs(header, file.get());
    for (const Point3& p : points) {
        std::fprintf(file.get(), "%.*f%c%.*f%c%.2f\n", decimals, p.x, separator, decimals, p.y, separator,
                     p.z);
    }
    if (std::ferror(file.get()) != 0) {
        throw std::runtime_error("cannot write " + path);
    }
}

}  // namespace

Points uniform_points(std::size_t count) {
    Random random(1);
    Points points(count);
    for (Point3& p : points) {
        p.x = kExtent * random.real();
        p.y = kExtent * random.real();
        p.z = elevation(p.x, p.y);
    }
    return points;
}

Points survey_points(std::size_t count) {
    Random random(2);
    Points points(count);
    for (Point3& p : points) {
        p.x = random.key(1000 * kExtent) / 1000;  // one division: the double nearest to the decimal
        p.y = random.key(1000 * kExtent) / 1000;
        p.z = elevation(p.x, p.y);
    }
    return points;
}

Points scan_points(std::size_t count) {
    Random random(3);
    Points points = tinwright_tests::scan_samples(random, count);
    for (Point3& p : points) {
        const double noise = 0.12 * random.real() - 0.06;
        p.z = std::round(100 * (elevation(p.x, p.y) + noise)) / 100;
    }
    return points;
}

Points grid_points(int side, bool is_shuffled) {
    Points points;
    for (const tinwright::Key2 key : tinwright_tests::grid_keys(side, side)) {
        points.push_back({key.x, key.y, elevation(key.x, key.y)});
    }
    Random random(4);
    return is_shuffled ? tinwright_tests::shuffled(random, std::move(points)) : points;
}

void write_xyz(const std::string& path, std::span<const Point3> points, int decimals) {
    write_rows(path, "", ' ', points, decimals);
}

void write_csv(const std::string& path, std::span<const Point3> points, int decimals) {
    write_rows(path, "x,y,z\n", ',', points, decimals);
    const std::filesystem::path file(path);
    const std::string layer = file.stem().string();
    std::ofstream vrt(path + ".vrt");
    vrt << "<OGRVRTDataSource><OGRVRTLayer name=\"" << layer << "\"><SrcDataSource relativeToVRT=\"1\">"
        << file.filename().string()
        << "</SrcDataSource><GeometryType>wkbPoint25D</GeometryType>"
           "<GeometryField encoding=\"PointFromColumns\" x=\"x\" y=\"y\" z=\"z\"/>"
           "</OGRVRTLayer></OGRVRTDataSource>\n";
    if (!vrt.flush()) {
        throw std::runtime_error("cannot write " + path + ".vrt");
    }
}

void write_geopackage(const std::string& path, std::span<const Point3> points) {
    tinwright::io::register_drivers();
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    const std::unique_ptr<GDALDataset> dataset(
        driver == nullptr ? nullptr : driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    OGRLayer* const layer = dataset ? dataset->CreateLayer("points", nullptr, wkbPoint25D, nullptr) : nullptr;
    if (layer == nullptr) {
        throw std::runtime_error("cannot write " + path);
    }
    OGRFieldDefn field("class", OFTInteger);
    bool is_good = layer->CreateField(&field) == OGRERR_NONE && dataset->StartTransaction() == OGRERR_NONE;
    OGRFeature feature(layer->GetLayerDefn());
    for (const Point3& p : points) {
        const OGRPoint point(p.x, p.y, p.z);
        feature.SetFID(OGRNullFID);
        feature.SetField(0, 2);
        is_good = is_good && feature.SetGeometry(&point) == OGRERR_NONE &&
                  layer->CreateFeature(&feature) == OGRERR_NONE;
    }
    if (!is_good || dataset->CommitTransaction() != OGRERR_NONE) {
        throw std::runtime_error("cannot write " + path);
    }
}

}  // namespace tinwright_benchmarks
