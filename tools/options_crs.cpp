#include "options_crs.hpp"

namespace tinwright::tools {

void CrsOptions::add_to(CLI::App& parser) {
    add_value(parser, "--source-crs", source_crs_text, "CRS", "CRS of sources that carry none (-a_srs)");
    add_value(parser, "--crs", crs_text, "CRS", "working CRS: sources are transformed to it");
}

void CrsOptions::finish() {}

io::Crs CrsOptions::crs() const { return crs_text.empty() ? io::Crs() : io::Crs::parse(crs_text); }

io::Crs CrsOptions::source_crs() const {
    return source_crs_text.empty() ? io::Crs() : io::Crs::parse(source_crs_text);
}

void CrsOptions::apply_to(io::ReadOptions& options) const {
    options.crs = crs();
    options.source_crs = source_crs();
    options.plane = plane;
    options.heights = heights;
    options.epoch = epoch;
}

void CrsOptions::apply_to(io::ReadLinesOptions& options) const {
    options.source_crs = source_crs();
    options.plane = plane;
    options.heights = heights;
    options.epoch = epoch;
}

std::string CrsOptions::option_for_samples_only() const { return {}; }

std::string CrsOptions::canonical() const { return {}; }

}  // namespace tinwright::tools
