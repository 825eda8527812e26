#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "benchmarks/benchmarks.hpp"
#include "benchmarks/composite.hpp"

namespace tinwright_benchmarks {

std::size_t Settings::count(double full) const {
    return static_cast<std::size_t>(std::max(1000.0, std::round(full * scale)));
}

int Settings::side(double full) const {
    return static_cast<int>(std::max(32.0, std::round(full * std::sqrt(scale))));
}

namespace {

struct Benchmark {
    const char* name;
    void (*run)(const Settings& settings);
};

constexpr std::array kBenchmarks{Benchmark{"delaunay", run_delaunay},
                                 Benchmark{"raster", run_raster},
                                 Benchmark{"job", run_job},
                                 Benchmark{"read", run_read},
                                 Benchmark{"criteria", run_criteria},
                                 Benchmark{"criteria_growth", run_criteria_growth},
                                 Benchmark{"criteria_worst", run_criteria_worst},
                                 Benchmark{"length", run_length},
                                 Benchmark{"length_growth", run_length_growth},
                                 Benchmark{"length_worst", run_length_worst},
                                 Benchmark{"noding", run_noding},
                                 Benchmark{"constrained", run_constrained},
                                 Benchmark{"conforming", run_conforming},
                                 Benchmark{"contour", run_contour},
                                 Benchmark{"clough_tocher", run_clough_tocher},
                                 Benchmark{"accuracy", run_accuracy},
                                 Benchmark{"convergence", run_convergence},
                                 Benchmark{"natural_neighbor", run_natural_neighbor},
                                 Benchmark{"smooth", run_smooth},
                                 Benchmark{"transform", run_transform},
                                 Benchmark{"grid_crs", run_grid_crs}};

constexpr const char* kUsage =
    "usage: tinwright_benchmarks delaunay|raster|job|read|criteria|criteria_growth|criteria_worst|\n"
    "                            length|length_growth|length_worst|noding|constrained|conforming|contour|\n"
    "                            clough_tocher|accuracy|convergence|natural_neighbor|smooth|\n"
    "                            transform|grid_crs\n"
    "           [--rounds K] [--scale FRACTION] [--tinwright COMMAND] [--images FOLDER]\n"
    "           [--data FOLDER] [--sets NAME,...] [--methods METHOD[/GRADIENTS][@CRITERION[:ORDER]],...]\n"
    "Prints a table of docs/benchmarks.md or docs/interpolation.md. Medians of K interleaved runs (default "
    "5).\n"
    "Accuracy is measured on the data sets in FOLDER (default: the environment's TINWRIGHT_DATA) and on\n"
    "generated ones, or on those whose names begin with a NAME.\n";

double positive(const std::string& text) {
    const double value = std::strtod(text.c_str(), nullptr);
    if (!(value > 0)) {
        throw std::runtime_error("needs a positive number, not " + text);
    }
    return value;
}

/// A folder that is gone at the end.
class Scratch {
  public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "tinwright_benchmarks_XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error("cannot make the folder " + name);
        }
        path_ = name;
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

/// composite INPUT OUTPUT X0 Y0 X1 Y1 SIDE: a peer that `job` measures as a process of its own.
int composite(const std::vector<std::string>& arguments) {
    if (arguments.size() != 8) {
        throw std::runtime_error("composite takes INPUT OUTPUT X0 Y0 X1 Y1 SIDE");
    }
    const auto value = [&](std::size_t i) { return std::strtod(arguments[i].c_str(), nullptr); };
    const double side = value(7);
    const auto cells = static_cast<std::int64_t>(side);
    run_composite(
        arguments[1],
        {value(3), value(6), (value(5) - value(3)) / side, (value(6) - value(4)) / side, cells, cells},
        arguments[2]);
    return 0;
}

int run(const std::vector<std::string>& arguments) {
    if (!arguments.empty() && arguments[0] == "composite") {
        return composite(arguments);
    }
    Settings settings;
    settings.tinwright = TINWRIGHT_COMMAND;
    if (const char* folder = std::getenv("TINWRIGHT_DATA")) {
        settings.data = folder;
    }
    const Benchmark* chosen = nullptr;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const bool has_value = i + 1 < arguments.size();
        if (arguments[i] == "--rounds" && has_value) {
            settings.rounds = static_cast<int>(std::ceil(positive(arguments[++i])));
        } else if (arguments[i] == "--scale" && has_value) {
            settings.scale = positive(arguments[++i]);
        } else if (arguments[i] == "--tinwright" && has_value) {
            settings.tinwright = arguments[++i];
        } else if (arguments[i] == "--images" && has_value) {
            settings.images = arguments[++i];
        } else if (arguments[i] == "--data" && has_value) {
            settings.data = arguments[++i];
        } else if (arguments[i] == "--sets" && has_value) {
            settings.sets = arguments[++i];
        } else if (arguments[i] == "--methods" && has_value) {
            settings.methods = arguments[++i];
        } else {
            for (const Benchmark& benchmark : kBenchmarks) {
                chosen = arguments[i] == benchmark.name ? &benchmark : chosen;
            }
        }
    }
    if (chosen == nullptr) {
        std::fputs(kUsage, stderr);
        return 2;
    }
    if (settings.scale != 1) {
        std::fputs("benchmark: not the full size: figures and targets do not compare\n", stderr);
    }
    const Scratch scratch;
    settings.scratch = scratch.path();
    chosen->run(settings);
    return 0;
}

}  // namespace

}  // namespace tinwright_benchmarks

int main(int count, char** texts) {
    try {
        return tinwright_benchmarks::run(std::vector<std::string>(texts + 1, texts + count));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "benchmark: %s\n", error.what());
        return 1;
    }
}
