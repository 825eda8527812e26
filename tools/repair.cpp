#include "repair.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>

#include "tinwright/delaunay/drape.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/write_lines.hpp"

#include "options_output.hpp"

namespace tinwright::tools {

namespace {

/// `wanted`, or the first of wanted-2, wanted-3, ... that is free; takes it.
std::string take_name(const std::string& wanted, std::set<std::string>& taken) {
    std::string name = wanted;
    for (int i = 2; !taken.insert(name).second; ++i) {
        name = wanted + "-" + std::to_string(i);
    }
    return name;
}

std::string stem_of(const std::string& file) {
    const std::string stem = std::filesystem::path(file).stem().string();
    return stem.empty() ? "lines" : stem;
}

bool is_virtual(const std::string& folder) { return folder.starts_with("/vsi"); }

/// The samples' Delaunay TIN, asked in CRS units.
class SampleDrape {
  public:
    explicit SampleDrape(std::span<const Point3> samples, const FoundLattice& found)
        : vertices_(make_sample_vertices(samples, found, {DuplicatePolicy::Mean, 0})),
          drape_(vertices_.keys, vertices_.z) {}

    [[nodiscard]] double at(Point2 location) { return drape_.at(vertices_.lattice.key(location)).z; }

  private:
    SampleVertices vertices_;
    Drape drape_;
};

/// Null where samples are too few to drape anything on.
std::shared_ptr<SampleDrape> make_drape(const io::Samples& samples, const io::Lines& lines) {
    constexpr std::size_t kFewest = 3;
    if (samples.points.size() < kFewest) {
        return nullptr;
    }
    std::vector<Point3> line_points;
    for (const Breakline& line : lines.lines) {
        line_points.insert(line_points.end(), line.points.begin(), line.points.end());
    }
    FoundLattice found = find_lattice(samples.points, line_points);
    const Key2 largest = found.lattice.key({found.bounds.x_max, found.bounds.y_max});
    found.lattice = found.lattice.refined(found.lattice.refinement_room(std::max(largest.x, largest.y)));
    try {
        return std::make_shared<SampleDrape>(samples.points, found);
    } catch (const InputError&) {
        return nullptr;  // all samples on one line
    }
}

bool needs_drape(const io::Lines& lines) {
    return std::any_of(lines.parts.begin(), lines.parts.end(),
                       [](const io::LinePart& part) { return part.lacks_z; });
}

}  // namespace

OutputFolder::OutputFolder(std::string folder) : folder_(std::move(folder)) {
    std::error_code error;
    if (!is_virtual(folder_) && !std::filesystem::create_directories(folder_, error) && error) {
        throw IoError("cannot make the folder " + io::quoted(folder_) + ": " + error.message());
    }
    is_new_ = !is_virtual(folder_) && std::filesystem::is_empty(folder_, error);
}

OutputFolder::~OutputFolder() {
    if (is_new_ && !is_kept_) {
        std::error_code ignored;  // there is nothing else that could be done
        std::filesystem::remove(folder_, ignored);
    }
}

RepairPlan plan_repair(const io::Lines& lines, const std::string& folder, bool overwrite,
                       std::span<const io::Source> sources, const std::string& taken) {
    std::error_code ignored;  // of a folder that is not there
    const bool is_there = is_virtual(folder) || std::filesystem::exists(folder, ignored);
    if (is_there && !is_virtual(folder) && !std::filesystem::is_directory(folder, ignored)) {
        throw IoError("cannot write into " + io::quoted(folder) +
                      ": it is a file, and repaired lines need a folder");
    }
    RepairPlan plan;
    plan.folder = folder;
    std::vector<std::string> files;
    std::vector<std::set<std::string>> layers;
    std::set<std::string> stems{taken};
    for (std::size_t i = 0; i < lines.slices.size(); ++i) {
        const io::LineSlice& slice = lines.slices[i];
        const auto known = std::find(files.begin(), files.end(), slice.file);
        const auto file = static_cast<std::size_t>(known - files.begin());
        if (known == files.end()) {
            files.push_back(slice.file);
            layers.emplace_back();
            plan.files.push_back({folder + "/" + take_name(stem_of(slice.file), stems) + ".gpkg", {}, {}});
        }
        plan.files[file].slices.push_back(i);
        plan.files[file].layers.push_back(take_name(slice.layer, layers[file]));
    }
    for (const RepairPlan::File& file : plan.files) {
        refuse_to_overwrite_sources(file.target, sources);
        if (is_there) {
            check_output_place(file.target, overwrite);
        }
    }
    return plan;
}

LineRepair repair_lines_on_samples(const io::Lines& lines, const io::Samples& samples,
                                   LineRepairOptions options) {
    if (needs_drape(lines)) {
        if (const auto drape = make_drape(samples, lines)) {
            options.drape = [drape](Point2 location) { return drape->at(location); };
        }
    }
    return repair_lines(lines.lines, samples.points, options);
}

std::vector<std::string> write_repair(const RepairedLines& repaired, const io::Lines& lines,
                                      std::span<const io::LineSource> sources, const RepairPlan& plan,
                                      const io::Crs& crs, bool overwrite) {
    std::vector<std::string> report;
    for (const RepairPlan::File& file : plan.files) {
        std::vector<io::ChangedLines> layers;
        for (std::size_t i = 0; i < file.slices.size(); ++i) {
            const io::LineSlice& slice = lines.slices[file.slices[i]];
            io::ChangedLines changed{sources[slice.source].source, file.layers[i], {}};
            if (!changed.source.sql) {
                changed.source.layer = slice.layer;
            }
            for (std::size_t line = slice.first; line < slice.first + slice.count; ++line) {
                changed.curves[{lines.parts[line].feature, lines.parts[line].part}] = repaired[line];
            }
            layers.push_back(std::move(changed));
        }
        for (const io::WrittenLines& written : io::write_changed_lines(layers, crs, file.target, overwrite)) {
            report.push_back(file.target + ": layer " + written.layer + ", " +
                             std::to_string(written.features) +
                             (written.features == 1 ? " feature" : " features") +
                             (written.left_out > 0 ? ", " + std::to_string(written.left_out) + " left out"
                                                   : std::string()));
        }
    }
    return report;
}

}  // namespace tinwright::tools
