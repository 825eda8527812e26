#ifndef TINWRIGHT_TOOLS_OPTIONS_OUTPUT_HPP
#define TINWRIGHT_TOOLS_OPTIONS_OUTPUT_HPP

#include <span>
#include <string>
#include <vector>

#include "tinwright/io/source.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// -o and how that file is created.
struct OutputOptions {
    std::string path;
    bool overwrite = false;
    std::string driver;
    std::vector<std::string> creation_options;

    /// -o, --overwrite and --of.
    void add_to(CLI::App& parser, const std::string& what, const std::string& drivers);
    void add_creation_options_to(CLI::App& parser);
    /// Throws UsageError: -o missing where it is needed, a creation option that is not KEY=VALUE.
    void finish(bool is_required) const;

    /// Whether the output goes to standard output.
    [[nodiscard]] bool is_stdout() const;
};

/// Throws IoError when the output exists and may not be replaced, or when its folder cannot be written: found
/// before any work is done. Leaves nothing behind.
void check_output_place(const std::string& output, bool overwrite);

/// Throws UsageError when two options that write name one file; neither may be empty for that.
void refuse_same_file(const std::string& option, const std::string& file, const std::string& other_option,
                      const std::string& other_file);

/// Throws UsageError when `output` is one of the files that are read, by name or as the same file on disk.
void refuse_to_overwrite_sources(const std::string& output, std::span<const io::Source> sources);
/// Throws UsageError when a creation option is not KEY=VALUE.
void check_key_values(const std::string& option, std::span<const std::string> values);

}  // namespace tinwright::tools

#endif
