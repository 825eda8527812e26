#include "checked_surface.hpp"

#include <memory>
#include <numeric>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

/// Stable names of the defects: keys of the JSON report and values of the layer's field `kind`.
std::string key_of(FaceDefect defect) {
    switch (defect) {
        case FaceDefect::NotFinite:
            return "not_finite";
        case FaceDefect::ZeroArea:
            return "zero_area";
        case FaceDefect::Clockwise:
            return "clockwise";
        case FaceDefect::Repeated:
            return "repeated";
        case FaceDefect::SharedEdge:
            return "shared_edge";
        case FaceDefect::Crack:
            return "crack";
        case FaceDefect::VertexOnEdge:
            return "vertex_on_edge";
        case FaceDefect::Overlap:
            return "overlap";
    }
    return {};
}

JsonValue violation_json(const CheckedSurface& surface, const FaceViolation& violation) {
    const Point3& at = violation.location;
    JsonValue json = JsonValue::object();
    json.set("kind", key_of(violation.defect)).set("face", surface.face_ids[violation.face]);
    if (violation.other != FaceViolation::kNoFace) {
        json.set("other", surface.face_ids[violation.other]);
    }
    return json.set("location", JsonValue::array_of({at.x, at.y, at.z}));
}

struct CloseDataset {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPointer = std::unique_ptr<GDALDataset, CloseDataset>;

/// The driver asked for, or the first that writes vector files with the target's extension.
GDALDriver& find_driver(const std::string& target, const std::string& name) {
    if (!name.empty()) {
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(name.c_str());
        if (driver == nullptr || driver->GetMetadataItem(GDAL_DCAP_VECTOR) == nullptr) {
            throw UsageError("--of " + io::quoted(name) + " is no vector driver of GDAL here");
        }
        return *driver;
    }
    const std::string extension = CPLGetExtension(target.c_str());
    for (int i = 0; i < GetGDALDriverManager()->GetDriverCount() && !extension.empty(); ++i) {
        GDALDriver* const driver = GetGDALDriverManager()->GetDriver(i);
        const CPLStringList extensions(
            CSLTokenizeString2(driver->GetMetadataItem(GDAL_DMD_EXTENSIONS), " ", 0));
        if (driver->GetMetadataItem(GDAL_DCAP_VECTOR) != nullptr &&
            driver->GetMetadataItem(GDAL_DCAP_CREATE) != nullptr &&
            extensions.FindString(extension.c_str()) >= 0) {
            return *driver;
        }
    }
    throw UsageError("no vector driver is known for " + io::quoted(target) +
                     ": use an extension such as .gpkg, or name the driver with --of");
}

[[noreturn]] void cannot_write(const std::string& target, const io::GdalMessages& messages) {
    throw IoError("cannot write violations to " + io::quoted(target) + messages.suffix());
}

void add_fields(OGRLayer& layer, const std::string& target, const io::GdalMessages& messages) {
    OGRFieldDefn surface("surface", OFTInteger);
    OGRFieldDefn kind("kind", OFTString);
    OGRFieldDefn face("face", OFTInteger64);
    OGRFieldDefn other("other", OFTInteger64);
    for (OGRFieldDefn* field : {&surface, &kind, &face, &other}) {
        if (layer.CreateField(field) != OGRERR_NONE) {
            cannot_write(target, messages);
        }
    }
}

bool add_feature(OGRLayer& layer, const CheckedSurface& surface, int number, const FaceViolation& violation) {
    OGRFeature feature(layer.GetLayerDefn());
    feature.SetField(0, number);
    feature.SetField(1, key_of(violation.defect).c_str());
    feature.SetField(2, static_cast<GIntBig>(surface.face_ids[violation.face]));
    if (violation.other != FaceViolation::kNoFace) {
        feature.SetField(3, static_cast<GIntBig>(surface.face_ids[violation.other]));
    }
    const OGRPoint point(violation.location.x, violation.location.y, violation.location.z);
    return feature.SetGeometry(&point) == OGRERR_NONE && layer.CreateFeature(&feature) == OGRERR_NONE;
}

}  // namespace

