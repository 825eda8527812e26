#include "tinwright/io/write_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/tin_drivers.hpp"
#include "tinwright/io/vector_layer.hpp"

namespace tinwright::io {
namespace {

using Curve = std::vector<Point3>;
using Curves = std::vector<Curve>;

bool has_z(const Curve& curve) {
    return std::any_of(curve.begin(), curve.end(), [](const Point3& point) { return !std::isnan(point.z); });
}

void fill(OGRSimpleCurve& to, const Curve& from, bool is_3d) {
    to.setNumPoints(static_cast<int>(from.size()), FALSE);
    if (is_3d) {
        to.set3D(TRUE);
    }
    for (int i = 0; i < to.getNumPoints(); ++i) {
        const Point3& point = from[static_cast<std::size_t>(i)];
        if (is_3d) {
            to.setPoint(i, point.x, point.y, point.z);
        } else {
            to.setPoint(i, point.x, point.y);
        }
    }
}

/// Builds the geometry of one feature anew, curve after curve.
class GeometryChanger {
  public:
    GeometryChanger(const ChangedLines& lines, std::int64_t feature) : lines_(lines), feature_(feature) {}

    /// Null when nothing remains. Three-dimensional where any point has z.
    std::unique_ptr<OGRGeometry> change(const OGRGeometry& geometry) {
        collect(geometry);
        const std::size_t kinds =
            static_cast<std::size_t>(!open_.empty()) + static_cast<std::size_t>(!polygons_.empty());
        if (kinds == 0) {
            return nullptr;
        }
        if (kinds == 2) {
            auto all = std::make_unique<OGRGeometryCollection>();
            add_lines(*all);
            add_polygons(*all);
            return all;
        }
        const bool was_multi =
            OGR_GT_IsSubClassOf(wkbFlatten(geometry.getGeometryType()), wkbGeometryCollection) != 0;
        return open_.empty() ? simplest<OGRMultiPolygon>(was_multi) : simplest<OGRMultiLineString>(was_multi);
    }

  private:
    void collect(const OGRGeometry& geometry);
    void collect_polygon(const OGRPolygon& polygon);
    [[nodiscard]] const Curves& next_curve() {
        static const Curves nothing;
        const auto found = lines_.curves.find({feature_, next_++});
        return found == lines_.curves.end() ? nothing : found->second;
    }
    [[nodiscard]] bool is_3d() const {
        const auto any_z = [](const Curves& curves) {
            return std::any_of(curves.begin(), curves.end(), has_z);
        };
        return any_z(open_) || std::any_of(polygons_.begin(), polygons_.end(), any_z);
    }
    void add_lines(OGRGeometryCollection& to) const {
        for (const Curve& curve : open_) {
            auto line = std::make_unique<OGRLineString>();
            fill(*line, curve, is_3d());
            to.addGeometryDirectly(line.release());  // takes it over
        }
    }
    void add_polygons(OGRGeometryCollection& to) const {
        for (const Curves& rings : polygons_) {
            auto polygon = std::make_unique<OGRPolygon>();
            for (const Curve& curve : rings) {
                auto ring = std::make_unique<OGRLinearRing>();
                fill(*ring, curve, is_3d());
                polygon->addRingDirectly(ring.release());  // takes it over
            }
            to.addGeometryDirectly(polygon.release());  // takes it over
        }
    }
    template <class Multi>
    std::unique_ptr<OGRGeometry> simplest(bool is_multi) const {
        auto all = std::make_unique<Multi>();
        add_lines(*all);
        add_polygons(*all);
        if (!is_multi && all->getNumGeometries() == 1) {
            return std::unique_ptr<OGRGeometry>(all->getGeometryRef(0)->clone());
        }
        return all;
    }

    const ChangedLines& lines_;
    std::int64_t feature_;
    std::uint32_t next_ = 0;
    Curves open_;
    std::vector<Curves> polygons_;
};

void GeometryChanger::collect_polygon(const OGRPolygon& polygon) {
    Curves rings;
    bool has_outer = false;
    bool is_outer = true;
    for (const OGRLinearRing* const ring : polygon) {
        static_cast<void>(ring);
        const Curves& parts = next_curve();
        has_outer = has_outer || (is_outer && !parts.empty());
        is_outer = false;
        rings.insert(rings.end(), parts.begin(), parts.end());
    }
    if (has_outer) {
        polygons_.push_back(std::move(rings));
    }
}

void GeometryChanger::collect(const OGRGeometry& geometry) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    const auto collect_all = [&](const auto& parts) {
        for (const auto* const part : parts) {
            collect(*part);
        }
    };
    if (type == wkbLineString) {
        const Curves& parts = next_curve();
        open_.insert(open_.end(), parts.begin(), parts.end());
    } else if (type == wkbPolygon || type == wkbTriangle) {
        collect_polygon(*geometry.toPolygon());
    } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != 0) {
        collect_all(*geometry.toGeometryCollection());
    } else if (OGR_GT_IsSubClassOf(type, wkbPolyhedralSurface) != 0) {
        collect_all(*geometry.toPolyhedralSurface());
    }
}

