#include "options_talk.hpp"

#include "tinwright/geometry/error.hpp"

namespace tinwright::tools {

void TalkOptions::add_to(CLI::App& parser) {
    parser.add_flag("-q,--quiet", quiet, "only errors and warnings");
    parser.add_flag("-v,--verbose", verbose, "explain more, with times and memory");
    parser.add_flag("--json", json, "report as one JSON object on standard output");
    parser.add_flag("--progress", progress, "show progress though stderr is no terminal");
    parser.add_flag("--no-progress", no_progress, "show no progress");
}

void TalkOptions::finish(bool other_output_is_stdout) const {
    if (quiet && verbose) {
        throw UsageError("--quiet and --verbose exclude each other");
    }
    if (progress && no_progress) {
        throw UsageError("--progress and --no-progress exclude each other");
    }
    if (json && other_output_is_stdout) {
        throw UsageError("--json and the output both want standard output: write the output to a file");
    }
}

}  // namespace tinwright::tools
