#ifndef TINWRIGHT_TOOLS_OPTIONS_CRS_HPP
#define TINWRIGHT_TOOLS_OPTIONS_CRS_HPP

#include <string>

#include "tinwright/io/crs.hpp"

#include "parse_options.hpp"

namespace tinwright::tools {

/// --crs and --source-crs.
struct CrsOptions {
    std::string crs_text;
    std::string source_crs_text;

    void add_to(CLI::App& parser);

    /// The working system; unknown when not given. Throws UsageError.
    [[nodiscard]] io::Crs crs() const;
    /// The system of sources that carry none; unknown when not given. Throws UsageError.
    [[nodiscard]] io::Crs source_crs() const;
};

}  // namespace tinwright::tools

#endif
