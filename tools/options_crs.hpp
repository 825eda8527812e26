#ifndef TINWRIGHT_TOOLS_OPTIONS_CRS_HPP
#define TINWRIGHT_TOOLS_OPTIONS_CRS_HPP

#include <optional>
#include <string>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/height_request.hpp"
#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"
#include "tinwright/io/working_plane.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// The coordinate systems: of sources, of the plane that is worked in, of what is written; units and
/// references of elevations.
struct CrsOptions {
    std::string crs_text;
    std::string source_crs_text;
    std::string working_crs_text;
    std::string max_distortion_text;
    std::string z_unit_text;
    std::string z_scale_text;
    std::string target_z_unit_text;
    std::string geoid_text;
    std::string heights_text;
    std::string epoch_text;

    // After `finish`:
    io::PlaneRequest plane;
    io::HeightRequest heights;
    std::optional<double> epoch;

    /// `shows_heights`: the help screen has room for what is about elevations.
    void add_to(CLI::App& parser, bool shows_heights = true);
    /// Reads the texts. Throws UsageError.
    void finish();

    /// What is made is in it; unknown when not given. Throws UsageError.
    [[nodiscard]] io::Crs crs() const;
    /// The system of sources that carry none; unknown when not given. Throws UsageError.
    [[nodiscard]] io::Crs source_crs() const;
    /// Hands all of it to a reader.
    void apply_to(io::ReadOptions& options) const;
    /// Lines are brought to the samples' plane and unit, where those have any.
    void apply_to(io::ReadLinesOptions& options, const io::Samples& samples) const;
    /// The first option given that a TIN, whose vertices are as they are, leaves no room for, or empty.
    [[nodiscard]] std::string option_for_samples_only() const;
    /// The options that affect results, in a fixed order: what outputs record.
    [[nodiscard]] std::string canonical() const;
};

}  // namespace tinwright::tools

#endif
