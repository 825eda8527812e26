#include "tinwright/io/geoid.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <GeographicLib/Constants.hpp>
#include <GeographicLib/Geoid.hpp>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {
namespace {

namespace fs = std::filesystem;
using Model = GeographicLib::Geoid;

constexpr std::size_t kBlock = 4096;
constexpr std::size_t kBlocksAReport = 256;
constexpr std::string_view kExtension = ".pgm";

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Where a geoid of that name may be, in the order of looking.
std::vector<fs::path> places_of(const std::string& file) {
    std::vector<fs::path> places{file};
    const bool has_extension = fs::path(file).extension() == kExtension;
    if (!has_extension) {
        places.emplace_back(file + std::string(kExtension));
    }
    if (!fs::path(file).has_parent_path()) {
        const fs::path folder(Model::DefaultGeoidPath());
        places.push_back(folder / (has_extension ? file : file + std::string(kExtension)));
    }
    return places;
}

/// Throws IoError.
fs::path find_file(const std::string& file) {
    std::vector<std::string> names;
    for (const fs::path& place : places_of(file)) {
        std::error_code error;
        if (!file.empty() && fs::is_regular_file(place, error)) {
            if (place.extension() != kExtension) {
                throw IoError("geoid " + quoted(file) + ": a geoid's file is named \"" +
                              std::string(kExtension) + "\"; give one of GeographicLib's");
            }
            return place;
        }
        names.push_back(place.string());
    }
    throw IoError("geoid " + quoted(file) + ": no such file; looked for " + quoted_list(names) +
                  "; give its path, or its folder in the environment variable GEOGRAPHICLIB_GEOID_PATH");
}

/// What GeographicLib says, without the path and on one line.
std::string reason_of(const std::exception& error, const fs::path& path) {
    std::string text = error.what();
    if (const std::size_t at = text.find(path.string()); at != std::string::npos) {
        text.erase(at, path.string().size());
    }
    for (char& c : text) {
        c = std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c;
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == ':')) {
        text.pop_back();
    }
    return text;
}

std::unique_ptr<Model> open_model(const fs::path& path, bool is_whole) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    return std::make_unique<Model>(path.stem().string(), folder.string(), true, is_whole);
}

[[noreturn]] void refuse(const fs::path& path, const std::exception& error) {
    throw IoError("geoid " + quoted(path.string()) + ": cannot be read as a geoid: " +
                  reason_of(error, path) + "; give one of GeographicLib's, for example egm2008-1.pgm");
}

/// One line; empty for GeographicLib's "NONE".
std::string tidy(const std::string& description) {
    std::string text;
    for (const char c : description) {
        text.push_back(std::iscntrl(static_cast<unsigned char>(c)) != 0 ? ' ' : c);
    }
    return text == "NONE" ? std::string() : text;
}

std::string code_in(const std::string& text) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kCodes = {
        {{"egm2008", "EPSG:3855"}, {"egm96", "EPSG:5773"}, {"egm84", "EPSG:5798"}}};
    const std::string small = lower(text);
    for (const auto& [name, code] : kCodes) {
        if (small.find(name) != std::string::npos) {
            return std::string(code);
        }
    }
    return {};
}

/// The part of the file that is kept in memory.
struct Area {
    double south;
    double west;
    double north;
    double east;

    [[nodiscard]] double share() const { return (north - south) / 180 * (east - west) / 360; }
};

}  // namespace

/// GeographicLib's objects remember the last cell, so that each thread has one of its own with its own copy
/// of the area; where that would be more than the file, all share one that has the whole file and remembers
/// nothing. Both compute the same.
struct Geoid::State {
    fs::path path;
    std::string path_text;
    std::string description;
    std::optional<Area> area;
    std::unique_ptr<Model> shared;  ///< null: one a thread
    mutable tbb::enumerable_thread_specific<std::unique_ptr<Model>> of_threads{};

    [[nodiscard]] const Model& model() const;
};

const GeographicLib::Geoid& Geoid::State::model() const {
    if (shared != nullptr) {
        return *shared;
    }
    std::unique_ptr<Model>& own = of_threads.local();
    if (own == nullptr) {
        std::unique_ptr<Model> fresh = open_model(path, false);
        if (area) {
            fresh->CacheArea(area->south, area->west, area->north, area->east);
        }
        own = std::move(fresh);
    }
    return *own;
}

Geoid::Geoid(const std::string& file) : state_(std::make_unique<State>()) {
    state_->path = find_file(file);
    state_->path_text = state_->path.string();
    try {
        state_->description = tidy(state_->model().Description());
    } catch (const std::exception& error) {
        refuse(state_->path, error);
    }
}

Geoid::~Geoid() = default;

void Geoid::prepare(const GeographicExtent& extent) {
    if (extent.is_empty) {
        return;
    }
    // GeographicLib takes two meridians that are the same for all the way round.
    constexpr double kLeastWidth = 1e-3;
    const Area area{extent.south, extent.west, extent.north,
                    std::max(extent.east, extent.west + kLeastWidth)};
    const double threads = tbb::this_task_arena::max_concurrency();
    state_->of_threads.clear();
    state_->shared.reset();
    state_->area = area;
    try {
        if (threads > 1 && area.share() * threads > 1) {
            state_->shared = open_model(state_->path, true);
        } else {
            static_cast<void>(state_->model());
        }
    } catch (const std::exception& error) {
        refuse(state_->path, error);
    }
}

double Geoid::height(double latitude, double longitude) const {
    if (!std::isfinite(latitude) || !std::isfinite(longitude)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    try {
        return state_->model()(latitude, longitude);
    } catch (const std::exception& error) {
        refuse(state_->path, error);
    }
}

const std::string& Geoid::path() const { return state_->path_text; }
const std::string& Geoid::description() const { return state_->description; }

std::string Geoid::vertical_code() const {
    const std::string told = code_in(state_->description);
    return told.empty() ? code_in(state_->path.stem().string()) : told;
}

void shift_by_geoid(const Geoid& geoid, std::span<const Point3> at, std::span<Point3> points, int sign,
                    double metres_per_unit, const Progress& progress) {
    constexpr std::size_t kStep = kBlock * kBlocksAReport;
    for (std::size_t begin = 0; begin < points.size(); begin += kStep) {
        const std::size_t end = std::min(points.size(), begin + kStep);
        tbb::parallel_for(std::size_t{0}, (end - begin + kBlock - 1) / kBlock, [&](std::size_t block) {
            const std::size_t first = begin + block * kBlock;
            const std::size_t last = std::min(end, first + kBlock);
            for (std::size_t i = first; i < last; ++i) {
                points[i].z += sign * geoid.height(at[i].y, at[i].x) / metres_per_unit;
            }
        });
        report_progress(progress, static_cast<double>(end) / static_cast<double>(points.size()));
    }
}

}  // namespace tinwright::io
