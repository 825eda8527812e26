// Makes the files of samples/data: an invented survey of an invented valley (invented_terrain.hpp).
//   make_data FOLDER          writes survey.csv, road_pnezd.txt and terrain.gpkg
//   make_data --check FOLDER  fails when the folder holds anything else than what would be written
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "invented_terrain.hpp"

namespace {

using invented::Position;

constexpr int kEpsg = 25832;  // ETRS89 / UTM zone 32N; the valley itself exists nowhere
constexpr double kEast = 598000;
constexpr double kNorth = 5402000;

struct Shot {
    double x = 0;
    double y = 0;
    double z = 0;
    std::string code;
};

struct Line {
    std::string kind;
    std::vector<Shot> vertices;
};

struct Survey {
    std::vector<Shot> shots;
    std::vector<Line> breaklines;
    std::vector<Shot> lake;
    std::vector<Shot> outline;
};

double centimetres(double value) { return std::floor(value * 100 + 0.5) / 100; }

Shot make_shot(Position p, double z, const char* code) {
    return {centimetres(kEast + p.x), centimetres(kNorth + p.y), centimetres(z), code};
}

/// Moves outward from the edge of the road until the embankment or the cutting meets the ground.
Position find_toe(double y, double side) {
    const Position middle = invented::road(y);
    const Position right = invented::road_right(y);
    double distance = invented::kRoadHalfWidth;
    Position p;
    do {
        distance += 0.2;
        p = {middle.x + side * distance * right.x, middle.y + side * distance * right.y};
    } while (distance < 60 && std::abs(invented::elevation(p) - invented::natural_elevation(p)) > 0.02);
    return p;
}

bool is_under_road(Position p) {
    return std::abs(invented::elevation(p) - invented::natural_elevation(p)) > 0.02;
}

void survey_road(Survey& survey) {
    std::array<Line, 4> lines{{{"road edge", {}}, {"road edge", {}}, {"toe", {}}, {"toe", {}}}};
    for (double y = -10; y < invented::kHeight + 10; y += 12) {
        const Position middle = invented::road(y);
        if (!invented::is_in_survey_area(middle)) {
            continue;
        }
        survey.shots.push_back(make_shot(middle, invented::road_elevation(y), "RC"));
        const Position right = invented::road_right(y);
        for (const std::size_t side : {0U, 1U}) {
            const double signed_width = (side == 0 ? -1 : 1) * invented::kRoadHalfWidth;
            const Position edge{middle.x + signed_width * right.x, middle.y + signed_width * right.y};
            lines[side].vertices.push_back(make_shot(edge, invented::road_elevation(y) - 0.11, "RE"));
            const Position toe = find_toe(y, side == 0 ? -1 : 1);
            lines[2 + side].vertices.push_back(make_shot(toe, invented::elevation(toe), "TO"));
        }
    }
    for (Line& line : lines) {
        survey.shots.insert(survey.shots.end(), line.vertices.begin(), line.vertices.end());
        survey.breaklines.push_back(std::move(line));
    }
}

/// Bed and banks, interrupted by the lake and by the culvert.
void survey_stream(Survey& survey) {
    struct Part {
        double offset;
        const char* kind;
        const char* code;
    };
    const std::array<Part, 3> parts{{{0, "stream bed", "SB"},
                                     {invented::kBankDistance, "stream bank", "SK"},
                                     {-invented::kBankDistance, "stream bank", "SK"}}};
    for (const auto& part : parts) {
        Line line{part.kind, {}};
        const auto finish = [&] {
            if (line.vertices.size() > 1) {
                survey.shots.insert(survey.shots.end(), line.vertices.begin(), line.vertices.end());
                survey.breaklines.push_back(line);
            }
            line.vertices.clear();
        };
        for (double x = 4; x < invented::kWidth; x += 7) {
            const double rise = (invented::stream(x + 1).y - invented::stream(x - 1).y) / 2;
            const double length = std::sqrt(1 + rise * rise);
            const Position p{x - part.offset * rise / length, invented::stream(x).y + part.offset / length};
            const Position ahead{p.x + 10, p.y};
            const Position behind{p.x - 10, p.y};
            if (!invented::is_in_survey_area(p) || invented::is_in_lake(ahead) ||
                invented::is_in_lake(behind) || is_under_road(p)) {
                finish();
                continue;
            }
            line.vertices.push_back(make_shot(p, invented::elevation(p), part.code));
        }
        finish();
    }
}

void survey_lake(Survey& survey) {
    for (const Position p : invented::lake_shore(88)) {
        survey.lake.push_back(make_shot(p, invented::kLakeLevel, "WL"));
    }
    survey.shots.insert(survey.shots.end(), survey.lake.begin(), survey.lake.end());
    for (const Position p : invented::survey_outline(120)) {
        survey.outline.push_back(make_shot(p, 0, ""));
    }
}

/// Ground shots as a walking surveyor spreads them: irregular, none close to another, denser in the valley.
void survey_ground(Survey& survey) {
    invented::Random random(2);
    std::vector<Position> taken;
    for (int attempt = 0; attempt < 60000; ++attempt) {
        const Position p{random.uniform(0, invented::kWidth), random.uniform(0, invented::kHeight)};
        const double height = invented::natural_elevation(p) - invented::kLakeLevel;
        const double apart = height < 4 ? 11.5 : 15.5;
        const double noise = random.uniform(-0.02, 0.02);
        if (!invented::is_in_survey_area(p) || invented::is_in_lake(p) || is_under_road(p) ||
            invented::distance_to_road(p) < 9 || std::abs(p.y - invented::stream(p.x).y) < 9) {
            continue;
        }
        bool is_free = true;
        for (const Position other : taken) {
            const double dx = p.x - other.x;
            const double dy = p.y - other.y;
            is_free = is_free && dx * dx + dy * dy > apart * apart;
        }
        if (is_free) {
            taken.push_back(p);
            survey.shots.push_back(make_shot(p, invented::elevation(p) + noise, "GR"));
        }
    }
}

std::string csv_text(const Survey& survey) {
    std::string text = "x,y,z,code\n";
    std::array<char, 128> row{};
    for (const Shot& s : survey.shots) {
        std::snprintf(row.data(), row.size(), "%.2f,%.2f,%.2f,%s\n", s.x, s.y, s.z, s.code.c_str());
        text += row.data();
    }
    return text;
}

/// Point number, northing, easting, elevation, description: what a total station exports.
std::string pnezd_text(const Survey& survey) {
    std::string text;
    std::array<char, 128> row{};
    int number = 1001;
    for (const Shot& s : survey.shots) {
        if (s.code == "RC" || s.code == "RE" || s.code == "TO") {
            std::snprintf(row.data(), row.size(), "%d,%.2f,%.2f,%.2f,%s\n", number++, s.y, s.x, s.z,
                          s.code.c_str());
            text += row.data();
        }
    }
    return text;
}

void add_feature(OGRLayer& layer, const OGRGeometry& geometry, const char* field, const std::string& value) {
    OGRFeature feature(layer.GetLayerDefn());
    feature.SetGeometry(&geometry);
    if (field != nullptr) {
        feature.SetField(field, value.c_str());
    }
    if (layer.CreateFeature(&feature) != OGRERR_NONE) {
        throw std::runtime_error("cannot write a feature");
    }
}

OGRPolygon make_polygon(const std::vector<Shot>& ring, bool with_z) {
    OGRLinearRing shell;
    for (const Shot& s : ring) {
        with_z ? shell.addPoint(s.x, s.y, s.z) : shell.addPoint(s.x, s.y);
    }
    shell.closeRings();
    OGRPolygon polygon;
    polygon.addRing(&shell);
    return polygon;
}

void write_geopackage(const Survey& survey, const std::string& path) {
    CPLSetConfigOption("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z");
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    if (driver == nullptr) {
        throw std::runtime_error("this GDAL has no GeoPackage driver");
    }
    const GDALDatasetUniquePtr file(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!file) {
        throw std::runtime_error("cannot create " + path);
    }
    OGRSpatialReference crs;
    crs.importFromEPSG(kEpsg);
    const auto make_layer = [&](const char* name, OGRwkbGeometryType type, const char* field) {
        const std::array<const char*, 2> options{"SPATIAL_INDEX=NO", nullptr};
        OGRLayer* layer = file->CreateLayer(name, &crs, type, const_cast<char**>(options.data()));
        if (layer == nullptr) {
            throw std::runtime_error(std::string("cannot create layer ") + name);
        }
        if (field != nullptr) {
            OGRFieldDefn definition(field, OFTString);
            layer->CreateField(&definition);
        }
        return layer;
    };
    file->StartTransaction();
    OGRLayer* points = make_layer("points", wkbPoint25D, "code");
    for (const Shot& s : survey.shots) {
        add_feature(*points, OGRPoint(s.x, s.y, s.z), "code", s.code);
    }
    OGRLayer* breaklines = make_layer("breaklines", wkbLineString25D, "kind");
    for (const Line& line : survey.breaklines) {
        OGRLineString geometry;
        for (const Shot& s : line.vertices) {
            geometry.addPoint(s.x, s.y, s.z);
        }
        add_feature(*breaklines, geometry, "kind", line.kind);
    }
    add_feature(*make_layer("lake", wkbPolygon25D, nullptr), make_polygon(survey.lake, true), nullptr, "");
    add_feature(*make_layer("boundary", wkbPolygon, nullptr), make_polygon(survey.outline, false), nullptr,
                "");
    file->CommitTransaction();
}

/// A GeoPackage as text: its bytes depend on the SQLite that wrote it, its content does not.
std::string geopackage_text(const std::string& path) {
    const GDALDatasetUniquePtr file(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
    if (!file) {
        throw std::runtime_error("cannot open " + path);
    }
    std::ostringstream text;
    text.precision(17);
    for (OGRLayer* layer : file->GetLayers()) {
        const char* code = layer->GetSpatialRef()->GetAuthorityCode(nullptr);
        text << "layer " << layer->GetName() << ' ' << (code != nullptr ? code : "?") << '\n';
        for (const auto& feature : *layer) {
            char* wkt = nullptr;
            feature->GetGeometryRef()->exportToWkt(&wkt, wkbVariantIso);
            text << feature->GetFID() << ' ' << wkt;
            CPLFree(wkt);
            for (int i = 0; i < feature->GetFieldCount(); ++i) {
                text << ' ' << feature->GetFieldAsString(i);
            }
            text << '\n';
        }
    }
    return text.str();
}

std::string read_text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

void write_text(const std::string& path, const std::string& text) {
    std::ofstream out(path, std::ios::binary);
    if (!(out << text).flush()) {
        throw std::runtime_error("cannot write " + path);
    }
}

void expect_same(const std::string& path, bool is_same) {
    if (!is_same) {
        throw std::runtime_error(path + " is not what the generator makes; run make_data again");
    }
}

int run(int argc, char** argv) {
    const bool is_check = argc == 3 && std::string(argv[1]) == "--check";
    if (!is_check && argc != 2) {
        std::cerr << "usage: make_data [--check] FOLDER\n";
        return 2;
    }
    const std::string folder = std::string(argv[argc - 1]) + "/";
    GDALAllRegister();

    Survey survey;
    survey_ground(survey);
    survey_lake(survey);
    survey_stream(survey);
    survey_road(survey);

    if (is_check) {
        const std::string fresh = "/vsimem/terrain.gpkg";
        write_geopackage(survey, fresh);
        expect_same(folder + "survey.csv", read_text(folder + "survey.csv") == csv_text(survey));
        expect_same(folder + "road_pnezd.txt", read_text(folder + "road_pnezd.txt") == pnezd_text(survey));
        expect_same(folder + "terrain.gpkg",
                    geopackage_text(folder + "terrain.gpkg") == geopackage_text(fresh));
    } else {
        VSIUnlink((folder + "terrain.gpkg").c_str());
        write_text(folder + "survey.csv", csv_text(survey));
        write_text(folder + "road_pnezd.txt", pnezd_text(survey));
        write_geopackage(survey, folder + "terrain.gpkg");
    }
    std::cout << survey.shots.size() << " points, " << survey.breaklines.size() << " breaklines\n";
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "make_data: " << error.what() << '\n';
        return 1;
    }
}
