#include "tinwright/io/write_tin.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/tin_dataset.hpp"
#include "tinwright/io/tin_drivers.hpp"
#include "tinwright/io/tin_layers.hpp"

namespace tinwright::io {
namespace {

using Geometry = WriteTinOptions::Geometry;

const char* word_for(Geometry geometry) {
    switch (geometry) {
        case Geometry::Polygon:
            return "polygon";
        case Geometry::Tin:
            return "tin";
        case Geometry::Edges:
            return "edges";
        default:
            return "vertices";
    }
}

const char* default_layer(Geometry geometry) {
    return geometry == Geometry::Edges ? "edges" : geometry == Geometry::Vertices ? "vertices" : "faces";
}

/// Calls the progress callback every few thousand features.
class FeatureProgress {
  public:
    FeatureProgress(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
    void operator()() {
        if (++done_ % 4096 == 0) {
            report_progress(progress_,
                            std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_)));
        }
    }

  private:
    const Progress& progress_;
    std::size_t total_;
    std::size_t done_ = 0;
};

std::size_t count_features(const Tin& tin, const TinDriver& driver, Geometry geometry) {
    const std::size_t vertices = tin.vertex_count();
    if (geometry == Geometry::Vertices) {
        return vertices;
    }
    const EdgeCounts edges = count_edges(tin.mesh);
    if (geometry == Geometry::Edges) {
        return edges.all;
    }
    return tin.mesh.count_terrain() + (driver.has_layers ? edges.constrained + vertices : 0);
}

TinMetadata counts_of(const Tin& tin) {
    return {{"TINWRIGHT_VERTICES", std::to_string(tin.vertex_count())},
            {"TINWRIGHT_FACES", std::to_string(tin.mesh.count_terrain())}};
}

/// Writes one dataset at `path`; messages name `target`.
WrittenTin write_dataset(const Tin& tin, const Crs& crs, const TinDriver& driver, const std::string& path,
                         const std::string& target, const WriteTinOptions& options) {
    WrittenTin written;
    written.driver = driver.name;
    const std::string layer =
        options.layer_name.empty() ? default_layer(options.geometry) : options.layer_name;
    FeatureProgress progress(options.progress, count_features(tin, driver, options.geometry));
    const Tick tick = [&progress] { progress(); };
    TinDataset dataset(driver, path, target, crs, options, counts_of(tin));
    written.layers.push_back(layer);
    switch (options.geometry) {
        case Geometry::Edges:
            written.features = write_edges(dataset, layer, tin, options, false, tick);
            break;
        case Geometry::Vertices:
            written.features = write_vertices(dataset, layer, tin, options, tick);
            break;
        case Geometry::Tin:
            written.features = write_surface(dataset, layer, tin, options, tick);
            break;
        case Geometry::Polygon:
            written.features = write_faces(dataset, layer, tin, options, tick);
            break;
    }
    const bool is_surface = options.geometry == Geometry::Polygon || options.geometry == Geometry::Tin;
    if (driver.has_layers && is_surface) {
        if (count_edges(tin.mesh).constrained > 0) {
            write_edges(dataset, "constrained_edges", tin, options, true, tick);
            written.layers.emplace_back("constrained_edges");
        }
        write_vertices(dataset, "vertices", tin, options, tick);
        written.layers.emplace_back("vertices");
    }
    dataset.add_metadata_table();
    dataset.close();
    return written;
}

/// What came back from a probe file.
struct Kept {
    bool opens = false;
    bool geometry = false;
    bool elevations = false;
    bool positions = false;  ///< to within a thousandth of a unit, or what that is in degrees
    bool exact = false;
    bool crs = false;
};

/// A face to try a driver out with.
struct ProbeFace {
    Tin tin;
    std::vector<Point2> positions;  ///< as in the options
};

class PointCollector : public OGRDefaultConstGeometryVisitor {
  public:
    using OGRDefaultConstGeometryVisitor::visit;
    void visit(const OGRPoint* p) override { points.push_back({p->getX(), p->getY(), p->getZ()}); }
    std::vector<Point3> points;
};

Kept compare(const std::vector<Point3>& expected, const std::vector<Point3>& found, bool is_geographic) {
    const double position_tolerance = is_geographic ? 1e-8 : 1e-3;
    constexpr double kElevationTolerance = 1e-6;
    Kept kept;
    kept.opens = true;
    kept.geometry = !found.empty();
    kept.elevations = kept.positions = kept.exact = kept.geometry;
    for (const Point3& p : expected) {
        const auto distance = [&p](const Point3& q) {
            return std::max(std::abs(q.x - p.x), std::abs(q.y - p.y));
        };
        const auto nearest =
            std::min_element(found.begin(), found.end(),
                             [&](const Point3& a, const Point3& b) { return distance(a) < distance(b); });
        if (nearest == found.end()) {
            break;
        }
        const auto has_elevation = [&p](const Point3& q) {
            return std::abs(q.z - p.z) <= kElevationTolerance;
        };
        const bool is_there = distance(*nearest) <= position_tolerance;
        kept.positions = kept.positions && is_there;
        kept.elevations =
            kept.elevations &&
            (is_there ? has_elevation(*nearest) : std::any_of(found.begin(), found.end(), has_elevation));
        kept.exact = kept.exact && *nearest == p;
    }
    return kept;
}

Kept read_probe(const std::string& path, const ProbeFace& face, const Crs& crs,
                const WriteTinOptions& written) {
    const std::array<const char*, 4> open_options = {"X_POSSIBLE_NAMES=X", "Y_POSSIBLE_NAMES=Y",
                                                     "Z_POSSIBLE_NAMES=Z", nullptr};
    const bool is_csv = EQUAL(CPLGetExtension(path.c_str()), "csv");
    const GDALDatasetUniquePtr dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR, nullptr, is_csv ? open_options.data() : nullptr));
    OGRLayer* const layer = dataset ? dataset->GetLayer(0) : nullptr;
    if (layer == nullptr) {
        return {};
    }
    PointCollector collector;
    for (const auto& feature : *layer) {
        if (feature->GetGeometryRef() != nullptr) {
            feature->GetGeometryRef()->accept(&collector);
        }
    }
    std::vector<Point3> expected;
    for (std::uint32_t v = 0; v < face.tin.vertex_count(); ++v) {
        expected.push_back(written_position(face.tin, written, {v}));
    }
    Kept kept = compare(expected, collector.points, crs.is_geographic());
    kept.crs = Crs::from_gdal(layer->GetSpatialRef()).is_same(crs);
    return kept;
}

