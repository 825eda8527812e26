#include "tinwright/io/write_graph.hpp"

#include <array>
#include <utility>

#include <ogrsf_frmts.h>

#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/feature_file.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

/// With decimals and unlike elevations.
GraphLine probe_line(const Crs& crs) {
    return {probe_point(crs, 0.125, 0.25, -12.75), probe_point(crs, 1.625, 1.5, 103.5), 1.953125};
}

std::size_t fill(TinDataset& dataset, const std::string& layer_name, std::span<const GraphLine> lines,
                 const Progress& progress) {
    constexpr std::array<TinField, 2> kFields = {{{"id", OFTInteger}, {"length", OFTReal}}};
    TinLayer layer = dataset.add_layer(layer_name, wkbLineString25D, kFields, Tin{});
    FeatureProgress tick(progress, lines.size());
    for (const GraphLine& edge : lines) {
        auto& line = layer.geometry<OGRLineString>();
        line.setNumPoints(2, FALSE);
        line.setPoint(0, edge.from.x, edge.from.y, edge.from.z);
        line.setPoint(1, edge.to.x, edge.to.y, edge.to.z);
        layer.set(0, static_cast<int>(layer.written()));
        layer.set(1, edge.length);
        layer.write();
        tick();
    }
    return layer.written();
}

WriteTinOptions dataset_options_of(const TinDriver& driver, const WriteGraphOptions& options) {
    return feature_file_options(driver, options.creation_options, options.layer_options, options.metadata);
}

/// Throws UsageError when a line is not kept.
KeptFeature probe(const TinDriver& driver, const std::string& target, const Crs& crs,
                  const WriteGraphOptions& options) {
    constexpr const char* kSubject = "graphs";
    const GraphLine line = probe_line(crs);
    const std::array<Point3, 2> points{line.from, line.to};
    const auto fill_probe = [&](TinDataset& dataset) {
        return fill(dataset, options.layer_name, std::span(&line, 1), nullptr);
    };
    const auto has_length = [&](const OGRFeature& feature) {
        return has_field_value(feature, "length", line.length);
    };
    const KeptFeature kept = probe_features(driver, target, crs, dataset_options_of(driver, options),
                                            {kSubject, fill_probe, points, has_length});
    if (!kept.z) {
        refuse_lost_elevations(driver, kSubject);
    }
    return kept;
}

}  // namespace

void check_graph_target(const std::string& target, const WriteGraphOptions& options) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    // With a projected CRS, drivers betray themselves that turn everything into longitude and latitude.
    static_cast<void>(probe(driver, target, Crs::parse("EPSG:32635"), options));
}

WrittenGraph write_graph(std::span<const GraphLine> lines, const Crs& crs, const std::string& target,
                         const WriteGraphOptions& options) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    AtomicOutput output(target, options.overwrite);
    const KeptFeature kept = probe(driver, target, crs, options);
    report_progress(options.progress, 0);
    WrittenGraph written;
    written.driver = driver.name;
    written.features = write_features(
        driver, output.path(), target, crs, dataset_options_of(driver, options),
        [&](TinDataset& dataset) { return fill(dataset, options.layer_name, lines, options.progress); });
    output.commit();
    report_progress(options.progress, 1);
    if (!kept.fields) {
        written.warnings.push_back("driver " + quoted(driver.name) + " has no field length");
    }
    if (std::string warning = lost_crs_warning(driver, kept, crs); !warning.empty()) {
        written.warnings.push_back(std::move(warning));
    }
    return written;
}

}  // namespace tinwright::io
