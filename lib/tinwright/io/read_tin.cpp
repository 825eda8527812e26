#include "tinwright/io/read_tin.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include <cpl_string.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/io/axis_order.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/tin_layers.hpp"
#include "tinwright/io/tin_source.hpp"
#include "tinwright/io/tin_triangles.hpp"

namespace tinwright::io {
namespace {

/// The fields of a layer of edges that tell which line an edge is part of; -1: not there.
struct LineFields {
    explicit LineFields(const OGRFeatureDefn& definition)
        : role(definition.GetFieldIndex("role")),
          source(definition.GetFieldIndex("source")),
          feature(definition.GetFieldIndex("feature")),
          sharp(definition.GetFieldIndex("sharp")) {}

    /// The line, if the feature is part of one.
    [[nodiscard]] std::optional<LineOrigin> read(const OGRFeature& edge) const {
        if (role < 0) {
            return std::nullopt;
        }
        const std::string word = edge.GetFieldAsString(role);
        LineOrigin line;
        for (const LineRole known : {LineRole::Breakline, LineRole::Boundary, LineRole::Hole, LineRole::Lake,
                                     LineRole::Bank, LineRole::River, LineRole::Section}) {
            if (word == role_name(known)) {
                line.role = known;
                line.is_sharp = !is_set(edge, sharp) || edge.GetFieldAsInteger(sharp) != 0;
                line.source = is_set(edge, source) ? edge.GetFieldAsInteger(source) : 0;
                line.feature = is_set(edge, feature) ? edge.GetFieldAsInteger64(feature) : -1;
                return line;
            }
        }
        return std::nullopt;
    }

    int role;
    int source;
    int feature;
    int sharp;

  private:
    static bool is_set(const OGRFeature& edge, int field) {
        return field >= 0 && edge.IsFieldSetAndNotNull(field);
    }
};

/// Reads the layers of one TIN into a TinFile.
class TinFileReader {
  public:
    TinFileReader(TinSource& source, OGRLayer& faces, const Progress& progress)
        : source_(source), faces_(faces), progress_(progress) {}

    TinFile read() {
        file_.layer = faces_.GetName();
        file_.metadata = source_.metadata(faces_);
        file_.crs = source_.crs(faces_, file_.metadata);
        file_.is_north_first = is_north_first(faces_.GetSpatialRef());
        read_faces();
        if (OGRLayer* const vertices = source_.find_companion(faces_, "vertices")) {
            read_vertices(*vertices);
        }
        if (OGRLayer* const edges = source_.find_companion(faces_, "constrained_edges")) {
            read_constrained_edges(*edges);
        }
        file_.vertices = table_.take();
        if (std::any_of(marks_.begin(), marks_.end(), [](unsigned char mark) { return mark != 0; })) {
            add_marked_edges();
        }
        std::erase_if(file_.metadata, [](const auto& item) { return item.first == "TINWRIGHT_CRS"; });
        return std::move(file_);
    }

  private:
    void read_faces();
    void read_vertices(OGRLayer& layer);
    void read_constrained_edges(OGRLayer& layer);
    void add_marked_edges();
    std::optional<std::uint32_t> number_line(const std::optional<LineOrigin>& line);
    // Leaves out the attributes that nobody looks at: half of the reading time.
    static void keep_fields(OGRLayer& layer, std::initializer_list<const char*> names);