/// A source opened once more.
struct OpenedLayer {
    explicit OpenedLayer(const Source& source)
        : opened(open_source(source)),
          layer(*opened.dataset, source, "file " + quoted(source.path),
                {[](OGRLayer& candidate) {
                     const OGRwkbGeometryType type = wkbFlatten(candidate.GetGeomType());
                     return type != wkbNone && type != wkbPoint && type != wkbMultiPoint;
                 },
                 "no layer has lines or polygons", "several layers may have lines", ""}) {}

    OpenedSource opened;
    VectorLayer layer;
};

/// The features of a layer with their new geometries.
struct ChangedFeatures {
    std::vector<OGRFeatureUniquePtr> features;
    OGRwkbGeometryType type = wkbUnknown;  ///< that holds them all
    std::size_t left_out = 0;
};

OGRwkbGeometryType type_of_parts(OGRwkbGeometryType type) {
    return type == wkbMultiLineString ? wkbLineString : type == wkbMultiPolygon ? wkbPolygon : type;
}

/// Lines become multi-lines, and polygons multi-polygons, where one of them is; 2-D is kept where all are.
void unite_types(ChangedFeatures& changed) {
    std::optional<OGRwkbGeometryType> single;
    bool is_multi = false;
    bool is_3d = false;
    bool is_mixed = false;
    for (const OGRFeatureUniquePtr& feature : changed.features) {
        const OGRwkbGeometryType type = feature->GetGeometryRef()->getGeometryType();
        const OGRwkbGeometryType flat = wkbFlatten(type);
        const OGRwkbGeometryType part = type_of_parts(flat);
        is_multi = is_multi || part != flat;
        is_3d = is_3d || OGR_GT_HasZ(type) != 0;
        is_mixed = is_mixed || flat == wkbGeometryCollection || (single && *single != part);
        single = part;
    }
    if (!single || is_mixed) {
        changed.type = wkbUnknown;
    } else {
        changed.type = is_multi ? OGR_GT_GetCollection(*single) : *single;
    }
    if (is_3d) {
        changed.type = OGR_GT_SetZ(changed.type);
    }
    for (const OGRFeatureUniquePtr& feature : changed.features) {
        if (is_multi && !is_mixed) {
            OGRGeometry* const geometry = feature->StealGeometry();
            const OGRwkbGeometryType type = OGR_GT_Flatten(changed.type);
            // The type says whether z is kept, too.
            feature->SetGeometryDirectly(
                OGRGeometryFactory::forceTo(geometry, geometry->Is3D() != 0 ? OGR_GT_SetZ(type) : type));
        }
    }
}

ChangedFeatures change_features(const ChangedLines& lines, OpenedLayer& from) {
    const GdalMessages messages;
    ChangedFeatures changed;
    OGRLayer& layer = from.layer.layer();
    layer.ResetReading();
    bool any = false;
    for (OGRFeatureUniquePtr feature(layer.GetNextFeature()); feature;
         feature.reset(layer.GetNextFeature())) {
        any = true;
        const OGRGeometry* const old = feature->GetGeometryRef();
        std::unique_ptr<OGRGeometry> geometry;
        if (old != nullptr) {
            const std::unique_ptr<OGRGeometry> linear(old->getLinearGeometry());
            geometry = GeometryChanger(lines, feature->GetFID()).change(linear ? *linear : *old);
        }
        if (!geometry) {
            ++changed.left_out;
            continue;
        }
        feature->SetGeometryDirectly(geometry.release());  // takes it over
        changed.features.push_back(std::move(feature));
    }
    from.layer.require_no_error(messages, any);
    unite_types(changed);
    return changed;
}

/// A name that no field of the layer has.
std::string free_name(OGRFeatureDefn& definition, const std::string& wanted) {
    std::string name = wanted;
    for (int i = 2; definition.GetFieldIndex(name.c_str()) >= 0; ++i) {
        name = wanted + "_" + std::to_string(i);
    }
    return name;
}

