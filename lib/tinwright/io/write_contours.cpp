#include "tinwright/io/write_contours.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/tin_dataset.hpp"
#include "tinwright/io/tin_drivers.hpp"

namespace tinwright::io {
namespace {

constexpr const char* kAlternatives = "use .gpkg, .shp, .fgb, .gml, .sqlite, .csv or .geojson";

/// Fills one dataset; returns the number of features.
using Fill = std::function<std::size_t(TinDataset&)>;

class FeatureProgress {
  public:
    FeatureProgress(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
    void operator()() {
        if (++done_ % 1024 == 0) {
            report_progress(progress_, static_cast<double>(done_) / static_cast<double>(total_));
        }
    }

  private:
    const Progress& progress_;
    std::size_t total_;
    std::size_t done_ = 0;
};

bool is_given(const std::vector<std::string>& options, const std::string& key) {
    return std::any_of(options.begin(), options.end(), [&](const std::string& option) {
        return EQUALN(option.c_str(), (key + "=").c_str(), key.size() + 1);
    });
}

WriteTinOptions dataset_options_of(const TinDriver& driver, const WriteContoursOptions& options) {
    WriteTinOptions result;
    result.driver = options.driver;
    result.creation_options = options.creation_options;
    result.layer_options = options.layer_options;
    result.metadata = options.metadata;
    // Crossings need all the digits there are, or rings would touch where they do not.
    if (driver.name == "GeoJSON" && !is_given(options.layer_options, "COORDINATE_PRECISION") &&
        !is_given(options.layer_options, "SIGNIFICANT_FIGURES")) {
        result.layer_options.emplace_back("SIGNIFICANT_FIGURES=17");
    }
    return result;
}

std::size_t fill_lines(TinDataset& dataset, const WriteContoursOptions& options,
                       std::span<const ContourLevel> levels, std::span<const LevelLines> lines) {
    constexpr std::array<TinField, 3> kFields = {
        {{"id", OFTInteger}, {"elev", OFTReal}, {"is_index", OFTInteger}}};
    TinLayer layer = dataset.add_layer(options.layer_name, wkbLineString25D,
                                       std::span(kFields).first(options.has_index ? 3 : 2), Tin{});
    std::size_t total = 0;
    for (const LevelLines& of_level : lines) {
        total += of_level.count();
    }
    FeatureProgress progress(options.progress, total);
    for (std::size_t level = 0; level < lines.size(); ++level) {
        const double z = levels[level].elevation;
        for (std::size_t i = 0; i < lines[level].count(); ++i) {
            const std::span<const Point2> points = lines[level].line(i);
            auto& line = layer.geometry<OGRLineString>();
            line.setNumPoints(static_cast<int>(points.size()), FALSE);
            for (int k = 0; k < line.getNumPoints(); ++k) {
                const Point2 p = points[static_cast<std::size_t>(k)];
                line.setPoint(k, p.x, p.y, z);
            }
            layer.set(0, static_cast<int>(layer.written()));
            layer.set(1, z);
            if (options.has_index) {
                layer.set(2, levels[level].is_index ? 1 : 0);
            }
            layer.write();
            progress();
        }
    }
    return layer.written();
}

std::unique_ptr<OGRPolygon> make_polygon(const BandPolygon& rings) {
    auto polygon = std::make_unique<OGRPolygon>();
    for (const BandRing& points : rings) {
        auto ring = std::make_unique<OGRLinearRing>();
        ring->setNumPoints(static_cast<int>(points.size()), FALSE);
        for (int k = 0; k < ring->getNumPoints(); ++k) {
            const Point2 p = points[static_cast<std::size_t>(k)];
            ring->setPoint(k, p.x, p.y);
        }
        polygon->addRingDirectly(ring.release());  // takes it over
    }
    return polygon;
}

std::size_t fill_bands(TinDataset& dataset, const WriteContoursOptions& options,
                       std::span<const Band> bands) {
    constexpr std::array<TinField, 3> kFields = {
        {{"id", OFTInteger}, {"elev_min", OFTReal}, {"elev_max", OFTReal}}};
    TinLayer layer = dataset.add_layer(options.layer_name, wkbMultiPolygon, kFields, Tin{});
    FeatureProgress progress(options.progress, bands.size());
    for (const Band& band : bands) {
        auto& all = layer.geometry<OGRMultiPolygon>();
        all.empty();
        all.set3D(FALSE);
        for (const BandPolygon& polygon : band.polygons) {
            all.addGeometryDirectly(make_polygon(polygon).release());  // takes it over
        }
        layer.set(0, static_cast<int>(layer.written()));
        layer.set(1, band.low);
        layer.set(2, band.high);
        layer.write();
        progress();
    }
    return layer.written();
}

std::size_t write_dataset(const TinDriver& driver, const std::string& path, const std::string& target,
                          const Crs& crs, const WriteContoursOptions& options, const Fill& fill) {
    const WriteTinOptions for_dataset = dataset_options_of(driver, options);
    TinDataset dataset(driver, path, target, crs, for_dataset);
    const std::size_t features = fill(dataset);
    dataset.add_metadata_table();
    dataset.close();
    return features;
}

/// A square in the middle of a UTM zone, at an elevation with decimals.
constexpr std::array<Point2, 5> kSquare{{{500010.125, 6700020.25},
                                         {500011.625, 6700020.25},
                                         {500011.625, 6700021.5},
                                         {500010.125, 6700021.5},
                                         {500010.125, 6700020.25}}};
constexpr double kElevation = -12.75;

Fill probe_fill(const WriteContoursOptions& options, bool is_bands) {
    if (is_bands) {
        return [options](TinDataset& dataset) {
            const std::vector<Band> bands{
                {kElevation, kElevation + 1, {{BandRing(kSquare.begin(), kSquare.end())}}}};
            return fill_bands(dataset, options, bands);
        };
    }
    return [options](TinDataset& dataset) {
        const std::array<ContourLevel, 1> levels{{{kElevation, false}}};
        const std::array<LevelLines, 1> lines{
            {{std::vector<Point2>(kSquare.begin(), kSquare.end()), {kSquare.size()}}}};
        return fill_lines(dataset, options, levels, lines);
    };
}

/// What came back from a probe file.
struct Kept {
    bool positions = false;  ///< to within a thousandth of a unit
    bool z = false;
    bool elevation = false;  ///< in the fields
    bool crs = false;
};

class PointCollector : public OGRDefaultConstGeometryVisitor {
  public:
    using OGRDefaultConstGeometryVisitor::visit;
    void visit(const OGRPoint* p) override { points.push_back({p->getX(), p->getY(), p->getZ()}); }
    std::vector<Point3> points;
};

bool has_field(const OGRFeature& feature, const char* name, double value) {
    const int field = feature.GetFieldIndex(name);
    return field >= 0 && std::abs(feature.GetFieldAsDouble(field) - value) < 1e-6;
}

Kept read_probe(const std::string& path, const Crs& crs, bool is_bands) {
    constexpr double kTolerance = 1e-3;
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    OGRLayer* const layer = dataset ? dataset->GetLayer(0) : nullptr;
    const OGRFeatureUniquePtr feature(layer == nullptr ? nullptr : layer->GetNextFeature());
    if (!feature || feature->GetGeometryRef() == nullptr) {
        return {};
    }
    PointCollector found;
    feature->GetGeometryRef()->accept(&found);
    Kept kept;
    kept.positions = found.points.size() >= kSquare.size();
    kept.z = true;
    for (const Point3& p : found.points) {
        kept.positions = kept.positions && std::any_of(kSquare.begin(), kSquare.end(), [&](Point2 q) {
                             return std::abs(p.x - q.x) < kTolerance && std::abs(p.y - q.y) < kTolerance;
                         });
        kept.z = kept.z && std::abs(p.z - kElevation) < kTolerance;
    }
    kept.elevation = is_bands ? has_field(*feature, "elev_min", kElevation) &&
                                    has_field(*feature, "elev_max", kElevation + 1)
                              : has_field(*feature, "elev", kElevation);
    kept.crs = Crs::from_gdal(layer->GetSpatialRef()).is_same(crs);
    return kept;
}

/// Writes one feature in memory and reads it back. Throws UsageError when it is not kept.
Kept probe(const TinDriver& driver, const std::string& target, const Crs& crs,
           const WriteContoursOptions& options, bool is_bands) {
    static std::atomic<int> count = 0;
    const std::string folder = "/vsimem/tinwright_contour_probe_" + std::to_string(++count);
    const std::string path = folder + "/" + CPLGetFilename(target.c_str());
    WriteContoursOptions quiet = options;
    quiet.progress = nullptr;
    const std::string refusal = "driver " + quoted(driver.name) + " ";
    Kept kept;
    const GdalMessages messages;
    VSIMkdir(folder.c_str(), 0755);
    try {
        write_dataset(driver, path, target, crs, quiet, probe_fill(quiet, is_bands));
        kept = read_probe(path, crs, is_bands);
    } catch (const IoError& error) {
        VSIRmdirRecursive(folder.c_str());
        throw UsageError(refusal + "cannot write contours: " + error.what() + "; " + kAlternatives);
    } catch (const Error&) {
        VSIRmdirRecursive(folder.c_str());
        throw;
    }
    VSIRmdirRecursive(folder.c_str());
    if (!kept.positions) {
        throw UsageError(refusal + "does not keep the positions of contours; " + kAlternatives);
    }
    if (!kept.elevation && (is_bands || !kept.z)) {
        throw UsageError(refusal + "loses the elevations of contours; " + kAlternatives);
    }
    return kept;
}

WrittenContours write_checked(const std::string& target, const Crs& crs, const WriteContoursOptions& options,
                              bool is_bands, const Fill& fill) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    AtomicOutput output(target, options.overwrite);
    const Kept kept = probe(driver, target, crs, options, is_bands);
    report_progress(options.progress, 0);
    WrittenContours written;
    written.driver = driver.name;
    written.features = write_dataset(driver, output.path(), target, crs, options, fill);
    output.commit();
    report_progress(options.progress, 1);
    if (!is_bands && !kept.elevation) {
        written.warnings.push_back("driver " + quoted(driver.name) +
                                   " has no field elev: elevations are in the geometries only");
    } else if (!is_bands && !kept.z) {
        written.warnings.push_back("driver " + quoted(driver.name) +
                                   " loses z: elevations are in the field elev only");
    }
    // A GeoJSON's other systems stand in its metadata, a CSV's in the .prj file beside it.
    if (!kept.crs && driver.metadata != MetadataPlace::Member && driver.name != "CSV") {
        written.warnings.push_back("driver " + quoted(driver.name) + " does not keep the CRS " + crs.name());
    }
    return written;
}

}  // namespace

void check_contour_target(const std::string& target, const WriteContoursOptions& options, bool is_bands) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    // With a projected CRS, drivers betray themselves that turn everything into longitude and latitude.
    static_cast<void>(probe(driver, target, Crs::parse("EPSG:32635"), options, is_bands));
}

WrittenContours write_contours(std::span<const ContourLevel> levels, std::span<const LevelLines> lines,
                               const Crs& crs, const std::string& target,
                               const WriteContoursOptions& options) {
    return write_checked(target, crs, options, false,
                         [&](TinDataset& dataset) { return fill_lines(dataset, options, levels, lines); });
}

WrittenContours write_bands(std::span<const Band> bands, const Crs& crs, const std::string& target,
                            const WriteContoursOptions& options) {
    return write_checked(target, crs, options, true,
                         [&](TinDataset& dataset) { return fill_bands(dataset, options, bands); });
}

}  // namespace tinwright::io
