#include "water_layers.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include <ogrsf_frmts.h>

#include "tinwright/io/tin_dataset.hpp"
#include "tinwright/io/tin_drivers.hpp"

#include "water_finding_text.hpp"

namespace tinwright::tools {

namespace {

/// Sets the field, or empties it.
template <class Value>
void set(io::TinLayer& layer, std::size_t field, const std::optional<Value>& value) {
    if (value) {
        layer.set(field, *value);
    } else {
        layer.set_null(field);
    }
}

std::optional<double> known(double z) { return std::isfinite(z) ? std::optional(z) : std::nullopt; }

/// A source's number and the feature in it.
struct FeatureId {
    std::optional<std::int64_t> source;
    std::optional<std::int64_t> feature;
};

FeatureId id_of_line(std::uint32_t line, const LeveledWater& leveled) {
    if (line >= leveled.lines.parts.size()) {
        return {};
    }
    return {leveled.source_of_line(line), leveled.lines.parts[line].feature};
}

FeatureId other_id(const WaterFinding& finding, const LeveledWater& leveled) {
    const io::SampleSlice* const slice = leveled.samples.find_slice(finding.sample);
    if (finding.other_line != WaterFinding::kNone || slice == nullptr) {
        return id_of_line(finding.other_line, leveled);
    }
    return {leveled.source_of_sample(finding.sample), slice->id(finding.sample - slice->first)};
}

void set_id(io::TinLayer& layer, std::size_t first_field, const FeatureId& id) {
    set(layer, first_field, id.source);
    set(layer, first_field + 1, id.feature);
}

void fill(OGRSimpleCurve& to, const std::vector<Point3>& from) {
    to.setNumPoints(static_cast<int>(from.size()), FALSE);
    for (int i = 0; i < to.getNumPoints(); ++i) {
        const Point3& point = from[static_cast<std::size_t>(i)];
        to.setPoint(i, point.x, point.y, point.z);
    }
}

void add_findings(io::TinDataset& dataset, const LeveledWater& leveled) {
    constexpr std::array<io::TinField, 12> kFields{{{"kind", OFTString},
                                                    {"is_fault", OFTInteger},
                                                    {"amount", OFTReal},
                                                    {"z", OFTReal},
                                                    {"other_z", OFTReal},
                                                    {"chainage", OFTReal},
                                                    {"length", OFTReal},
                                                    {"source", OFTInteger64},
                                                    {"feature", OFTInteger64},
                                                    {"other_source", OFTInteger64},
                                                    {"other_feature", OFTInteger64},
                                                    {"repaired", OFTInteger}}};
    io::TinLayer layer = dataset.add_layer("findings", wkbPoint25D, kFields, Tin{});
    for (const WaterFinding& finding : leveled.findings()) {
        layer.set(0, finding_key(finding.kind));
        layer.set(1, is_fault(finding) ? 1 : 0);
        layer.set(2, finding.amount);
        set(layer, 3, known(finding.z));
        set(layer, 4, known(finding.other_z));
        layer.set(5, finding.chainage);
        layer.set(6, finding.length);
        set_id(layer, 7, id_of_line(finding.line, leveled));
        set_id(layer, 9, other_id(finding, leveled));
        layer.set(11, finding.is_repaired ? 1 : 0);
        auto& point = layer.geometry<OGRPoint>();
        point.setX(finding.location.x);
        point.setY(finding.location.y);
        point.setZ(known(finding.z).value_or(known(finding.other_z).value_or(0)));
        layer.write();
    }
}

void add_reaches(io::TinDataset& dataset, const LeveledWater& leveled) {
    constexpr std::array<io::TinField, 14> kFields{{{"id", OFTInteger64},
                                                    {"source", OFTInteger64},
                                                    {"feature", OFTInteger64},
                                                    {"from", OFTInteger64},
                                                    {"to", OFTInteger64},
                                                    {"downstream", OFTInteger64},
                                                    {"order", OFTInteger64},
                                                    {"length", OFTReal},
                                                    {"z_up", OFTReal},
                                                    {"z_down", OFTReal},
                                                    {"fall", OFTReal},
                                                    {"most_dug", OFTReal},
                                                    {"most_lifted", OFTReal},
                                                    {"between_banks", OFTInteger}}};
    io::TinLayer layer = dataset.add_layer("reaches", wkbLineString25D, kFields, Tin{});
    const std::vector<Reach>& reaches = leveled.water.report.reaches;
    for (std::size_t i = 0; i < reaches.size(); ++i) {
        const Reach& reach = reaches[i];
        if (reach.points.size() < 2) {
            continue;
        }
        layer.set(0, static_cast<std::int64_t>(i));
        set_id(layer, 1, id_of_line(reach.line, leveled));
        layer.set(3, std::int64_t{reach.from});
        layer.set(4, std::int64_t{reach.to});
        set(layer, 5,
            reach.downstream == Reach::kNone ? std::nullopt : std::optional(std::int64_t{reach.downstream}));
        layer.set(6, std::int64_t{reach.order});
        layer.set(7, reach.length);
        const double z_up = reach.points.front().z;
        const double z_down = reach.points.back().z;
        layer.set(8, z_up);
        layer.set(9, z_down);
        layer.set(10, z_up - z_down);
        layer.set(11, reach.most_dug);
        layer.set(12, reach.most_lifted);
        layer.set(13, reach.is_between_banks ? 1 : 0);
        fill(layer.geometry<OGRLineString>(), reach.points);
        layer.write();
    }
}

void add_sections(io::TinDataset& dataset, const LeveledWater& leveled) {
    constexpr std::array<io::TinField, 5> kFields{{{"id", OFTInteger64},
                                                   {"source", OFTInteger64},
                                                   {"feature", OFTInteger64},
                                                   {"z", OFTReal},
                                                   {"width", OFTReal}}};
    io::TinLayer layer = dataset.add_layer("sections", wkbLineString25D, kFields, Tin{});
    const Water& water = leveled.water;
    for (std::size_t i = leveled.lines.lines.size(); i < water.lines.size(); ++i) {
        const std::vector<Point3>& points = water.lines[i].points;
        const Point3& a = points.front();
        layer.set(0, static_cast<std::int64_t>(layer.written()));
        set_id(layer, 1, id_of_line(water.origin[i], leveled));
        layer.set(3, a.z);
        layer.set(4, leveled.section_widths[i - leveled.lines.lines.size()]);
        fill(layer.geometry<OGRLineString>(), points);
        layer.write();
    }
}

using RingsOfLakes = std::map<std::uint32_t, std::vector<const Breakline*>>;

RingsOfLakes find_lake_rings(const Water& water) {
    RingsOfLakes rings;
    for (const Breakline& line : water.lines) {
        if (line.role == LineRole::Lake) {
            rings[line.polygon].push_back(&line);
        }
    }
    return rings;
}

/// Rings as polygons, inner ones inside outer ones.
std::unique_ptr<OGRMultiPolygon> make_polygons(const std::vector<const Breakline*>& lines) {
    std::vector<OGRGeometry*> rings;  // organizePolygons takes them over
    for (const Breakline* const line : lines) {
        auto ring = std::make_unique<OGRLinearRing>();
        ring->set3D(TRUE);
        fill(*ring, line->points);
        auto whole = std::make_unique<OGRPolygon>();
        whole->addRingDirectly(ring.release());  // takes it over
        rings.push_back(whole.release());
    }
    OGRGeometry* const organized =
        OGRGeometryFactory::organizePolygons(rings.data(), static_cast<int>(rings.size()), nullptr, nullptr);
    return std::unique_ptr<OGRMultiPolygon>(
        OGRGeometryFactory::forceToMultiPolygon(organized)->toMultiPolygon());
}

void add_lakes(io::TinDataset& dataset, const LeveledWater& leveled) {
    constexpr std::array<io::TinField, 9> kFields{{{"id", OFTInteger64},
                                                   {"source", OFTInteger64},
                                                   {"feature", OFTInteger64},
                                                   {"level", OFTReal},
                                                   {"is_own", OFTInteger},
                                                   {"shore_length", OFTReal},
                                                   {"samples_inside", OFTInteger64},
                                                   {"samples_on_shore", OFTInteger64},
                                                   {"samples_under", OFTInteger64}}};
    io::TinLayer layer = dataset.add_layer("lakes", wkbMultiPolygon25D, kFields, Tin{});
    const RingsOfLakes rings = find_lake_rings(leveled.water);
    for (const LakeLevel& lake : leveled.water.report.lakes) {
        layer.set(0, static_cast<std::int64_t>(layer.written()));
        set_id(layer, 1, id_of_line(lake.line, leveled));
        layer.set(3, lake.level);
        layer.set(4, lake.is_own ? 1 : 0);
        layer.set(5, lake.shore_length);
        layer.set(6, static_cast<std::int64_t>(lake.samples_inside));
        layer.set(7, static_cast<std::int64_t>(lake.samples_on_shore));
        layer.set(8, static_cast<std::int64_t>(lake.samples_under));
        layer.geometry<OGRMultiPolygon>() = *make_polygons(rings.at(leveled.water.lines[lake.line].polygon));
        layer.write();
    }
}

template <class AddLayers>
std::unique_ptr<io::AtomicOutput> write_layers(const LeveledWater& leveled, const std::string& target,
                                               const std::string& driver_name, bool overwrite,
                                               const io::TinMetadata& metadata, const AddLayers& add_layers) {
    const io::TinDriver driver = io::find_tin_driver(target, driver_name);
    io::WriteTinOptions options;
    options.metadata = metadata;
    if (driver.name.starts_with("GeoJSON")) {
        options.layer_options = {leveled.output_crs.is_geographic() ? "COORDINATE_PRECISION=12"
                                                                    : "COORDINATE_PRECISION=9"};
    }
    auto output = std::make_unique<io::AtomicOutput>(target, overwrite);
    io::TinDataset dataset(driver, output->path(), target, leveled.output_crs, options);
    add_layers(dataset);
    dataset.add_metadata_table();
    dataset.close();
    return output;
}

}  // namespace

std::unique_ptr<io::AtomicOutput> write_findings(const LeveledWater& leveled, const std::string& target,
                                                 const std::string& driver, bool overwrite,
                                                 const io::TinMetadata& metadata) {
    return write_layers(leveled, target, driver, overwrite, metadata,
                        [&](io::TinDataset& dataset) { add_findings(dataset, leveled); });
}

std::unique_ptr<io::AtomicOutput> write_water(const LeveledWater& leveled, const std::string& target,
                                              bool overwrite, const io::TinMetadata& metadata) {
    return write_layers(leveled, target, "GPKG", overwrite, metadata, [&](io::TinDataset& dataset) {
        add_reaches(dataset, leveled);
        add_sections(dataset, leveled);
        add_lakes(dataset, leveled);
        add_findings(dataset, leveled);
    });
}

}  // namespace tinwright::tools
