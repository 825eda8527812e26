#include "tinwright/io/preview.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <gdal_utils.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {

namespace {

constexpr int kLargestSide = 4096;  // cells

double slope_of(const Tin& tin, FaceId f) {
    const auto& v = tin.mesh.face(f).vertex;
    const Key2 a = tin.key(v[0]);
    const Key2 ab{tin.key(v[1]).x - a.x, tin.key(v[1]).y - a.y};
    const Key2 ac{tin.key(v[2]).x - a.x, tin.key(v[2]).y - a.y};
    const double ab_z = tin.z[v[1].value] - tin.z[v[0].value];
    const double ac_z = tin.z[v[2].value] - tin.z[v[0].value];
    const double area = ab.x * ac.y - ab.y * ac.x;
    return std::hypot(ab_z * ac.y - ac_z * ab.y, ac_z * ab.x - ab_z * ac.x) / (area * tin.lattice.quantum());
}

GDALDatasetUniquePtr open_reduced(const std::string& elevations) {
    GDALDatasetUniquePtr source(
        GDALDataset::Open(elevations.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
    if (source == nullptr) {
        return nullptr;
    }
    const int side = std::max(source->GetRasterXSize(), source->GetRasterYSize());
    if (side <= kLargestSide) {
        return source;
    }
    const double share = static_cast<double>(kLargestSide) / side;
    CPLStringList arguments;
    arguments.AddString("-of");
    arguments.AddString("MEM");
    arguments.AddString("-outsize");
    arguments.AddString(CPLSPrintf("%d", std::max(1, static_cast<int>(source->GetRasterXSize() * share))));
    arguments.AddString(CPLSPrintf("%d", std::max(1, static_cast<int>(source->GetRasterYSize() * share))));
    GDALTranslateOptions* const options = GDALTranslateOptionsNew(arguments.List(), nullptr);
    GDALDatasetUniquePtr reduced(
        GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(source.get()), options, nullptr)));
    GDALTranslateOptionsFree(options);
    return reduced;
}

}  // namespace

double choose_z_factor(const Tin& tin) {
    std::vector<double> slopes;
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (tin.mesh.is_terrain({f})) {
            const double slope = slope_of(tin, {f});
            if (std::isfinite(slope)) {
                slopes.push_back(slope);
            }
        }
    }
    if (slopes.empty()) {
        return 1;
    }
    const auto steep = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() * 9 / 10);
    std::nth_element(slopes.begin(), steep, slopes.end());
    if (!(*steep > 0)) {
        return 1;
    }
    const double wanted = 0.5 / *steep;
    double best = 1;
    for (int exponent = -3; exponent <= 3; ++exponent) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double factor = digit * std::pow(10.0, exponent);
            if (factor <= 1000 && std::abs(std::log(factor / wanted)) < std::abs(std::log(best / wanted))) {
                best = factor;
            }
        }
    }
    return best;
}

void check_preview_target(const std::string& preview) {
    if (!EQUAL(CPLGetExtension(preview.c_str()), "png")) {
        throw UsageError("--preview " + quoted(preview) + " must be a PNG file; give it the extension .png");
    }
}

void write_preview(const std::string& elevations, const std::string& path, const std::string& target,
                   double z_factor) {
    register_drivers();
    const GdalMessages messages;
    const auto fail = [&]() {
        throw IoError("cannot write the preview " + quoted(target) + messages.suffix());
    };
    const GDALDatasetUniquePtr source = open_reduced(elevations);
    if (source == nullptr) {
        fail();
        return;
    }
    CPLStringList arguments;
    for (const char* const argument : {"-of", "PNG", "-compute_edges", "-z"}) {
        arguments.AddString(argument);
    }
    arguments.AddString(CPLSPrintf("%.3g", z_factor));
    GDALDEMProcessingOptions* const options = GDALDEMProcessingOptionsNew(arguments.List(), nullptr);
    // A picture, not data: no side-car file.
    const CPLConfigOptionSetter no_side_car("GDAL_PAM_ENABLED", "NO", false);
    GDALDatasetH shaded = GDALDEMProcessing(path.c_str(), GDALDataset::ToHandle(source.get()), "hillshade",
                                            nullptr, options, nullptr);
    GDALDEMProcessingOptionsFree(options);
    if (shaded == nullptr) {
        fail();
    }
    GDALClose(shaded);
    if (!messages.last_error().empty()) {
        fail();
    }
}

}  // namespace tinwright::io
