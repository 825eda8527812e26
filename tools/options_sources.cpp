#include "options_sources.hpp"

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::tools {

void SourceOptions::add_to(CLI::App& parser) {
    parser.add_option("sources", texts);
    add_repeatable(parser, "--oo", open_options, "KEY=VALUE", "GDAL open option for every source");
}

void SourceOptions::add_skip_bad_to(CLI::App& parser) {
    parser.add_flag("--skip-bad", skip_bad, "count unusable rows and features and go on");
}

void SourceOptions::finish(bool may_be_none) {
    if (texts.empty() && !may_be_none) {
        throw UsageError("no source is given: name a file with points, such as survey.csv");
    }
    for (const std::string& option : open_options) {
        if (option.find('=') == std::string::npos) {
            throw UsageError("--oo needs KEY=VALUE, not " + io::quoted(option));
        }
    }
    sources.clear();
    for (const std::string& text : texts) {
        io::Source source = io::parse_source(text);
        source.open_options.insert(source.open_options.begin(), open_options.begin(), open_options.end());
        sources.push_back(std::move(source));
    }
}

}  // namespace tinwright::tools
