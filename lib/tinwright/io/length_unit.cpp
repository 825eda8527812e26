#include "tinwright/io/length_unit.hpp"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <proj.h>

#include "tinwright/geometry/decimal.hpp"

namespace tinwright::io {
namespace {

/// A unit that is a fraction of a metre by definition. Products of two terms stay below 2^53, so that one
/// division gives the nearest double.
struct ExactUnit {
    std::string_view name;
    std::int64_t numerator;
    std::int64_t denominator;

    [[nodiscard]] double metres() const {
        return static_cast<double>(numerator) / static_cast<double>(denominator);
    }
};

/// The American survey units count 39.37 inches to the metre, the others 2.54 cm to the inch.
constexpr std::array<ExactUnit, 19> kExactUnits = {{{"metre", 1, 1},
                                                    {"foot", 381, 1250},
                                                    {"US survey foot", 1200, 3937},
                                                    {"kilometre", 1000, 1},
                                                    {"decimetre", 1, 10},
                                                    {"centimetre", 1, 100},
                                                    {"millimetre", 1, 1000},
                                                    {"inch", 127, 5000},
                                                    {"yard", 1143, 1250},
                                                    {"fathom", 1143, 625},
                                                    {"chain", 12573, 625},
                                                    {"link", 12573, 62500},
                                                    {"Statute mile", 201168, 125},
                                                    {"nautical mile", 1852, 1},
                                                    {"US survey inch", 100, 3937},
                                                    {"US survey yard", 3600, 3937},
                                                    {"US survey chain", 79200, 3937},
                                                    {"US survey link", 792, 3937},
                                                    {"US survey mile", 6336000, 3937}}};

/// Other spellings, as `plain` leaves them.
struct Spelling {
    std::string_view plain;
    std::string_view name;
};

constexpr std::array<Spelling, 63> kSpellings = {{{"m", "metre"},
                                                  {"meter", "metre"},
                                                  {"meters", "metre"},
                                                  {"metres", "metre"},
                                                  {"metro", "metre"},
                                                  {"ft", "foot"},
                                                  {"feet", "foot"},
                                                  {"internationalfoot", "foot"},
                                                  {"internationalfeet", "foot"},
                                                  {"intfoot", "foot"},
                                                  {"intlfoot", "foot"},
                                                  {"footinternational", "foot"},
                                                  {"footintl", "foot"},
                                                  {"ftint", "foot"},
                                                  {"ift", "foot"},
                                                  {"usft", "US survey foot"},
                                                  {"ftus", "US survey foot"},
                                                  {"footus", "US survey foot"},
                                                  {"feetus", "US survey foot"},
                                                  {"usfoot", "US survey foot"},
                                                  {"usfeet", "US survey foot"},
                                                  {"ussurveyfeet", "US survey foot"},
                                                  {"ussurveyft", "US survey foot"},
                                                  {"surveyfoot", "US survey foot"},
                                                  {"surveyfeet", "US survey foot"},
                                                  {"footussurvey", "US survey foot"},
                                                  {"sft", "US survey foot"},
                                                  {"km", "kilometre"},
                                                  {"kilometer", "kilometre"},
                                                  {"kilometers", "kilometre"},
                                                  {"kilometres", "kilometre"},
                                                  {"dm", "decimetre"},
                                                  {"decimeter", "decimetre"},
                                                  {"decimeters", "decimetre"},
                                                  {"decimetres", "decimetre"},
                                                  {"cm", "centimetre"},
                                                  {"centimeter", "centimetre"},
                                                  {"centimeters", "centimetre"},
                                                  {"centimetres", "centimetre"},
                                                  {"mm", "millimetre"},
                                                  {"millimeter", "millimetre"},
                                                  {"millimeters", "millimetre"},
                                                  {"millimetres", "millimetre"},
                                                  {"in", "inch"},
                                                  {"inches", "inch"},
                                                  {"yd", "yard"},
                                                  {"yards", "yard"},
                                                  {"fath", "fathom"},
                                                  {"fathoms", "fathom"},
                                                  {"ch", "chain"},
                                                  {"chains", "chain"},
                                                  {"links", "link"},
                                                  {"mi", "Statute mile"},
                                                  {"mile", "Statute mile"},
                                                  {"miles", "Statute mile"},
                                                  {"kmi", "nautical mile"},
                                                  {"nauticalmiles", "nautical mile"},
                                                  {"internationalnauticalmile", "nautical mile"},
                                                  {"usin", "US survey inch"},
                                                  {"usyd", "US survey yard"},
                                                  {"usch", "US survey chain"},
                                                  {"usmi", "US survey mile"},
                                                  {"ussurveymiles", "US survey mile"}}};

/// Lengths that are the same to so much have one name; the feet and metres of the world differ by 4e-7.
constexpr double kSameLength = 1e-8;

bool is_as_long(double a, double b) { return std::abs(a / b - 1) < kSameLength; }

std::string plain(std::string_view spelling) {
    std::string text;
    for (const char c : spelling) {
        const auto byte = static_cast<unsigned char>(c);
        if (c != '-' && c != '_' && std::isspace(byte) == 0) {
            text.push_back(static_cast<char>(std::tolower(byte)));
        }
    }
    return text;
}

const ExactUnit* find_exact(const std::string& plain_name) {
    std::string_view name = plain_name;
    for (const Spelling& spelling : kSpellings) {
        if (spelling.plain == plain_name) {
            name = spelling.name;
        }
    }
    const std::string wanted = plain(name);
    for (const ExactUnit& unit : kExactUnits) {
        if (plain(unit.name) == wanted) {
            return &unit;
        }
    }
    return nullptr;
}

struct ListedUnit {
    std::string plain_name;
    std::string plain_symbol;
    LengthUnit unit;
};

/// The lengths in PROJ's database, those that EPSG lists first.
std::vector<ListedUnit> list_units() {
    std::vector<ListedUnit> units;
    const std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)> context(proj_context_create(),
                                                                               proj_context_destroy);
    for (const char* const authority : {"EPSG", "PROJ"}) {
        int count = 0;
        PROJ_UNIT_INFO** const listed =
            proj_get_units_from_database(context.get(), authority, "linear", 0, &count);
        for (int i = 0; i < count; ++i) {
            const PROJ_UNIT_INFO& info = *listed[i];
            const char* const symbol = info.proj_short_name;
            if (info.conv_factor > 0) {
                units.push_back({plain(info.name),
                                 symbol == nullptr ? std::string() : plain(symbol),
                                 {info.name, info.conv_factor}});
            }
        }
        proj_unit_list_destroy(listed);
    }
    return units;
}

std::optional<LengthUnit> find_listed(const std::string& plain_name) {
    static const std::vector<ListedUnit> units = list_units();
    for (const ListedUnit& listed : units) {
        if (listed.plain_name == plain_name || listed.plain_symbol == plain_name) {
            return listed.unit;
        }
    }
    return std::nullopt;
}

/// "0.5 metre".
std::optional<LengthUnit> find_multiple(std::string_view spelling) {
    double metres = 0;
    const char* const end = spelling.data() + spelling.size();
    const auto [rest, error] = std::from_chars(spelling.data(), end, metres);
    if (error != std::errc() || !(metres > 0) || !std::isfinite(metres) ||
        plain({rest, static_cast<std::size_t>(end - rest)}) != "metre") {
        return std::nullopt;
    }
    return length_unit_of(metres, std::string());
}

}  // namespace

