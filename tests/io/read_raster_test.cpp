#include "tinwright/io/read_raster.hpp"

#include <array>
#include <functional>
#include <limits>
#include <memory>

#include <doctest/doctest.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"

#include "reading.hpp"

using tinwright::InputError;
using tinwright::Point3;
using tinwright::UsageError;
using namespace tinwright::io;
using tinwright_tests::MemoryFile;
using tinwright_tests::message_of;
using tinwright_tests::read;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A GeoTIFF in memory of 4 columns and 3 rows, cell (column, row) = 10 row + column.
class Raster {
  public:
    explicit Raster(const std::function<void(GDALDataset&)>& change = {}, GDALDataType type = GDT_Float32,
                    std::array<double, 6> transform = {100, 2, 0, 50, 0, -2}) {
        register_drivers();
        const std::unique_ptr<GDALDataset, CloseDataset> dataset(
            GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path(), 4, 3, 2, type, nullptr));
        REQUIRE(dataset != nullptr);
        dataset->SetGeoTransform(transform.data());
        std::array<double, 12> cells{};
        for (int b = 1; b <= 2; ++b) {
            for (std::size_t i = 0; i < 12; ++i) {
                cells[i] = 100.0 * (b - 1) + 10.0 * static_cast<double>(i / 4) + static_cast<double>(i % 4);
            }
            write(*dataset, b, cells);
        }
        if (change) {
            change(*dataset);
        }
    }
    Raster(const Raster&) = delete;
    Raster& operator=(const Raster&) = delete;
    ~Raster() {
        VSIUnlink(path());
        VSIUnlink((std::string(path()) + ".msk").c_str());
        VSIUnlink((std::string(path()) + ".aux.xml").c_str());
    }

    static const char* path() { return "/vsimem/r.tif"; }
    static void write(GDALDataset& dataset, int band, std::array<double, 12>& cells) {
        REQUIRE(dataset.GetRasterBand(band)->RasterIO(GF_Write, 0, 0, 4, 3, cells.data(), 4, 3, GDT_Float64,
                                                      0, 0, nullptr) == CE_None);
    }
    static void set(GDALDataset& dataset, int column, int row, double value) {
        REQUIRE(dataset.GetRasterBand(1)->RasterIO(GF_Write, column, row, 1, 1, &value, 1, 1, GDT_Float64, 0,
                                                   0, nullptr) == CE_None);
    }
};

}  // namespace

