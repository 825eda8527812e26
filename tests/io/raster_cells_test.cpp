#include "tinwright/io/raster_cells.hpp"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <gdal_priv.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace {

using namespace tinwright;

/// An Int16 raster of 3 x 2 cells in memory, columns counted in ones and rows in tens, one cell empty.
class MemoryRaster {
  public:
    explicit MemoryRaster(const std::vector<double>& transform) {
        io::register_drivers();
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
        const GDALDatasetUniquePtr dataset(driver->Create(kPath, 3, 2, 1, GDT_Int16, nullptr));
        std::vector<double> numbers = transform;
        dataset->SetGeoTransform(numbers.data());
        GDALRasterBand& band = *dataset->GetRasterBand(1);
        band.SetNoDataValue(-1);
        band.SetScale(0.5);
        band.SetOffset(100);
        std::vector<std::int16_t> cells{0, 1, 2, 10, -1, 12};
        REQUIRE(band.RasterIO(GF_Write, 0, 0, 3, 2, cells.data(), 3, 2, GDT_Int16, 0, 0) == CE_None);
    }
    ~MemoryRaster() { VSIUnlink(kPath); }
    MemoryRaster(const MemoryRaster&) = delete;
    MemoryRaster& operator=(const MemoryRaster&) = delete;

    static constexpr const char* kPath = "/vsimem/raster_cells_test.tif";
};

std::string complaint(const std::string& source) {
    try {
        const io::RasterCells cells(io::parse_source(source));
    } catch (const Error& error) {
        return error.what();
    }
    return "fine";
}

}  // namespace

TEST_SUITE("io/raster_cells") {
    TEST_CASE("cells are read in any order, scaled, and without a value where there is none") {
        const MemoryRaster raster({500, 10, 0, 1000, 0, -5});
        io::RasterCells cells(io::parse_source(MemoryRaster::kPath));
        CHECK(cells.geometry() == GridGeometry{500, 1000, 10, 5, 3, 2});
        CHECK(cells.data_type() == "Int16");
        CHECK_FALSE(cells.crs().is_known());
        std::vector<double> row(3);
        cells.read(1, 0, row);
        CHECK(row[0] == 105);
        CHECK(std::isnan(row[1]));
        CHECK(row[2] == 106);
        std::vector<double> one(1);
        cells.read(0, 2, one);
        CHECK(one[0] == 101);
    }

    TEST_CASE("crs= says the system of a raster that carries none") {
        const MemoryRaster raster({500, 10, 0, 1000, 0, -5});
        const io::RasterCells cells(io::parse_source(std::string(MemoryRaster::kPath) + ",crs=EPSG:3067"));
        CHECK(cells.crs().code() == "EPSG:3067");
    }

    TEST_CASE("rasters that do not lie north up are refused") {
        const std::string refusal =
            "raster \"/vsimem/raster_cells_test.tif\": is rotated, mirrored or has south up, and only "
            "north-up rasters can be checked; gdalwarp makes it one";
        for (const std::vector<double>& transform : {std::vector<double>{500, 10, 0, 1000, 0, 5},
                                                     {500, -10, 0, 1000, 0, -5},
                                                     {500, 10, 1, 1000, 0, -5}}) {
            const MemoryRaster raster(transform);
            CHECK(complaint(MemoryRaster::kPath) == refusal);
        }
    }

    TEST_CASE("what is no such raster is said") {
        const MemoryRaster raster({500, 10, 0, 1000, 0, -5});
        const std::string path = MemoryRaster::kPath;
        CHECK(complaint(path + ",band=2") == "raster \"/vsimem/raster_cells_test.tif\": no band 2; it has 1");
        CHECK(complaint(path + ",stride=2") ==
              "raster \"/vsimem/raster_cells_test.tif\" takes the keys band=, crs= and oo= only");
        CHECK(
            complaint("/vsimem/nothing.tif").starts_with("cannot read \"/vsimem/nothing.tif\" as a raster"));
    }
}
