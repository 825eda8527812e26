#include "tinwright/io/transform_choice.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/transform_operations.hpp"

namespace tinwright::io {
namespace {

/// What is transformed to what, in PROJ's objects and in words.
struct Ends {
    ProjObject source;
    ProjObject target;
    std::string text;  // "from A to B"
};

ProjObject make_system(PJ_CONTEXT* context, const Crs& crs, bool has_elevations) {
    if (crs.is_geocentric()) {
        throw InputError("CRS " + crs.name() +
                         " is geocentric: X, Y, Z from the earth's centre, no positions with elevations; "
                         "transform the data to longitudes, latitudes and heights first, for example with "
                         "cs2cs to EPSG:4979");
    }
    ProjObject system(proj_create(context, (has_elevations ? crs : crs.horizontal()).wkt().c_str()));
    if (system && !has_elevations && proj_get_type(system.get()) == PJ_TYPE_COMPOUND_CRS) {
        system.reset(proj_crs_get_sub_crs(context, system.get(), 0));
    }
    if (!system) {
        throw InputError("CRS " + crs.name() + " is not understood by PROJ");
    }
    return system;
}

/// Elevations that nothing is known about cannot be brought to what is known.
void check_heights(const Crs& from, const Crs& to) {
    for (const Crs* const crs : {&from, &to}) {
        if (crs->z_unit().empty()) {
            throw InputError("elevations cannot be transformed from " + from.name() + " to " + to.name() +
                             ": " + crs->name() +
                             " does not say what z is measured from; name a system that does, for example "
                             "EPSG:32632+5773 for heights above the geoid EGM96");
        }
    }
}

std::string list(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) {
        text += (text.empty() ? "" : ", ") + item;
    }
    return text;
}

std::string in_words(const std::optional<double>& accuracy) {
    return accuracy ? "accuracy " + decimal_text(*accuracy) + " m" : "accuracy unknown";
}

/// "NAME needs the grid FILE, which is not in FOLDERS".
std::string missing_text(const Operation& operation) {
    const bool is_one = operation.missing_grids.size() == 1;
    return operation.name + " (" + in_words(operation.accuracy) + ") needs the " +
           (is_one ? "grid " : "grids ") + list(operation.missing_grids) +
           (is_one ? ", which is not in " : ", which are not in ") + proj_info().searchpath;
}

/// What to do about it.
std::string advice(const Operation& operation) {
    std::string text = "install PROJ's package of grids";
    if (operation.is_obtainable) {
        std::string before = ", run projsync --file ";
        for (const std::string& grid : operation.missing_grids) {
            text += std::exchange(before, " and projsync --file ") + grid;
        }
    }
    return text + ", or name the grid's folder in PROJ_DATA";
}

/// The first operation that is kept from being used by grids alone; empty when there is none.
const Operation* find_lacking(const std::vector<Operation>& operations) {
    const auto lacks = [](const Operation& operation) {
        return !operation.is_ballpark && !operation.missing_grids.empty();
    };
    auto found = std::find_if(operations.begin(), operations.end(), [&](const Operation& operation) {
        return lacks(operation) && operation.is_obtainable;
    });
    if (found == operations.end()) {
        found = std::find_if(operations.begin(), operations.end(), lacks);
    }
    return found == operations.end() ? nullptr : &*found;
}

[[noreturn]] void refuse(PJ_CONTEXT* context, const Ends& ends, OperationQuery query, bool has_elevations) {
    query.has_missing_grids = true;
    query.has_ballpark = false;
    const std::vector<Operation> all = find_operations(context, ends.source.get(), ends.target.get(), query);
    const std::string what = has_elevations ? "elevations cannot be transformed " : "no transformation ";
    const std::string geoid = has_elevations ? "give a geoid with --geoid FILE.pgm" : "";
    if (const Operation* const lacking = find_lacking(all); lacking != nullptr) {
        throw InputError(what + ends.text + ": " + missing_text(*lacking) + "; " + advice(*lacking) +
                         (has_elevations ? ", or " + geoid : ""));
    }
    throw InputError(what + ends.text +
                     (has_elevations ? ": PROJ knows no way between their heights; " + geoid : ""));
}

/// The operations that can be carried out, the best first; never one that leaves heights as they are because
/// nothing is known about them. Throws when there is none.
std::vector<Operation> find_usable(PJ_CONTEXT* context, const Ends& ends, OperationQuery& query,
                                   bool has_elevations) {
    query.has_ballpark = !has_elevations;
    std::vector<Operation> usable = find_operations(context, ends.source.get(), ends.target.get(), query);
    if (usable.empty() && has_elevations) {
        // Heights may be of one datum though the shift between the horizontal ones is not known.
        query.has_ballpark = true;
        usable = find_operations(context, ends.source.get(), ends.target.get(), query);
        std::erase_if(usable, [](const Operation& operation) { return operation.has_unknown_heights(); });
    }
    if (usable.empty()) {
        refuse(context, ends, query, has_elevations);
    }
    return usable;
}

/// One that is more accurate than `taken` but lacks a grid; nothing when there is none.
std::optional<Operation> find_better(PJ_CONTEXT* context, const Ends& ends, OperationQuery query,
                                     const Operation& taken) {
    query.has_missing_grids = true;
    query.has_ballpark = false;
    std::vector<Operation> all = find_operations(context, ends.source.get(), ends.target.get(), query);
    if (query.extent.is_empty && all.size() > 1) {
        all.resize(1);  // the others may be for other places
    }
    std::optional<Operation> best;
    for (Operation& operation : all) {
        const std::optional<double>& limit = best ? best->accuracy : taken.accuracy;
        const bool is_better = taken.is_ballpark && !best
                                   ? true
                                   : operation.accuracy && (!limit || *operation.accuracy < *limit);
        if (is_better && !operation.missing_grids.empty() && operation.is_obtainable &&
            operation.covers(context, query.extent)) {
            best = std::move(operation);
        }
    }
    return best;
}

std::string warning_of(PJ_CONTEXT* context, const Ends& ends, const OperationQuery& query,
                       const Operation& taken, const TransformOptions& options) {
    std::vector<std::string> parts;
    if (taken.is_ballpark) {
        parts.emplace_back(
            "the shift between the two datums is unknown and taken to be none, so that positions may be off "
            "by "
            "up to hundreds of metres");
    }
    // Operations within one datum are as accurate as their formulas.
    const bool is_exact = proj_get_type(taken.object.get()) == PJ_TYPE_CONVERSION || taken.accuracy == 0.0;
    if (!is_exact) {
        if (const std::optional<Operation> better = find_better(context, ends, query, taken); better) {
            if (!taken.is_ballpark) {
                parts.push_back("taken is " + taken.name + " (" + in_words(taken.accuracy) + ")");
            }
            parts.push_back("the better " + missing_text(*better) + ": " + advice(*better));
        }
    }
    if (!taken.epochs.empty() && !options.epoch) {
        parts.push_back("the shift changes with time and is taken at epoch " + list(taken.epochs) +
                        "; say with --epoch when the coordinates were measured");
    }
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? ends.text + ": " : "; ") + part;
    }
    return text;
}

}  // namespace