/// A GeoPackage being written; every failure an IoError.
class GeoPackage {
  public:
    GeoPackage(const std::string& path, std::string target) : target_(std::move(target)) {
        if (const char* const date = CPLGetThreadLocalConfigOption(kDateOption, nullptr)) {
            former_date_ = date;
        }
        CPLSetThreadLocalConfigOption(kDateOption, "2000-01-01T00:00:00.000Z");
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
        if (driver == nullptr) {
            throw IoError("cannot write " + quoted(target_) + ": this GDAL has no driver GPKG");
        }
        dataset_.reset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
        require(dataset_ != nullptr, "creating it");
        require(dataset_->StartTransaction() == OGRERR_NONE, "creating it");
    }
    ~GeoPackage() {
        if (dataset_) {
            dataset_->RollbackTransaction();
        }
        dataset_.reset();
        CPLSetThreadLocalConfigOption(kDateOption, former_date_ ? former_date_->c_str() : nullptr);
    }
    GeoPackage(const GeoPackage&) = delete;
    GeoPackage& operator=(const GeoPackage&) = delete;

    void write(const std::string& name, OGRLayer& from, const ChangedFeatures& changed, const Crs& crs);
    void close() {
        CPLErrorReset();
        const bool is_committed = dataset_->CommitTransaction() == OGRERR_NONE;
        dataset_->FlushCache(true);
        dataset_.reset();
        require(is_committed && CPLGetLastErrorType() < CE_Failure, "closing it");
    }

  private:
    static constexpr const char* kDateOption = "OGR_CURRENT_DATE";  // pinned: same lines, same bytes

    void require(bool is_done, const std::string& what) const {
        if (!is_done) {
            const std::string suffix = messages_.suffix();
            throw IoError("cannot write " + quoted(target_) + ", " + what +
                          (suffix.empty() ? "; is the disk full?" : suffix));
        }
    }

    std::string target_;
    GdalMessages messages_;
    std::optional<std::string> former_date_;
    GDALDatasetUniquePtr dataset_;
};

void GeoPackage::write(const std::string& name, OGRLayer& from, const ChangedFeatures& changed,
                       const Crs& crs) {
    OGRFeatureDefn& old = *from.GetLayerDefn();
    CPLStringList options;
    options.SetNameValue("FID", free_name(old, "fid").c_str());
    options.SetNameValue("GEOMETRY_NAME", free_name(old, "geom").c_str());
    const OGRSpatialReference* const system = crs.is_known() ? crs.gdal() : &undefined_cartesian_system();
    // The driver keeps a reference; it does not change the system, but its signature may.
    OGRLayer* const layer = dataset_->CreateLayer(name.c_str(), const_cast<OGRSpatialReference*>(system),
                                                  changed.type, options.List());
    require(layer != nullptr, "layer " + quoted(name));
    std::vector<int> map(static_cast<std::size_t>(old.GetFieldCount()), -1);
    for (int i = 0; i < old.GetFieldCount(); ++i) {
        if (layer->CreateField(old.GetFieldDefn(i), TRUE) == OGRERR_NONE) {
            map[static_cast<std::size_t>(i)] = layer->GetLayerDefn()->GetFieldCount() - 1;
        }
    }
    for (const OGRFeatureUniquePtr& feature : changed.features) {
        OGRFeature copy(layer->GetLayerDefn());
        copy.SetFrom(feature.get(), map.data(), TRUE);
        copy.SetFID(feature->GetFID());
        require(layer->CreateFeature(&copy) == OGRERR_NONE,
                "layer " + quoted(name) + ", feature " + std::to_string(feature->GetFID()));
    }
}

}  // namespace

std::vector<WrittenLines> write_changed_lines(std::span<const ChangedLines> layers, const Crs& crs,
                                              const std::string& target, bool overwrite) {
    register_drivers();
    AtomicOutput output(target, overwrite);
    std::vector<WrittenLines> written;
    {
        GeoPackage file(output.path(), target);
        for (const ChangedLines& lines : layers) {
            OpenedLayer from(lines.source);
            const ChangedFeatures changed = change_features(lines, from);
            file.write(lines.name, from.layer.layer(), changed, crs);
            written.push_back({lines.name, changed.features.size(), changed.left_out});
        }
        file.close();
    }
    output.commit();
    return written;
}

}  // namespace tinwright::io
