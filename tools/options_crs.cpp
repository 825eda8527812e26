#include "options_crs.hpp"

namespace tinwright::tools {

void CrsOptions::add_to(CLI::App& parser) {
    add_value(parser, "--source-crs", source_crs_text, "CRS", "CRS of sources that carry none (-a_srs)");
    add_value(parser, "--crs", crs_text, "CRS", "working CRS: sources are transformed to it");
}

io::Crs CrsOptions::crs() const { return crs_text.empty() ? io::Crs() : io::Crs::parse(crs_text); }

io::Crs CrsOptions::source_crs() const {
    return source_crs_text.empty() ? io::Crs() : io::Crs::parse(source_crs_text);
}

}  // namespace tinwright::tools
