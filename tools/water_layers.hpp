#ifndef TINWRIGHT_TOOLS_WATER_LAYERS_HPP
#define TINWRIGHT_TOOLS_WATER_LAYERS_HPP

#include <memory>
#include <string>

#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/write_tin.hpp"

#include "leveled_water.hpp"

/// Water as layers of a file; fields as in docs/formats.md.
namespace tinwright::tools {

/// Writes the layer `findings`, points with z, with any vector driver (`driver` empty: the one of the
/// extension). The file is complete but under its temporary name: `commit` moves it into place. Throws
/// UsageError, IoError.
std::unique_ptr<io::AtomicOutput> write_findings(const LeveledWater& leveled, const std::string& target,
                                                 const std::string& driver, bool overwrite,
                                                 const io::TinMetadata& metadata);

/// Likewise a GeoPackage with the layers `reaches`, `sections`, `lakes` and `findings`.
std::unique_ptr<io::AtomicOutput> write_water(const LeveledWater& leveled, const std::string& target,
                                              bool overwrite, const io::TinMetadata& metadata);

}  // namespace tinwright::tools

#endif