TransformChoice choose_transform(PJ_CONTEXT* context, const Crs& from, const Crs& to,
                                 const TransformOptions& options) {
    if (options.has_elevations) {
        check_heights(from, to);
    }
    const Ends ends{make_system(context, from, options.has_elevations),
                    make_system(context, to, options.has_elevations),
                    "from " + from.name() + " to " + to.name()};
    TransformChoice choice;
    if (from.is_same(to)) {  // also local systems, between which PROJ knows no way
        choice.way.reset(proj_create(context, "+proj=noop"));
        choice.name = "none";
        choice.accuracy = 0;
        return choice;
    }
    OperationQuery query;
    query.extent = options.extent;
    std::vector<Operation> usable = find_usable(context, ends, query, options.has_elevations);
    Operation& taken = usable.front();
    choice.name = taken.name;
    choice.accuracy = taken.accuracy;
    choice.warning = warning_of(context, ends, query, taken, options);
    ProjObject way;
    if (usable.size() == 1 || !options.extent.is_empty || (options.has_elevations && query.has_ballpark)) {
        way = std::move(taken.object);
    } else {
        const std::array<const char*, 2> rules{query.has_ballpark ? nullptr : "ALLOW_BALLPARK=NO", nullptr};
        way.reset(proj_create_crs_to_crs_from_pj(context, ends.source.get(), ends.target.get(), nullptr,
                                                 rules.data()));
    }
    choice.way.reset(way ? proj_normalize_for_visualization(context, way.get()) : nullptr);
    if (!choice.way) {
        refuse(context, ends, query, options.has_elevations);
    }
    return choice;
}

}  // namespace tinwright::io
