// Reads a source description and a CRS through the installed I/O library.
#include <cstdio>

#include "tinwright/io/crs.hpp"
#include "tinwright/io/source.hpp"

int main() {
    const tinwright::io::Source source = tinwright::io::parse_source("survey.gpkg,layer=points");
    const tinwright::io::Crs crs = tinwright::io::Crs::parse("EPSG:25832");
    std::printf("%s %s\n", source.path.c_str(), crs.code().c_str());
    return source.layer == "points" && crs.code() == "EPSG:25832" ? 0 : 1;
}