std::size_t CheckedSurface::violation_count() const {
    return std::accumulate(report.counts.begin(), report.counts.end(), std::size_t{0});
}

std::string violation_lines(const CheckedSurface& surface) {
    std::string lines;
    for (const FaceViolation& violation : surface.report.violations) {
        const Point3& at = violation.location;
        lines += surface.file + ": face " + std::to_string(surface.face_ids[violation.face]) + ": " +
                 std::string(text_of(violation.defect));
        if (violation.other != FaceViolation::kNoFace) {
            lines += ", with face " + std::to_string(surface.face_ids[violation.other]);
        }
        lines += " at (" + number_text(at.x) + ", " + number_text(at.y) + ")";
        if (violation.defect == FaceDefect::Crack) {
            lines += ", z " + number_text(at.z) + " and " + number_text(violation.other_z);
        }
        lines += "\n";
    }
    const std::size_t unlisted = surface.violation_count() - surface.report.violations.size();
    if (unlisted > 0) {
        lines += surface.file + ": and " + std::to_string(unlisted) + " more of these kinds\n";
    }
    return lines;
}

std::string verdict_line(const CheckedSurface& surface) {
    const std::size_t count = surface.violation_count();
    const std::string faces =
        std::to_string(surface.face_ids.size()) + (surface.face_ids.size() == 1 ? " face" : " faces");
    return surface.file + ": " +
           (count == 0 ? "clean, " + faces
                       : std::to_string(count) + (count == 1 ? " violation in " : " violations in ") + faces);
}

JsonValue checked_json(std::span<const CheckedSurface> surfaces, const std::vector<std::string>& outputs) {
    JsonValue list = JsonValue::array();
    std::size_t total = 0;
    for (const CheckedSurface& surface : surfaces) {
        JsonValue counts = JsonValue::object();
        for (std::size_t i = 0; i < kFaceDefects; ++i) {
            counts.set(key_of(static_cast<FaceDefect>(i)), surface.report.counts[i]);
        }
        JsonValue violations = JsonValue::array();
        for (const FaceViolation& violation : surface.report.violations) {
            violations.append(violation_json(surface, violation));
        }
        total += surface.violation_count();
        list.append(JsonValue::object()
                        .set("file", surface.file)
                        .set("layer", surface.layer)
                        .set("vertices", surface.vertices)
                        .set("faces", surface.face_ids.size())
                        .set("counts", counts)
                        .set("violations", violations));
    }
    JsonValue json = JsonValue::object();
    json.set("version", TINWRIGHT_VERSION).set("command", "check").set("clean", total == 0);
    return json.set("violations", total).set("surfaces", list).set("outputs", JsonValue::array_of(outputs));
}

void write_violations(std::span<const CheckedSurface> surfaces, const std::string& target,
                      const ViolationLayerOptions& options) {
    io::register_drivers();
    const io::GdalMessages messages;
    GDALDriver& driver = find_driver(target, options.driver);
    io::AtomicOutput output(target, options.overwrite);
    DatasetPointer dataset(driver.Create(output.path().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!dataset) {
        cannot_write(target, messages);
    }
    const io::Crs crs = surfaces.empty() ? io::Crs() : surfaces.front().crs;
    std::unique_ptr<OGRSpatialReference> system(crs.is_known() ? crs.gdal()->Clone() : nullptr);
    OGRLayer* const layer = dataset->CreateLayer("violations", system.get(), wkbPoint25D, nullptr);
    if (layer == nullptr) {
        cannot_write(target, messages);
    }
    add_fields(*layer, target, messages);
    const bool in_transaction = dataset->StartTransaction() == OGRERR_NONE;
    int number = 0;
    for (const CheckedSurface& surface : surfaces) {
        ++number;
        for (const FaceViolation& violation : surface.report.violations) {
            if (!add_feature(*layer, surface, number, violation)) {
                cannot_write(target, messages);
            }
        }
    }
    if (in_transaction && dataset->CommitTransaction() != OGRERR_NONE) {
        cannot_write(target, messages);
    }
    dataset.reset();
    output.commit();
}

}  // namespace tinwright::tools