    TinSource& source_;
    OGRLayer& faces_;
    const Progress& progress_;
    TinFile file_;
    VertexTable table_;
    std::vector<unsigned char> marks_;  // one a face where the file has the field, else empty
    std::map<std::tuple<LineRole, bool, std::int32_t, std::int64_t>, std::uint32_t> line_numbers_;
};

void TinFileReader::keep_fields(OGRLayer& layer, std::initializer_list<const char*> names) {
    if (layer.TestCapability(OLCIgnoreFields) == FALSE) {
        return;
    }
    CPLStringList ignored;
    OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int i = 0; i < definition.GetFieldCount(); ++i) {
        const char* const name = definition.GetFieldDefn(i)->GetNameRef();
        const bool is_kept =
            std::any_of(names.begin(), names.end(), [&](const char* kept) { return EQUAL(kept, name); });
        if (!is_kept) {
            ignored.AddString(name);
        }
    }
    static_cast<void>(layer.SetIgnoredFields(const_cast<const char**>(ignored.List())));
}

void TinFileReader::read_faces() {
    const int mark_field = faces_.GetLayerDefn()->GetFieldIndex("constr");
    const int water_field = faces_.GetLayerDefn()->GetFieldIndex("water");
    keep_fields(faces_, {"constr", "water"});
    const GIntBig expected = faces_.GetFeatureCount(FALSE);
    if (expected > 0) {
        file_.face_ids.reserve(static_cast<std::size_t>(expected));
        file_.corners.reserve(3 * static_cast<std::size_t>(expected));
    }
    CPLErrorReset();
    std::vector<Triangle> triangles;
    GIntBig count = 0;
    faces_.ResetReading();
    for (OGRFeatureUniquePtr feature(faces_.GetNextFeature()); feature;
         feature.reset(faces_.GetNextFeature())) {
        triangles.clear();
        if (const auto problem = append_triangles(feature->GetGeometryRef(), triangles)) {
            throw InputError(
                source_.describe(faces_) + ", feature " + std::to_string(feature->GetFID()) + ": " +
                *problem + "; a TIN has closed triangles with z only (read something else with as=samples)");
        }
        for (const Triangle& triangle : triangles) {
            for (const Point3& corner : triangle) {
                file_.corners.push_back(table_.insert(corner));
            }
            file_.face_ids.push_back(feature->GetFID());
            if (mark_field >= 0) {
                marks_.push_back(static_cast<unsigned char>(feature->GetFieldAsInteger(mark_field) & 7));
            }
            if (water_field >= 0) {
                file_.is_water.push_back(feature->GetFieldAsInteger(water_field) != 0);
            }
        }
        if (++count % 4096 == 0) {
            report_progress(progress_, expected > count
                                           ? static_cast<double>(count) / static_cast<double>(expected)
                                           : 1.0);
        }
    }
    if (CPLGetLastErrorType() >= CE_Failure) {
        source_.refuse_filter(faces_);  // some drivers look at it only now
        throw IoError("cannot read " + source_.describe(faces_) + source_.suffix());
    }
    if (file_.face_ids.empty()) {
        throw InputError(source_.describe(faces_) + ": no faces");
    }
}

void TinFileReader::read_vertices(OGRLayer& layer) {
    const OGRFeatureDefn& definition = *layer.GetLayerDefn();
    const int steiner = definition.GetFieldIndex("steiner");
    const int source = definition.GetFieldIndex("source");
    const int feature_id = definition.GetFieldIndex("feature");
    const int crossing = definition.GetFieldIndex("crossing");
    const int inserted = definition.GetFieldIndex("inserted");
    if (wkbFlatten(layer.GetGeomType()) != wkbPoint || steiner < 0) {
        return;  // somebody else's layer of that name
    }
    VertexOrigins origins;
    bool has_source = false;
    bool has_feature = false;
    for (const auto& feature : layer) {
        const OGRGeometry* const geometry = feature->GetGeometryRef();
        if (geometry == nullptr || wkbFlatten(geometry->getGeometryType()) != wkbPoint) {
            continue;
        }
        const OGRPoint& point = *geometry->toPoint();
        const std::size_t v = table_.insert({point.getX(), point.getY(), point.getZ()});
        const std::size_t size = table_.points().size();
        file_.is_steiner.resize(size);
        origins.source.resize(size);
        origins.feature.resize(size, -1);
        file_.is_crossing.resize(size);
        file_.is_inserted.resize(size);
        file_.is_steiner[v] = feature->GetFieldAsInteger(steiner) != 0;
        file_.is_crossing[v] = crossing >= 0 && feature->GetFieldAsInteger(crossing) != 0;
        file_.is_inserted[v] = inserted >= 0 && feature->GetFieldAsInteger(inserted) != 0;
        if (source >= 0 && feature->IsFieldSetAndNotNull(source)) {
            origins.source[v] = feature->GetFieldAsInteger(source);
            has_source = true;
        }
        if (feature_id >= 0 && feature->IsFieldSetAndNotNull(feature_id)) {
            origins.feature[v] = feature->GetFieldAsInteger64(feature_id);
            has_feature = true;
        }
    }
    if (has_source) {
        file_.origins.source = std::move(origins.source);
    }
    if (has_feature) {
        file_.origins.feature = std::move(origins.feature);
    }
}

void TinFileReader::read_constrained_edges(OGRLayer& layer) {
    const LineFields fields(*layer.GetLayerDefn());
    if (!marks_.empty() && fields.role < 0) {
        return;  // the faces say the same
    }
    for (const auto& feature : layer) {
        const OGRGeometry* const geometry = feature->GetGeometryRef();
        if (geometry == nullptr || wkbFlatten(geometry->getGeometryType()) != wkbLineString) {
            continue;
        }
        const std::optional<std::uint32_t> line_number = number_line(fields.read(*feature));
        const OGRLineString& line = *geometry->toLineString();
        for (int i = 0; i + 1 < line.getNumPoints(); ++i) {
            const auto a = table_.find({line.getX(i), line.getY(i), line.getZ(i)});
            const auto b = table_.find({line.getX(i + 1), line.getY(i + 1), line.getZ(i + 1)});
            if (!a || !b || *a == *b) {
                throw InputError(source_.describe(layer) + ", feature " + std::to_string(feature->GetFID()) +
                                 ": an end is not a vertex of the faces");
            }
            const auto [first, second] = std::minmax(*a, *b);
            file_.constrained_edges.emplace_back(first, second);
            if (line_number) {
                file_.line_edges.push_back({first, second, *line_number});
            }
        }
    }
    std::sort(file_.constrained_edges.begin(), file_.constrained_edges.end());
    std::sort(file_.line_edges.begin(), file_.line_edges.end());
}

std::optional<std::uint32_t> TinFileReader::number_line(const std::optional<LineOrigin>& line) {
    if (!line) {
        return std::nullopt;
    }
    const auto key = std::tuple(line->role, line->is_sharp, line->source, line->feature);
    const auto [place, is_new] =
        line_numbers_.try_emplace(key, static_cast<std::uint32_t>(file_.lines.size()));
    if (is_new) {
        file_.lines.push_back(*line);
    }
    return place->second;
}

// The marks count from the ring's first vertex, counter-clockwise; Shapefiles turn rings the other way.
void TinFileReader::add_marked_edges() {
    const Lattice lattice = find_lattice(file_.vertices).lattice;
    const auto key = [&](std::uint32_t v) { return lattice.key({file_.vertices[v].x, file_.vertices[v].y}); };
    for (std::size_t f = 0; f < marks_.size(); ++f) {
        if (marks_[f] == 0) {
            continue;
        }
        std::array<std::uint32_t, 3> v = {file_.corners[3 * f], file_.corners[3 * f + 1],
                                          file_.corners[3 * f + 2]};
        if (orient2d(key(v[0]), key(v[1]), key(v[2])) < 0) {
            std::swap(v[1], v[2]);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if ((marks_[f] >> i & 1U) != 0) {
                file_.constrained_edges.emplace_back(std::minmax(v[i], v[(i + 1) % 3]));
            }
        }
    }
    auto& edges = file_.constrained_edges;
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

}  // namespace

bool is_tin(const Source& source) {
    if (source.as != Source::Kind::Auto) {
        return source.as == Source::Kind::Tin;
    }
    const bool is_for_samples = source.vertices || source.format != Source::Format::Auto || source.x_field ||
                                source.y_field || source.band || source.stride ||
                                (source.z && *source.z != "geometry");
    // A stream can be read once: whoever means a TIN there says so with as=tin.
    if (is_for_samples || source.path.starts_with("/vsistdin")) {
        return false;
    }
    TinSource file(source);
    return file.is_open() && file.find_faces() != nullptr;
}

TinFile read_tin_file(const Source& source, const Progress& progress) {
    TinSource file(source);
    if (!file.is_open()) {
        throw IoError("cannot read " + io::quoted(source.path) + " as a TIN: it is not a vector file" +
                      file.suffix());
    }
    OGRLayer* const faces = file.find_faces();
    if (faces == nullptr) {
        throw InputError(
            io::quoted(source.path) +
            (source.layer ? ", layer " + io::quoted(*source.layer) : std::string()) +
            " is no TIN: there is no layer of closed triangles with z; its layers: " + file.layer_names());
    }
    return TinFileReader(file, *faces, progress).read();
}

}  // namespace tinwright::io
