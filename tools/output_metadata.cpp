#include "output_metadata.hpp"

#include "tinwright/geometry/decimal.hpp"

namespace tinwright::tools {

namespace {

/// The options that made the surface.
std::string surface_options(const Surface& surface, const TriangulationOptions& triangulation,
                            const LineOptions& lines) {
    if (surface.report) {
        const std::string& references = surface.reference_options;
        return triangulation.canonical() + lines.canonical() + (references.empty() ? "" : " " + references);
    }
    std::string options = metadata_value(surface.metadata, "TINWRIGHT_OPTIONS");
    if (triangulation.max_edge) {
        options += (options.empty() ? "--max-edge " : " --max-edge ") + decimal_text(*triangulation.max_edge);
    }
    return options;
}

}  // namespace

io::TinMetadata output_metadata(const std::string& command, const Surface& surface,
                                const TriangulationOptions& triangulation, const LineOptions& lines,
                                const std::string& reading) {
    io::TinMetadata metadata{{"TINWRIGHT_VERSION", TINWRIGHT_VERSION}, {"TINWRIGHT_COMMAND", command}};
    const io::TinMetadata units = unit_metadata(surface);
    metadata.insert(metadata.end(), units.begin(), units.end());
    const io::TinMetadata criterion = criterion_metadata(surface.criterion);
    metadata.insert(metadata.end(), criterion.begin(), criterion.end());
    const io::TinMetadata of_lines = lines_metadata(surface.lines);
    metadata.insert(metadata.end(), of_lines.begin(), of_lines.end());
    const io::TinMetadata of_water =
        surface.water ? water_metadata(*surface.water) : water_metadata_of(surface.metadata);
    metadata.insert(metadata.end(), of_water.begin(), of_water.end());
    if (surface.flat_faces) {
        const io::TinMetadata flat = flat_faces_metadata(*surface.flat_faces);
        metadata.insert(metadata.end(), flat.begin(), flat.end());
    } else if (const std::string flat = metadata_value(surface.metadata, kFlatFacesKey); !flat.empty()) {
        metadata.emplace_back(kFlatFacesKey, flat);
    }
    const std::string before = surface_options(surface, triangulation, lines);
    metadata.emplace_back("TINWRIGHT_OPTIONS", before.empty() ? reading : before + " " + reading);
    return metadata;
}

}  // namespace tinwright::tools
