#include "benchmarks/held_out_sets.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/source.hpp"

#include "benchmarks/terrain_points.hpp"
#include "support/point_sets.hpp"

namespace tinwright_benchmarks {

using tinwright::Breakline;
using tinwright::Point3;
using tinwright_tests::Random;

namespace {

constexpr double kMostChecks = 15'000;  // a fold

Points read(const std::string& source_text) {
    const tinwright::io::Source source = tinwright::io::parse_source(source_text);
    return tinwright::io::read_samples(std::span(&source, 1)).points;
}

std::vector<Breakline> read_breaklines(const std::string& source_text) {
    const tinwright::io::LineSource source{tinwright::io::parse_source(source_text)};
    return tinwright::io::read_lines(std::span(&source, 1)).lines;
}

/// The first of each location, in a canonical order.
Points without_repetitions(Points points) {
    const auto order = [](const Point3& p) { return std::tuple(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(),
              [&](const Point3& a, const Point3& b) { return order(a) < order(b); });
    const auto same = [](const Point3& a, const Point3& b) { return a.x == b.x && a.y == b.y; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    return points;
}

/// In a random order, seeded.
Points in_random_order(std::uint64_t seed, Points points) {
    Random random(seed);
    return tinwright_tests::shuffled(random, without_repetitions(std::move(points)));
}

void keep_first(Points& points, double count) {
    points.resize(std::min(points.size(), static_cast<std::size_t>(std::max(1.0, count))));
}

/// `draws` times a share of the points as samples and the rest, or so many of them as are enough, as checks.
std::vector<Fold> thin(const Points& points, double share, int draws, double scale) {
    std::vector<Fold> folds;
    for (int draw = 0; draw < draws; ++draw) {
        const Points order = in_random_order(static_cast<std::uint64_t>(draw) + 1, points);
        const auto kept = static_cast<std::ptrdiff_t>(share * static_cast<double>(order.size()) * scale);
        Fold fold;
        fold.samples.assign(order.begin(), order.begin() + kept);
        fold.checks.assign(order.begin() + kept, order.end());
        keep_first(fold.checks, kMostChecks * scale);
        folds.push_back(std::move(fold));
    }
    return folds;
}

/// Each point is a check once, the other folds' being the samples.
std::vector<Fold> leave_out(const Points& points, std::size_t count,
                            const std::vector<Breakline>& lines = {}) {
    const Points order = in_random_order(7, points);
    std::vector<Fold> folds(count);
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t k = 0; k < count; ++k) {
            (i % count == k ? folds[k].checks : folds[k].samples).push_back(order[i]);
        }
    }
    for (Fold& fold : folds) {
        fold.lines = lines;
    }
    return folds;
}

constexpr std::size_t kFolds = 10;

std::vector<Fold> hobart(const std::string& folder, double scale) {
    Fold fold{read(folder + "/hobart_jk3_points.csv"), {}, read(folder + "/hobart_dem_01.tif")};
    fold.checks = in_random_order(1, std::move(fold.checks));
    keep_first(fold.checks, 3 * kMostChecks * scale);
    return {std::move(fold)};
}

/// A raster in degrees, in a plane of metres true to scale at its centre, to the centimetre.
Points in_metres(Points points) {
    constexpr double kMetres = 6371000 * std::numbers::pi / 180;
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [](const Point3& a, const Point3& b) { return a.y < b.y; });
    const double middle = (low->y + high->y) / 2;
    const double along = kMetres * std::cos(middle * std::numbers::pi / 180);
    const Point3 origin = points.front();
    for (Point3& p : points) {
        p.x = std::round(100 * along * (p.x - origin.x)) / 100;
        p.y = std::round(100 * kMetres * (p.y - origin.y)) / 100;
    }
    return points;
}

/// Vertices of lines at the levels (5 m apart) that are even multiples or odd ones; each half once a check.
std::vector<Fold> alternate_levels(const Points& vertices, double scale) {
    std::vector<Fold> folds(2);
    for (const Point3& p : in_random_order(5, vertices)) {
        const bool is_odd = std::fmod(std::round(p.z / 5), 2) != 0;
        (is_odd ? folds[0].checks : folds[0].samples).push_back(p);
        (is_odd ? folds[1].samples : folds[1].checks).push_back(p);
    }
    for (Fold& fold : folds) {
        keep_first(fold.checks, kMostChecks * scale);
    }
    return folds;
}

/// Franke's points with the values of a function; checks on a grid of the unit square.
std::vector<Fold> franke_folds(const std::string& file, int number) {
    constexpr int kSide = 101;
    Fold fold{read(file + ",z=f" + std::to_string(number)), {}, {}};
    for (Point3& p : fold.samples) {
        p.z = franke(number, p.x, p.y);
    }
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            const double x = i / (kSide - 1.0);
            const double y = j / (kSide - 1.0);
            fold.checks.push_back({x, y, franke(number, x, y)});
        }
    }
    return {std::move(fold)};
}

