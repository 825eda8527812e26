#include "options_output.hpp"

#include <filesystem>
#include <system_error>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/atomic_output.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::tools {

void OutputOptions::add_to(CLI::App& parser, const std::string& what, const std::string& drivers) {
    add_value(parser, "-o,--output", path, "FILE", what);
    parser.add_flag("--overwrite", overwrite, "replace the output when it exists");
    add_value(parser, "--of", driver, "DRIVER", drivers);
}

void OutputOptions::add_creation_options_to(CLI::App& parser) {
    add_repeatable(parser, "--co", creation_options, "KEY=VALUE", "creation option of the GDAL driver");
}

void OutputOptions::finish(bool is_required) const {
    if (path.empty() && is_required) {
        throw UsageError("no output is given: name it with -o FILE");
    }
    check_key_values("--co", creation_options);
}

bool OutputOptions::is_stdout() const { return path.starts_with("/vsistdout") || path == "/dev/stdout"; }

void check_output_place(const std::string& output, bool overwrite) {
    if (!output.empty()) {
        const io::AtomicOutput trial(output, overwrite);
    }
}

void refuse_same_file(const std::string& option, const std::string& file, const std::string& other_option,
                      const std::string& other_file) {
    if (!file.empty() && file == other_file) {
        throw UsageError(option + " and " + other_option + " name the same file " + io::quoted(file));
    }
}

void refuse_to_overwrite_sources(const std::string& output, std::span<const io::Source> sources) {
    if (output.empty()) {
        return;
    }
    for (const io::Source& source : sources) {
        std::error_code ignored;  // a file that does not exist is no conflict
        if (output == source.path || std::filesystem::equivalent(output, source.path, ignored)) {
            throw UsageError("the output " + io::quoted(output) +
                             " is also read: choose another name, a source is never overwritten");
        }
    }
}

void check_key_values(const std::string& option, std::span<const std::string> values) {
    for (const std::string& value : values) {
        if (value.find('=') == std::string::npos || value.front() == '=') {
            throw UsageError(option + " needs KEY=VALUE, not " + io::quoted(value));
        }
    }
}

}  // namespace tinwright::tools
