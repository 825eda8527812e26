#ifndef TINWRIGHT_IO_TRANSFORM_CHOICE_HPP
#define TINWRIGHT_IO_TRANSFORM_CHOICE_HPP

#include <optional>
#include <string>

#include "tinwright/io/coordinate_transform.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/proj_handles.hpp"

namespace tinwright::io {

/// Private to CoordinateTransform: which of PROJ's operations between two systems is taken.
struct TransformChoice {
    /// Takes and gives easting or longitude first. Of several operations when no extent is given: PROJ then
    /// chooses for each point.
    ProjObject way;
    std::string name;
    std::optional<double> accuracy;  ///< metres
    std::string warning;             ///< one line, or empty
};

/// Throws InputError as the constructor of CoordinateTransform does. The result lives in `context`.
TransformChoice choose_transform(PJ_CONTEXT* context, const Crs& from, const Crs& to,
                                 const TransformOptions& options);

}  // namespace tinwright::io

#endif
