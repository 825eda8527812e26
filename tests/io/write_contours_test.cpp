#include "tinwright/io/write_contours.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "support/cases.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"
#include "surface/contour_pieces.hpp"

using namespace tinwright;
using namespace tinwright::io;
using namespace tinwright_tests;

namespace {

/// A hill of 3 with a shoulder, and its levels.
Tin hill() {
    return tin_of_samples({{600000, 5700000, 0},
                           {600004.5, 5700000, 0},
                           {600004.5, 5700004.1, 0.5},
                           {600000, 5700004.1, 0},
                           {600002.1, 5700002.3, 3}});
}

const std::vector<double> kElevations{0.5, 1.5, 2.75};
const std::vector<ContourLevel> kLevels{{0.5, true}, {1.5, false}, {2.75, false}};

const char* const kFormats[] = {"gpkg", "shp", "fgb", "gml", "sqlite", "csv", "geojson"};

struct OpenFile {
    explicit OpenFile(const std::string& path)
        : dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR)),
          layer(dataset ? dataset->GetLayer(0) : nullptr) {}
    GDALDatasetUniquePtr dataset;
    OGRLayer* layer;
};

/// Whether GEOS finds all polygons of all bands valid.
bool are_valid(const std::vector<Band>& bands) {
    for (const Band& band : bands) {
        OGRMultiPolygon all;
        for (const BandPolygon& rings : band.polygons) {
            OGRPolygon polygon;
            for (const BandRing& points : rings) {
                OGRLinearRing ring;
                for (const Point2 p : points) {
                    ring.addPoint(p.x, p.y);
                }
                polygon.addRing(&ring);
            }
            all.addGeometry(&polygon);
        }
        if (all.IsValid() == FALSE) {
            return false;
        }
    }
    return true;
}

}  // namespace

