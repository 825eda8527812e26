#ifndef TINWRIGHT_IO_LINE_PLAN_HPP
#define TINWRIGHT_IO_LINE_PLAN_HPP

#include <optional>
#include <string>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/io/source.hpp"
#include "tinwright/io/vector_layer.hpp"

/// Private to the reader of lines: which layers have lines, and what is taken from one.
namespace tinwright::io {

/// What to take from the features of a layer; fields are indices, -1 for none.
struct LinePlan {
    LineRole role = LineRole::Breakline;
    std::string where;  ///< for messages: `file "a.gpkg", layer "p"`
    int z_field = -1;
    std::optional<double> z_constant;
    bool is_draped = false;     ///< z is none of the file's business
    bool may_lack_z = false;    ///< geometries without z are draped
    bool keeps_faults = false;  ///< as ReadLinesOptions::keep_faults
    int across_field = -1;
    bool is_sharp = true;  ///< where there is no such field
    std::string advice;    ///< what to try when z is missing
};

/// The plan for a layer as the source's keys say. Throws InputError where the layer's declared type tells
/// that no feature can be used, skipped bad ones or not.
LinePlan make_line_plan(const VectorLayer& layer, const Source& source, LineRole role, bool keeps_faults);

/// How the layer is found where the source names none.
VectorLayer::Wanted wanted_lines();

}  // namespace tinwright::io

#endif