std::optional<LengthUnit> find_length_unit(std::string_view spelling) {
    const std::string wanted = plain(spelling);
    if (wanted.empty()) {
        return std::nullopt;
    }
    if (const ExactUnit* const unit = find_exact(wanted)) {
        return LengthUnit{std::string(unit->name), unit->metres()};
    }
    if (std::optional<LengthUnit> multiple = find_multiple(spelling)) {
        return multiple;
    }
    return find_listed(wanted);
}

LengthUnit length_unit_of(double metres, const std::string& name) {
    for (const ExactUnit& unit : kExactUnits) {
        if (is_as_long(metres, unit.metres())) {
            return {std::string(unit.name), unit.metres()};
        }
    }
    std::optional<LengthUnit> named = find_length_unit(name);
    return named && is_as_long(metres, named->metres) ? *named
                                                      : LengthUnit{decimal_text(metres) + " metre", metres};
}

double unit_factor(const std::string& from, const std::string& to) {
    if (from == to) {
        return 1;
    }
    const ExactUnit* const a = find_exact(plain(from));
    const ExactUnit* const b = find_exact(plain(to));
    if (a != nullptr && b != nullptr) {
        return static_cast<double>(a->numerator * b->denominator) /
               static_cast<double>(a->denominator * b->numerator);
    }
    const std::optional<LengthUnit> source = find_length_unit(from);
    const std::optional<LengthUnit> target = find_length_unit(to);
    return source && target ? source->metres / target->metres : 1;
}

}  // namespace tinwright::io
