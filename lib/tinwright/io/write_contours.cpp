#include "tinwright/io/write_contours.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include <ogrsf_frmts.h>

#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/feature_file.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

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

/// A square at an elevation with decimals.
constexpr double kElevation = -12.75;
using ProbeSquare = std::array<Point3, 5>;

ProbeSquare probe_square(const Crs& crs) {
    constexpr std::array<Point2, 5> kCorners{
        {{0.125, 0.25}, {1.625, 0.25}, {1.625, 1.5}, {0.125, 1.5}, {0.125, 0.25}}};
    ProbeSquare square{};
    std::transform(kCorners.begin(), kCorners.end(), square.begin(),
                   [&](Point2 p) { return probe_point(crs, p.x, p.y, kElevation); });
    return square;
}

FillFeatures probe_fill(const WriteContoursOptions& options, const ProbeSquare& points, bool is_bands) {
    std::vector<Point2> square;
    square.reserve(points.size());
    for (const Point3& p : points) {
        square.push_back({p.x, p.y});
    }
    if (is_bands) {
        return [options, square](TinDataset& dataset) {
            const std::vector<Band> bands{
                {kElevation, kElevation + 1, {{BandRing(square.begin(), square.end())}}}};
            return fill_bands(dataset, options, bands);
        };
    }
    return [options, square](TinDataset& dataset) {
        const std::array<ContourLevel, 1> levels{{{kElevation, false}}};
        const std::array<LevelLines, 1> lines{{{square, {square.size()}}}};
        return fill_lines(dataset, options, levels, lines);
    };
}

WriteTinOptions dataset_options_of(const TinDriver& driver, const WriteContoursOptions& options) {
    return feature_file_options(driver, options.creation_options, options.layer_options, options.metadata);
}

/// Writes one feature in memory and reads it back. Throws UsageError when it is not kept.
KeptFeature probe(const TinDriver& driver, const std::string& target, const Crs& crs,
                  const WriteContoursOptions& options, bool is_bands) {
    constexpr const char* kSubject = "contours";
    WriteContoursOptions quiet = options;
    quiet.progress = nullptr;
    const auto has_fields = [is_bands](const OGRFeature& feature) {
        return is_bands ? has_field_value(feature, "elev_min", kElevation) &&
                              has_field_value(feature, "elev_max", kElevation + 1)
                        : has_field_value(feature, "elev", kElevation);
    };
    const ProbeSquare square = probe_square(crs);
    const KeptFeature kept =
        probe_features(driver, target, crs, dataset_options_of(driver, options),
                       {kSubject, probe_fill(quiet, square, is_bands), square, has_fields});
    if (!kept.fields && (is_bands || !kept.z)) {
        refuse_lost_elevations(driver, kSubject);
    }
    return kept;
}

WrittenContours write_checked(const std::string& target, const Crs& crs, const WriteContoursOptions& options,
                              bool is_bands, const FillFeatures& fill) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    AtomicOutput output(target, options.overwrite);
    const KeptFeature kept = probe(driver, target, crs, options, is_bands);
    report_progress(options.progress, 0);
    WrittenContours written;
    written.driver = driver.name;
    written.features =
        write_features(driver, output.path(), target, crs, dataset_options_of(driver, options), fill);
    output.commit();
    report_progress(options.progress, 1);
    if (!is_bands && !kept.fields) {
        written.warnings.push_back("driver " + quoted(driver.name) +
                                   " has no field elev: elevations are in the geometries only");
    } else if (!is_bands && !kept.z) {
        written.warnings.push_back("driver " + quoted(driver.name) +
                                   " loses z: elevations are in the field elev only");
    }
    if (std::string warning = lost_crs_warning(driver, kept, crs); !warning.empty()) {
        written.warnings.push_back(std::move(warning));
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
