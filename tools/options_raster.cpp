#include "options_raster.hpp"

#include "tinwright/geometry/decimal.hpp"

#include "option_values.hpp"

namespace tinwright::tools {

namespace {

Box parse_extent(const std::vector<std::string>& texts) {
    Box box;
    box.x_min = number_value("--extent", texts[0]);
    box.y_min = number_value("--extent", texts[1]);
    box.x_max = number_value("--extent", texts[2]);
    box.y_max = number_value("--extent", texts[3]);
    if (!(box.x_min < box.x_max && box.y_min < box.y_max)) {
        throw UsageError("--extent takes XMIN YMIN XMAX YMAX with XMIN below XMAX and YMIN below YMAX, not " +
                         decimal_text(box.x_min) + " " + decimal_text(box.y_min) + " " +
                         decimal_text(box.x_max) + " " + decimal_text(box.y_max));
    }
    return box;
}

Point2 parse_resolution(const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) {
        const double both = positive_value("--resolution", text);
        return {both, both};
    }
    return {positive_value("--resolution", text.substr(0, comma)),
            positive_value("--resolution", text.substr(comma + 1))};
}

}  // namespace

void RasterOptions::add_geometry_to(CLI::App& parser) {
    add_values(parser, "--extent", extent_texts, 4, "X0 Y0 X1 Y1", "xmin ymin xmax ymax (-te)");
    add_value(parser, "--resolution", resolution_text, "R | RX RY", "cell size (-tr)");
    add_values(parser, "--size", size_texts, 2, "COLS ROWS", "raster size (-ts)");
    parser.add_flag("--tap", tap, "cell edges at multiples of the resolution");
    add_value(parser, "--like", like, "RASTER", "take the geometry of that raster");
}

void RasterOptions::add_values_to(CLI::App& parser) {
    add_value(parser, "--ot", data_type, "TYPE", "Float32 (default), Float64, Int16, UInt16, ...");
    add_value(parser, "--nodata", nodata_text, "VALUE", "value outside the domain (default -9999)");
    add_value(parser, "--preview", preview, "FILE.png", "write a shaded picture too");
}

void RasterOptions::finish() {
    const bool has_geometry = !extent_texts.empty() || !resolution_text.empty() || !size_texts.empty() || tap;
    if (!like.empty() && has_geometry) {
        throw UsageError(
            "--like brings its own geometry: --extent, --resolution, --size and --tap cannot be added");
    }
    if (!extent_texts.empty()) {
        request.extent = parse_extent(extent_texts);
    }
    if (!resolution_text.empty()) {
        request.resolution = parse_resolution(resolution_text);
    }
    if (!size_texts.empty()) {
        request.size = GridRequest::Size{whole_value("--size", size_texts[0], 1),
                                         whole_value("--size", size_texts[1], 1)};
    }
    if (tap && !request.resolution) {
        throw UsageError("--tap needs --resolution: edges are put at multiples of it");
    }
    request.align_to_resolution = tap;
    if (!nodata_text.empty()) {
        nodata = find_number(nodata_text);  // "nan" and "inf" are NoData values too
        if (!nodata) {
            throw UsageError("--nodata needs a number, not " + io::quoted(nodata_text));
        }
    }
}

}  // namespace tinwright::tools
