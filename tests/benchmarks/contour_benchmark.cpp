#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <tbb/task_arena.h>

#include "tinwright/optimal/triangulate.hpp"
#include "tinwright/surface/contour.hpp"
#include "tinwright/surface/contour_bands.hpp"
#include "tinwright/surface/contour_levels.hpp"
#include "tinwright/surface/grid.hpp"
#include "tinwright/surface/scan_conversion.hpp"

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/measure.hpp"
#include "benchmarks/point_files.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/terrain_points.hpp"

namespace tinwright_benchmarks {

namespace {

using tinwright::LevelLines;

/// A layer in memory with an elevation for each feature.
class MemoryLayer {
  public:
    explicit MemoryLayer(OGRwkbGeometryType type) {
        GDALAllRegister();
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("Memory");
        dataset_.reset(driver == nullptr ? nullptr : driver->Create("", 0, 0, 0, GDT_Unknown, nullptr));
        layer_ = dataset_ ? dataset_->CreateLayer("contours", nullptr, type, nullptr) : nullptr;
        if (layer_ == nullptr) {
            throw std::runtime_error("GDAL makes no layer in memory");
        }
        for (const auto& [name, field] : {std::pair{"id", OFTInteger}, std::pair{"elev", OFTReal}}) {
            OGRFieldDefn definition(name, field);
            static_cast<void>(layer_->CreateField(&definition));
        }
    }
    [[nodiscard]] OGRLayer& layer() { return *layer_; }

  private:
    GDALDatasetUniquePtr dataset_;
    OGRLayer* layer_ = nullptr;
};

std::vector<double> levels_of(const tinwright::Tin& tin, double interval) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double z : tin.z) {
        low = std::min(low, z);
        high = std::max(high, z);
    }
    std::vector<double> levels;
    for (const auto& level : tinwright::choose_levels(low, high, {.interval = interval})) {
        levels.push_back(level.elevation);
    }
    return levels;
}

std::size_t count_points(const std::vector<LevelLines>& contours) {
    std::size_t points = 0;
    for (const LevelLines& lines : contours) {
        points += lines.points.size();
    }
    return points;
}

void add_features(const std::vector<LevelLines>& contours, const std::vector<double>& levels,
                  OGRLayer& layer) {
    int id = 0;
    for (std::size_t level = 0; level < contours.size(); ++level) {
        for (std::size_t i = 0; i < contours[level].count(); ++i) {
            const auto points = contours[level].line(i);
            auto line = std::make_unique<OGRLineString>();
            line->setNumPoints(static_cast<int>(points.size()), FALSE);
            for (int k = 0; k < line->getNumPoints(); ++k) {
                const tinwright::Point2 p = points[static_cast<std::size_t>(k)];
                line->setPoint(k, p.x, p.y);
            }
            OGRFeature feature(layer.GetLayerDefn());
            feature.SetField(0, id++);
            feature.SetField(1, levels[level]);
            feature.SetGeometryDirectly(line.release());  // takes it over
            if (layer.CreateFeature(&feature) != OGRERR_NONE) {
                throw std::runtime_error("GDAL takes no feature in memory");
            }
        }
    }
}

/// Contours of a TIN, in an array or as features. Notes the points of all lines.
Work our_lines(const Points& points, double interval, int threads, bool is_layer) {
    return [&points, interval, threads, is_layer](Meter& meter) {
        const tinwright::Tin tin = tinwright::triangulate(points).tin;
        MemoryLayer layer(wkbLineString);
        tbb::task_arena arena(threads);
        meter.start();
        const std::vector<double> levels = levels_of(tin, interval);
        std::vector<LevelLines> contours;
        arena.execute([&] { contours = tinwright::make_contours(tin, levels); });
        if (is_layer) {
            add_features(contours, levels, layer.layer());
        }
        meter.stop();
        meter.note(static_cast<double>(count_points(contours)));
    };
}

Work our_bands(const Points& points, double interval) {
    return [&points, interval](Meter& meter) {
        const tinwright::Tin tin = tinwright::triangulate(points).tin;
        const std::vector<double> levels = levels_of(tin, interval);
        tbb::task_arena arena(1);
        meter.start();
        arena.execute([&] { meter.note(static_cast<double>(tinwright::make_bands(tin, levels).size())); });
        meter.stop();
    };
}