TEST_SUITE("io/read_raster") {
    TEST_CASE("every cell is a sample at its centre") {
        const Raster raster;
        const Samples samples = read(raster.path());
        REQUIRE(samples.points.size() == 12);
        CHECK(samples.points[0] == Point3{101, 49, 0});
        CHECK(samples.points[3] == Point3{107, 49, 3});
        CHECK(samples.points[11] == Point3{107, 45, 23});
        CHECK(samples.slices[0].layer == "band 1");
        CHECK(samples.slices[0].ids.empty());
        CHECK(samples.describe(11) == R"(file "/vsimem/r.tif", band 1, cell 11)");
    }

    TEST_CASE("stride takes every n-th column and row") {
        const Raster raster;
        const Samples samples = read(std::string(raster.path()) + ",stride=2");
        CHECK(samples.points ==
              std::vector<Point3>{{101, 49, 0}, {105, 49, 2}, {101, 45, 20}, {105, 45, 22}});
        CHECK(samples.slices[0].ids == std::vector<std::int64_t>{0, 2, 8, 10});
        CHECK(read(std::string(raster.path()) + ",stride=2147483647").points.size() == 1);
        CHECK(read(std::string(raster.path()) + ",stride=3").points.size() == 2);
    }

    TEST_CASE("another band can be chosen") {
        const Raster raster;
        CHECK(read(std::string(raster.path()) + ",band=2").points[5].z == 111);
        CHECK(message_of<InputError>([&] { read(std::string(raster.path()) + ",band=3"); }) ==
              R"(file "/vsimem/r.tif": no band 3; the raster has 2)");
    }

    TEST_CASE("nodata, NaN and masked cells are no samples") {
        const Raster nodata([](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(12); });
        CHECK(read(nodata.path()).points.size() == 11);
        CHECK(read(nodata.path()).slices[0].id(6) == 7);
        const Raster not_numbers([](GDALDataset& dataset) { Raster::set(dataset, 1, 1, not_a_number); });
        CHECK(read(not_numbers.path()).points.size() == 11);
        const Raster nan_is_nodata([](GDALDataset& dataset) {
            dataset.GetRasterBand(1)->SetNoDataValue(not_a_number);
            Raster::set(dataset, 0, 0, not_a_number);
        });
        CHECK(read(nan_is_nodata.path()).points.size() == 11);
        const Raster masked([](GDALDataset& dataset) {
            REQUIRE(dataset.CreateMaskBand(GMF_PER_DATASET) == CE_None);
            std::array<unsigned char, 12> mask = {0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 0};
            REQUIRE(dataset.GetRasterBand(1)->GetMaskBand()->RasterIO(GF_Write, 0, 0, 4, 3, mask.data(), 4, 3,
                                                                      GDT_Byte, 0, 0, nullptr) == CE_None);
        });
        CHECK(read(masked.path()).points.size() == 7);
        const Raster nothing([](GDALDataset& dataset) {
            std::array<double, 12> none{};
            none.fill(-9999);
            dataset.GetRasterBand(1)->SetNoDataValue(-9999);
            Raster::write(dataset, 1, none);
        });
        CHECK(message_of<InputError>([&] { read(nothing.path()); }) ==
              R"(file "/vsimem/r.tif", band 1: no valid cells)");
    }

    TEST_CASE("infinite cells are unusable") {
        const Raster raster([](GDALDataset& dataset) {
            Raster::set(dataset, 2, 1, std::numeric_limits<double>::infinity());
        });
        CHECK(
            message_of<InputError>([&] { read(raster.path()); }) ==
            R"(file "/vsimem/r.tif", band 1, column 2, row 1: z is not finite; --skip-bad goes on without it)");
        ReadOptions options;
        options.skip_bad = true;
        CHECK(read(raster.path(), options).points.size() == 11);
        CHECK(read(raster.path(), options).slices[0].skipped == 1);
    }

    TEST_CASE("scale, offset and unit of the band apply") {
        const Raster raster(
            [](GDALDataset& dataset) {
                dataset.GetRasterBand(1)->SetScale(0.5);
                dataset.GetRasterBand(1)->SetOffset(100);
                dataset.GetRasterBand(1)->SetUnitType("ft");
            },
            GDT_Int16);
        const Samples samples = read(raster.path());
        CHECK(samples.points[11].z == 111.5);
        CHECK(samples.z_unit == "foot");
    }

    TEST_CASE("rotated rasters are placed by all six numbers") {
        const Raster raster({}, GDT_Float32, {100, 3, 4, 50, 4, -3});
        const Samples samples = read(raster.path());
        CHECK(samples.points[0] == Point3{103.5, 50.5, 0});
        CHECK(samples.points[11] == Point3{100 + 3 * 3.5 + 4 * 2.5, 50 + 4 * 3.5 - 3 * 2.5, 23});
    }

    TEST_CASE("an ESRI ASCII grid is a raster whatever its name") {
        const std::string grid =
            "ncols 2\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 0.1\nNODATA_value -9\n1 2\n3 -9\n";
        const std::vector<Point3> points = {{10.05, 20.15, 1}, {10.15, 20.15, 2}, {10.05, 20.05, 3}};
        const MemoryFile asc("g.asc", grid);
        CHECK(read(asc.path()).points == points);
        const MemoryFile txt("g.txt", grid);
        CHECK(read(txt.path()).points == points);
        const MemoryFile rows("p.asc", "1 2 3\n4 5 6\n");
        CHECK(read(rows.path()).slices[0].kind == SampleSlice::Kind::Text);
    }

    TEST_CASE("rows of a regular grid are text, not GDAL's XYZ raster") {
        const std::string rows = "0 0 1\n1 0 2\n0 1 3\n1 1 4\n";
        for (const char* const name : {"g.xyz", "g.dat"}) {
            const MemoryFile file(name, rows);
            CHECK(read(file.path()).slices[0].kind == SampleSlice::Kind::Text);
            CHECK(read(file.path()).points.size() == 4);
        }
    }

    TEST_CASE("reading is cancelled from the progress callback") {
        const Raster raster;
        ReadOptions options;
        options.progress = [](double) { return false; };
        CHECK_THROWS_AS(read(raster.path(), options), tinwright::Cancelled);
    }

    TEST_CASE("crs= replaces what the file says, with a warning") {
        const Raster raster([](GDALDataset& dataset) {
            OGRSpatialReference system;
            system.importFromEPSG(3067);
            dataset.SetSpatialRef(&system);
        });
        const Samples samples = read(std::string(raster.path()) + ",crs=EPSG:32635");
        CHECK(samples.crs.code() == "EPSG:32635");
        CHECK(samples.warnings ==
              std::vector<std::string>{
                  R"(file "/vsimem/r.tif": says EPSG:3067 (ETRS89 / TM35FIN(E,N)); read as )"
                  "EPSG:32635 (WGS 84 / UTM zone 35N) because of crs="});
        ReadOptions options;
        options.source_crs = Crs::parse("EPSG:3875");
        CHECK(read(raster.path(), options).crs.code() == "EPSG:3067");
    }

    TEST_CASE("a raster that cannot be used says why") {
        const Raster raster;
        CHECK(message_of<UsageError>([&] { read(std::string(raster.path()) + ",z=5"); }) ==
              R"(file "/vsimem/r.tif": z= does not go with a raster; choose its values with band=)");
        const Raster complex({}, GDT_CFloat32);
        CHECK(
            message_of<InputError>([&] { read(complex.path()); }) ==
            R"(file "/vsimem/r.tif": band 1 has complex numbers, no elevations; choose another with band=)");
        {
            std::unique_ptr<GDALDataset, CloseDataset> plain(
                GetGDALDriverManager()->GetDriverByName("GTiff")->Create("/vsimem/plain.tif", 2, 2, 1,
                                                                         GDT_Byte, nullptr));
        }
        CHECK(
            message_of<InputError>([] { read("/vsimem/plain.tif"); }) ==
            R"(file "/vsimem/plain.tif": the raster has no position; give it one first (gdal_edit.py -a_ullr))");
        VSIUnlink("/vsimem/plain.tif");
    }
}