/// Writes a single face in memory and reads it back.
Kept probe(const ProbeFace& face, const Crs& crs, const TinDriver& driver, const std::string& target,
           const WriteTinOptions& options) {
    static std::atomic<int> count = 0;
    const std::string folder = "/vsimem/tinwright_probe_" + std::to_string(++count);
    const std::string path = folder + "/" + CPLGetFilename(target.c_str());
    WriteTinOptions quiet = options;
    quiet.progress = nullptr;
    quiet.origins = {};
    quiet.lines = {};
    quiet.is_water_face = {};
    quiet.positions = face.positions;
    quiet.ground = {};
    Kept kept;
    const GdalMessages messages;
    VSIMkdir(folder.c_str(), 0755);
    try {
        write_dataset(face.tin, crs, driver, path, target, quiet);
        kept = read_probe(path, face, crs, quiet);
    } catch (const Error&) {
        VSIRmdirRecursive(folder.c_str());
        throw;
    }
    VSIRmdirRecursive(folder.c_str());
    return kept;
}

std::string advice(Geometry geometry) {
    return geometry == Geometry::Tin ? "use --geometry polygon, or .gpkg, .shp, .fgb, .gml, .sqlite or .csv"
                                     : "use .gpkg, .shp, .fgb, .gml, .sqlite, .csv or .geojson";
}

void require_kept(const Kept& kept, const TinDriver& driver, Geometry geometry) {
    const std::string what = std::string(" with --geometry ") + word_for(geometry) + "; " + advice(geometry);
    if (!kept.opens) {
        throw UsageError("driver " + quoted(driver.name) + " cannot read back what it writes" + what);
    }
    if (!kept.geometry) {
        throw UsageError("driver " + quoted(driver.name) + " does not keep the geometries" + what);
    }
    if (!kept.elevations) {
        throw UsageError("driver " + quoted(driver.name) + " loses the elevations" + what);
    }
    if (!kept.positions) {
        throw UsageError("driver " + quoted(driver.name) + " moves the positions" + what);
    }
}

TriangleMesh one_face() {
    const std::array<VertexId, 3> corners = {VertexId{0}, VertexId{1}, VertexId{2}};
    return make_mesh(3, corners);
}

/// A face with decimals and unlike elevations, in the middle of a UTM zone.
Tin sample_face() {
    Tin tin;
    tin.lattice = Lattice::decimal(3, {500010125, 6700020250});
    tin.keys = {{0, 0}, {1500, 250}, {375, 1250}};
    tin.z = {1.7, -2.25, 103.5};
    tin.sample = {0, 1, 2};
    tin.mesh = one_face();
    return tin;
}

