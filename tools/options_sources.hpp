#ifndef TINWRIGHT_TOOLS_OPTIONS_SOURCES_HPP
#define TINWRIGHT_TOOLS_OPTIONS_SOURCES_HPP

#include <string>
#include <vector>

#include "tinwright/io/source.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// Positional sources and how they are read.
struct SourceOptions {
    std::vector<std::string> texts;
    std::vector<std::string> open_options;
    bool skip_bad = false;
    std::vector<io::Source> sources;  ///< after `finish`

    /// The sources and --oo.
    void add_to(CLI::App& parser);
    void add_skip_bad_to(CLI::App& parser);
    /// Parses the sources. Throws UsageError when there is none, unless `may_be_none`.
    void finish(bool may_be_none = false);
};

}  // namespace tinwright::tools

#endif