void add_data_sets(std::vector<HeldOutSet>& sets, const std::string& folder, double scale) {
    using Kind = HeldOutSet::Kind;
    const auto thinned = [&](const std::string& name, const std::function<Points()>& points, double share,
                             int draws) {
        sets.push_back({name, Kind::Real, [=] { return thin(points(), share, draws, scale); }});
    };
    const auto left_out = [&](const std::string& name, const std::function<Points()>& points) {
        sets.push_back({name, Kind::Real, [=] { return leave_out(points(), kFolds); }});
    };
    const auto file = [&](const std::string& name) {
        return [path = folder + "/" + name] { return read(path); };
    };
    sets.push_back({"hobart against its DEM", Kind::Real, [=] { return hobart(folder, scale); }});
    left_out("hobart, a tenth left out", file("hobart_jk3_points.csv"));
    const auto ground = [path = "CSV:/vsigzip/" + folder + "/ahn3_delft_ground.csv.gz"] {
        return read(path + ",xfield=x,yfield=y,z=z");
    };
    thinned("ahn3 ground, 2 %", ground, 0.02, 1);
    thinned("ahn3 ground, 10 %", ground, 0.1, 1);
    thinned("volcano, 10 %", file("volcano_grid_points.csv"), 0.1, 3);
    thinned("volcano, 30 %", file("volcano_grid_points.csv"), 0.3, 3);
    // The raster's degrees are read as if they were metres, which they then become.
    const auto jacksboro = [path = folder + "/jacksboro_dem_lonlat.tif,crs=EPSG:32616"] {
        return in_metres(read(path));
    };
    thinned("jacksboro, 1 %", jacksboro, 0.01, 2);
    thinned("jacksboro, 4 %", jacksboro, 0.04, 1);
    thinned("nh_lake, 1 %", file("nh_lake_dem.tif"), 0.01, 2);
    thinned("nh_lake, 4 %", file("nh_lake_dem.tif"), 0.04, 1);
    left_out("partridge, a tenth left out", file("partridge_survey_pnezd.csv"));
    left_out("meuse, a tenth left out", file("meuse.gpkg,layer=spot_heights"));
    const auto contours = [path = folder + "/redon_contours.gpkg,layer=contours,z=Z,vertices=yes"] {
        return read(path);
    };
    sets.push_back({"redon, alternate levels left out", Kind::Real,
                    [=] { return alternate_levels(without_repetitions(contours()), scale); }});
    thinned("redon, a quarter of the vertices left out", contours, 0.75, 1);
    for (const int count : {33, 100}) {
        for (int number = 1; number <= 6; ++number) {
            const std::string path = folder + "/franke_" + std::to_string(count) + ".csv";
            sets.push_back({"franke f" + std::to_string(number) + ", " + std::to_string(count) + " points",
                            Kind::Function, [=] { return franke_folds(path, number); }});
        }
    }
}

}  // namespace

double franke(int number, double x, double y) {
    const auto square = [](double a) { return a * a; };
    const double from_middle = square(x - 0.5) + square(y - 0.5);
    switch (number) {
        case 1:
            return 0.75 * std::exp(-(square(9 * x - 2) + square(9 * y - 2)) / 4) +
                   0.75 * std::exp(-square(9 * x + 1) / 49 - (9 * y + 1) / 10) +
                   0.5 * std::exp(-(square(9 * x - 7) + square(9 * y - 3)) / 4) -
                   0.2 * std::exp(-square(9 * x - 4) - square(9 * y - 7));
        case 2:
            return (std::tanh(9 * y - 9 * x) + 1) / 9;
        case 3:
            return (1.25 + std::cos(5.4 * y)) / (6 * (1 + square(3 * x - 1)));
        case 4:
            return std::exp(-81.0 / 16 * from_middle) / 3;
        case 5:
            return std::exp(-81.0 / 4 * from_middle) / 3;
        case 6:
            return std::sqrt(64 - 81 * from_middle) / 9 - 0.5;
        default:
            throw std::invalid_argument("Franke has functions 1 to 6");
    }
}

std::vector<HeldOutSet> held_out_sets(const std::string& data_folder, const std::string& samples_folder,
                                      double scale) {
    using Kind = HeldOutSet::Kind;
    std::vector<HeldOutSet> sets;
    if (!data_folder.empty()) {
        add_data_sets(sets, data_folder, scale);
    }
    sets.push_back({"valley (samples/data), a tenth left out", Kind::Extra,
                    [=] { return leave_out(read(samples_folder + "/survey.csv"), kFolds); }});
    sets.push_back({"valley, a tenth left out, with its breaklines", Kind::Extra, [=] {
                        const std::string lines = samples_folder + "/terrain.gpkg,layer=breaklines";
                        const std::string points =
                            samples_folder + "/terrain.gpkg,layer=points,where=code='GR'";
                        return leave_out(read(points), kFolds, read_breaklines(lines));
                    }});
    sets.push_back(
        {"fractal terrain, 10 %", Kind::Extra, [=] { return thin(fractal_points(40'000), 0.1, 1, scale); }});
    return sets;
}

}  // namespace tinwright_benchmarks
