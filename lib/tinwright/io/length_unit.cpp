#include "tinwright/io/length_unit.hpp"

namespace tinwright::io {

std::optional<LengthUnit> find_length_unit(std::string_view /*spelling*/) { return std::nullopt; }
LengthUnit length_unit_of(double metres, const std::string& name) { return {name, metres}; }
double unit_factor(const std::string& /*from*/, const std::string& /*to*/) { return 1; }

}  // namespace tinwright::io