/// As many cells as the TIN has faces: lines then have about as many points.
std::vector<float> rasterise(const Points& points, int side, std::array<double, 6>& transform) {
    const tinwright::Tin tin = tinwright::triangulate(points).tin;
    const tinwright::Box box = tin.bounds();
    const double cell = (box.x_max - box.x_min) / side;
    const tinwright::GridGeometry grid{box.x_min, box.y_min + side * cell, cell, cell, side, side};
    transform = {grid.x_min, cell, 0, grid.y_max, 0, -cell};
    std::vector<float> values(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    const tinwright::ScanConverter converter(tin, grid, side);
    converter.fill(0, values, -9999.0F);
    return values;
}

Work gdal_contours(const Points& points, double interval, bool is_polygons) {
    return [&points, interval, is_polygons](Meter& meter) {
        const auto side = static_cast<int>(std::lround(std::sqrt(2 * static_cast<double>(points.size()))));
        std::array<double, 6> transform{};
        std::vector<float> values = rasterise(points, side, transform);
        MemoryLayer layer(is_polygons ? wkbMultiPolygon : wkbLineString);
        const GDALDatasetUniquePtr raster(
            GetGDALDriverManager()->GetDriverByName("MEM")->Create("", side, side, 1, GDT_Float32, nullptr));
        raster->SetGeoTransform(transform.data());
        GDALRasterBand* const band = raster->GetRasterBand(1);
        band->SetNoDataValue(-9999);
        if (band->RasterIO(GF_Write, 0, 0, side, side, values.data(), side, side, GDT_Float32, 0, 0,
                           nullptr) != CE_None) {
            throw std::runtime_error("GDAL takes no raster in memory");
        }
        CPLStringList options;
        options.SetNameValue("LEVEL_INTERVAL", CPLSPrintf("%.15g", interval));
        options.SetNameValue("ID_FIELD", "0");
        options.SetNameValue(is_polygons ? "ELEV_FIELD_MIN" : "ELEV_FIELD", "1");
        options.SetNameValue("NODATA", "-9999");
        options.SetNameValue("POLYGONIZE", is_polygons ? "YES" : "NO");
        meter.start();
        const CPLErr error = GDALContourGenerateEx(band, &layer.layer(), options.List(), nullptr, nullptr);
        meter.stop();
        if (error != CE_None) {
            throw std::runtime_error("GDAL makes no contours");
        }
        double count = 0;
        for (const auto& feature : layer.layer()) {
            const OGRGeometry* const geometry = feature->GetGeometryRef();
            count += is_polygons ? 1 : geometry->toLineString()->getNumPoints();
        }
        meter.note(count);
    };
}

}  // namespace

void run_contour(const Settings& settings) {
    const std::size_t count = settings.count(5e5);
    ResultTable table("Contours of 10^6 faces, one thread", "tinwright", "GDAL " GDAL_RELEASE_NAME);
    struct Terrain {
        const char* name;
        Points points;
        double interval;
    };
    const std::array<Terrain, 3> terrains{Terrain{"rolling, 2 m", uniform_points(count), 2},
                                          Terrain{"rolling, 0.5 m", uniform_points(count), 0.5},
                                          Terrain{"rough, 5 m", fractal_points(count), 5}};
    for (const Terrain& terrain : terrains) {
        const Points& points = terrain.points;
        const double interval = terrain.interval;
        const std::array<std::function<Measured()>, 6> contenders{
            [&] { return measure_in_child(our_lines(points, interval, 1, true)); },
            [&] { return measure_in_child(gdal_contours(points, interval, false)); },
            [&] { return measure_in_child(our_lines(points, interval, 1, false)); },
            [&] { return measure_in_child(our_lines(points, interval, 2, false)); },
            [&] { return measure_in_child(our_bands(points, interval)); },
            [&] { return measure_in_child(gdal_contours(points, interval, true)); }};
        const std::vector<Measured> results = measure_in_turn(contenders, settings.rounds);
        const std::string label = terrain.name;
        table.add(label + ": features of a layer in memory", in_seconds(results[0].cpu_seconds),
                  in_seconds(results[1].cpu_seconds), results[0].cpu_seconds / results[1].cpu_seconds,
                  at_most(0.25));
        table.add(label + ": points of all lines", number(results[0].note), number(results[1].note),
                  results[0].note / results[1].note);
        table.add(label + ": lines alone, a point", in_seconds(results[2].cpu_seconds), "",
                  1e9 * results[2].cpu_seconds / results[2].note, std::nullopt, " ns");
        table.add(label + ": lines alone, two threads", in_seconds(results[3].wall_seconds),
                  "one: " + in_seconds(results[2].wall_seconds),
                  results[2].wall_seconds / results[3].wall_seconds, std::nullopt, "x");
        table.add(label + ": bands as polygons", in_seconds(results[4].cpu_seconds),
                  in_seconds(results[5].cpu_seconds), results[4].cpu_seconds / results[5].cpu_seconds);
    }
}

}  // namespace tinwright_benchmarks