TEST_SUITE("io/write_contours") {
    TEST_CASE("lines come back from every format, to the bit where it keeps all digits") {
        register_drivers();
        const TemporaryFolder folder;
        const std::vector<LevelLines> lines = make_contours(hill(), kElevations);
        for (const std::string format : kFormats) {
            CAPTURE(format);
            const std::string path = folder.file(format + "_lines." + format);
            WriteContoursOptions options;
            options.has_index = true;
            check_contour_target(path, options, false);
            const WrittenContours written =
                write_contours(kLevels, lines, Crs::parse("EPSG:32632"), path, options);
            CHECK(written.features == 3);
            CHECK(written.warnings.empty());
            const OpenFile file(path);
            REQUIRE(file.layer != nullptr);
            std::size_t count = 0;
            for (const auto& feature : *file.layer) {
                // FlatGeobuf has features in the order of its index.
                const auto level = static_cast<std::size_t>(feature->GetFieldAsInteger("id"));
                REQUIRE(level < 3);
                CHECK(feature->GetFieldAsDouble("elev") == kLevels[level].elevation);
                CHECK(feature->GetFieldAsInteger("is_index") == (kLevels[level].is_index ? 1 : 0));
                REQUIRE(feature->GetGeometryRef() != nullptr);
                const OGRLineString& line = *feature->GetGeometryRef()->toLineString();
                const auto expected = lines[level].line(0);
                REQUIRE(line.getNumPoints() == static_cast<int>(expected.size()));
                for (int i = 0; i < line.getNumPoints(); ++i) {
                    const Point2 p = expected[static_cast<std::size_t>(i)];
                    if (format == "gml" || format == "geojson") {
                        CHECK(std::abs(line.getX(i) - p.x) < 1e-8);
                        CHECK(std::abs(line.getY(i) - p.y) < 1e-7);
                    } else {
                        CHECK(line.getX(i) == p.x);
                        CHECK(line.getY(i) == p.y);
                    }
                    CHECK(line.getZ(i) == kLevels[level].elevation);
                }
                ++count;
            }
            CHECK(count == 3);
        }
    }

    TEST_CASE("bands come back from every format as valid polygons of the same area") {
        register_drivers();
        const TemporaryFolder folder;
        const std::vector<Band> bands = make_bands(hill(), kElevations);
        REQUIRE(bands.size() == 4);
        for (const std::string format : kFormats) {
            CAPTURE(format);
            const std::string path = folder.file(format + "_bands." + format);
            WriteContoursOptions options;
            options.layer_name = "bands";
            check_contour_target(path, options, true);
            const WrittenContours written = write_bands(bands, Crs::parse("EPSG:32632"), path, options);
            CHECK(written.features == 4);
            CHECK(written.warnings.empty());
            const OpenFile file(path);
            REQUIRE(file.layer != nullptr);
            double area = 0;
            std::size_t count = 0;
            for (const auto& feature : *file.layer) {
                const auto band = static_cast<std::size_t>(feature->GetFieldAsInteger("id"));
                REQUIRE(band < 4);
                CHECK(feature->GetFieldAsDouble("elev_min") == bands[band].low);
                CHECK(feature->GetFieldAsDouble("elev_max") == bands[band].high);
                const OGRGeometry* const geometry = feature->GetGeometryRef();
                REQUIRE(geometry != nullptr);
                CHECK(geometry->Is3D() == FALSE);
                CHECK(geometry->IsValid() != FALSE);
                area += wkbFlatten(geometry->getGeometryType()) == wkbPolygon
                            ? geometry->toPolygon()->get_Area()
                            : geometry->toMultiPolygon()->get_Area();
                ++count;
            }
            CHECK(count == 4);
            CHECK(area == doctest::Approx(4.5 * 4.1));
        }
    }

    TEST_CASE("a layer without lines is a layer") {
        register_drivers();
        const TemporaryFolder folder;
        for (const std::string format : kFormats) {
            CAPTURE(format);
            const std::string path = folder.file(format + "_none." + format);
            CHECK(write_contours({}, {}, Crs(), path, {}).features == 0);
            const OpenFile file(path);
            // OGR's GML and CSV readers show no layer, or one without a geometry, where no feature tells.
            if (format != "gml") {
                REQUIRE(file.layer != nullptr);
                CHECK(file.layer->GetFeatureCount() == 0);
            }
        }
    }

    TEST_CASE("GEOS finds the bands of every kind of TIN valid") {
        register_drivers();
        for (int seed = 0; seed < cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            const Tin tin = contour_tin(random, static_cast<std::size_t>(seed));
            if (tin.vertex_count() > 0) {
                CHECK(are_valid(make_bands(tin, contour_levels_for(random, tin))));
            }
        }
        Random random(5);
        for (int round = 0; round < cases(20); ++round) {
            CAPTURE(round);
            const Tin tin = tied_grid(random, 30, 30, 2 + round % 4);
            const std::vector<double> levels{0, 0.5, 1, 2, 2.5, 3};
            CHECK(are_valid(make_bands(tin, levels)));
        }
    }

    TEST_CASE("formats that lose what contours are for are refused") {
        register_drivers();
        CHECK(
            message_of<UsageError>([] { check_contour_target("a.foo", {}, false); }) ==
            "no vector driver for \"a.foo\": unknown extension .foo; name one with --of, or use .gpkg, .shp, "
            ".fgb, .gml, .sqlite, .csv or .geojson");
        WriteContoursOptions kml;
        kml.driver = "KML";
        CHECK(message_of<UsageError>([&] { check_contour_target("a.kml", kml, false); }) ==
              "driver \"KML\" does not keep the positions of contours; use .gpkg, .shp, .fgb, .gml, .sqlite, "
              ".csv "
              "or .geojson");
        CHECK(message_of<UsageError>([] {
                  check_contour_target("a.dxf", {}, true);
              }).starts_with("driver \"DXF\""));
        CHECK_NOTHROW(check_contour_target("a.dxf", {}, false));
    }

    TEST_CASE("a file that exists is not replaced without being told so") {
        register_drivers();
        const TemporaryFolder folder;
        const std::string path = folder.file("lines.gpkg");
        const std::vector<LevelLines> lines = make_contours(hill(), kElevations);
        WriteContoursOptions options;
        static_cast<void>(write_contours(kLevels, lines, Crs(), path, options));
        CHECK_THROWS_AS(write_contours(kLevels, lines, Crs(), path, options), IoError);
        options.overwrite = true;
        CHECK(write_contours(kLevels, lines, Crs(), path, options).features == 3);
    }
}
