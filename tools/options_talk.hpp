#ifndef TINWRIGHT_TOOLS_OPTIONS_TALK_HPP
#define TINWRIGHT_TOOLS_OPTIONS_TALK_HPP

#include "parse_options.hpp"

namespace tinwright::tools {

/// What a command says, and where.
struct TalkOptions {
    bool quiet = false;
    bool verbose = false;
    bool json = false;
    bool progress = false;     ///< --progress: even when stderr is no terminal
    bool no_progress = false;  ///< --no-progress

    void add_to(CLI::App& parser);
    /// Throws UsageError for options that exclude each other; `other_output_is_stdout`: the command's
    /// output goes to standard output as well.
    void finish(bool other_output_is_stdout) const;
};

}  // namespace tinwright::tools

#endif