/// The first terrain face alone.
ProbeFace first_face(const Tin& tin, const WriteTinOptions& options) {
    ProbeFace probe{sample_face(), {}};
    Tin& face = probe.tin;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            face.lattice = tin.lattice;
            for (unsigned i = 0; i < 3; ++i) {
                const VertexId v = tin.mesh.vertex({f}, i);
                face.keys[i] = tin.key(v);
                face.z[i] = tin.z[v.value];
                if (!options.positions.empty()) {
                    probe.positions.push_back(options.positions[v.value]);
                }
            }
            break;
        }
    }
    return probe;
}

void check_options(const TinDriver& driver, const WriteTinOptions& options) {
    const auto refuse_malformed = [](const std::vector<std::string>& list, const char* option) {
        for (const std::string& text : list) {
            if (text.find('=') == std::string::npos || text.starts_with("=")) {
                throw UsageError(std::string(option) + " " + quoted(text) + ": expected KEY=VALUE");
            }
        }
    };
    refuse_malformed(options.creation_options, "--co");
    refuse_malformed(options.layer_options, "--lco");
    const std::string& name = options.layer_name;
    if (driver.has_layers &&
        (name == "vertices" || name == "constrained_edges" || name == "tinwright_metadata") &&
        name != default_layer(options.geometry)) {
        throw UsageError("layer name " + quoted(name) +
                         " is taken by another layer of the TIN; choose another");
    }
}

std::vector<std::string> warnings_for(const Tin& tin, const Kept& kept, const TinDriver& driver,
                                      const Crs& crs, const WriteTinOptions& options) {
    std::vector<std::string> warnings;
    const bool has_smooth_line = std::any_of(options.lines.begin(), options.lines.end(),
                                             [](const LineOrigin& line) { return !line.is_sharp; });
    if (has_smooth_line && !driver.has_layers && options.geometry != WriteTinOptions::Geometry::Edges) {
        warnings.push_back("driver " + quoted(driver.name) +
                           " does not keep which lines are smooth: read back, all are sharp");
    }
    if (has_water(options) && options.geometry == Geometry::Tin) {
        warnings.emplace_back(
            "with --geometry tin the file does not keep which faces are water: read back, smooth methods "
            "take "
            "them for terrain");
    }
    const bool has_river = std::any_of(options.lines.begin(), options.lines.end(),
                                       [](const LineOrigin& line) { return line.role == LineRole::River; });
    if (has_river && !driver.has_layers && options.geometry != Geometry::Edges) {
        warnings.push_back("driver " + quoted(driver.name) +
                           " does not keep which edges are rivers: rasters of the file do not follow them");
    }
    if (driver.significant_digits > 0 && needs_more_digits(tin, options, driver.significant_digits)) {
        warnings.push_back("driver " + quoted(driver.name) + " writes coordinates with " +
                           std::to_string(driver.significant_digits) +
                           " significant digits; some here have more");
    } else if (!kept.exact && driver.significant_digits == 0) {
        warnings.push_back("driver " + quoted(driver.name) + " rounds coordinates");
    }
    // A GeoJSON's other systems stand in its metadata.
    if (!kept.crs && driver.metadata != MetadataPlace::Member) {
        warnings.push_back("driver " + quoted(driver.name) + " does not keep the CRS " + crs.name());
    }
    return warnings;
}

}  // namespace

void check_tin_target(const std::string& target, const WriteTinOptions& options) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    check_options(driver, options);
    try {
        // With a projected CRS, drivers betray themselves that turn everything into longitude and latitude.
        const Crs projected = Crs::parse("EPSG:32635");
        require_kept(probe({sample_face(), {}}, projected, driver, target, options), driver,
                     options.geometry);
    } catch (const IoError& error) {
        throw UsageError("driver " + quoted(driver.name) + " cannot write such a TIN: " + error.what() +
                         "; " + advice(options.geometry));
    }
}

WrittenTin write_tin(const Tin& tin, const Crs& crs, const std::string& target,
                     const WriteTinOptions& options) {
    const TinDriver driver = find_tin_driver(target, options.driver);
    check_options(driver, options);
    AtomicOutput output(target, options.overwrite);
    const Kept kept = probe(first_face(tin, options), crs, driver, target, options);
    require_kept(kept, driver, options.geometry);
    report_progress(options.progress, 0);
    WrittenTin written = write_dataset(tin, crs, driver, output.path(), target, options);
    output.commit();
    report_progress(options.progress, 1);
    written.warnings = warnings_for(tin, kept, driver, crs, options);
    return written;
}

}  // namespace tinwright::io
