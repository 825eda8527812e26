#ifndef TINWRIGHT_TOOLS_REPAIR_HPP
#define TINWRIGHT_TOOLS_REPAIR_HPP

#include <span>
#include <string>
#include <vector>

#include "tinwright/breaklines/line_repair.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/source.hpp"

namespace tinwright::tools {

/// Where repaired lines go: one GeoPackage a file that lines were read from, one layer a source.
struct RepairPlan {
    struct File {
        std::string target;
        std::vector<std::size_t> slices;  ///< of the lines that were read
        std::vector<std::string> layers;  ///< name of each one's layer
    };
    std::string folder;
    std::vector<File> files;
};

/// `folder/<name>.gpkg` for each file that lines were read from, numbered where names are the same, or one is
/// `taken` by another file. Throws UsageError when a target is one of `sources`, IoError when one exists and
/// may not be replaced, or when the folder is none.
RepairPlan plan_repair(const io::Lines& lines, const std::string& folder, bool overwrite,
                       std::span<const io::Source> sources, const std::string& taken = "");

/// Puts lines right, draping what has no z on the samples if there are three or more not on one line.
/// `options`: without `drape`.
LineRepair repair_lines_on_samples(const io::Lines& lines, const io::Samples& samples,
                                   LineRepairOptions options);

/// A folder that is there for the files in it, and goes with them when writing fails.
class OutputFolder {
  public:
    /// Makes it if there is none. Throws IoError.
    explicit OutputFolder(std::string folder);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    void keep() { is_kept_ = true; }

  private:
    std::string folder_;
    bool is_new_ = false;
    bool is_kept_ = false;
};

/// Of each line what became of it: parts of two points or more.
using RepairedLines = std::vector<std::vector<std::vector<Point3>>>;

/// Writes repaired lines as planned, into the plan's folder, which is there; `sources`: of the lines, as
/// `read_lines` got them. Returns a line for the report a layer: "clean/roads.gpkg: layer roads, 12 features,
/// 1 left out".
std::vector<std::string> write_repair(const RepairedLines& repaired, const io::Lines& lines,
                                      std::span<const io::LineSource> sources, const RepairPlan& plan,
                                      const io::Crs& crs, bool overwrite);

}  // namespace tinwright::tools

#endif
