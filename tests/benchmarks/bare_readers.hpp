#ifndef TINWRIGHT_TESTS_BENCHMARKS_BARE_READERS_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_BARE_READERS_HPP

#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"

/// The least that reading can take: no check, no message, no column found, no second format.
namespace tinwright_benchmarks {

/// Reads a whole file of x y z rows at once, then std::from_chars three numbers a row.
std::vector<tinwright::Point3> read_text_barely(const std::string& path);

/// Copies the coordinates out of the WKB points of the first layer's Arrow stream.
std::vector<tinwright::Point3> read_arrow_barely(const std::string& path);

}  // namespace tinwright_benchmarks

#endif
