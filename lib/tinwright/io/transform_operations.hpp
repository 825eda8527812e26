#ifndef TINWRIGHT_IO_TRANSFORM_OPERATIONS_HPP
#define TINWRIGHT_IO_TRANSFORM_OPERATIONS_HPP

#include <optional>
#include <string>
#include <vector>

#include "tinwright/io/geographic_extent.hpp"
#include "tinwright/io/proj_handles.hpp"

namespace tinwright::io {

/// One of the ways between two systems that PROJ's database and its own reasoning offer.
struct Operation {
    ProjObject object;
    std::string name;
    std::optional<double> accuracy;  ///< metres, as the authority states it
    /// A shift between datums that is not known is taken to be none.
    bool is_ballpark = false;
    /// The files it needs that are not there.
    std::vector<std::string> missing_grids;
    /// Whether all of those are files that PROJ's own collection has.
    bool is_obtainable = true;
    /// Epochs that shifts which change with time refer to, as PROJ writes them: "2020"; empty when none do.
    std::vector<std::string> epochs;

    /// A shift between vertical datums that is not known is taken to be none.
    [[nodiscard]] bool has_unknown_heights() const;
    /// Whether it is meant for all of `extent`; true when that is empty.
    [[nodiscard]] bool covers(PJ_CONTEXT* context, const GeographicExtent& extent) const;
};

/// Which operations are looked for.
struct OperationQuery {
    bool has_ballpark = true;
    /// As if all grids were there.
    bool has_missing_grids = false;
    GeographicExtent extent{};
};

/// Operations from `source` to `target`, the best first: by the part of the extent that they are meant for,
/// then by accuracy. They live in `context`.
std::vector<Operation> find_operations(PJ_CONTEXT* context, const PJ* source, const PJ* target,
                                       const OperationQuery& query);

}  // namespace tinwright::io

#endif
