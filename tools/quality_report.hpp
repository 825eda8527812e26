#ifndef TINWRIGHT_TOOLS_QUALITY_REPORT_HPP
#define TINWRIGHT_TOOLS_QUALITY_REPORT_HPP

#include <string>

#include "tinwright/criteria/quality.hpp"

#include "json_value.hpp"
#include "surface_input.hpp"

/// What `info` adds to the report of a job.
namespace tinwright::tools {

/// Layers that were read, range of z, and what a TIN file says about itself.
std::string content_text(const Surface& surface);
void add_content_json(JsonValue& json, const Surface& surface);

/// Range, histogram and worst faces of each measure.
std::string quality_text(const Surface& surface, const QualityReport& quality);
void add_quality_json(JsonValue& json, const Surface& surface, const QualityReport& quality);

}  // namespace tinwright::tools

#endif
