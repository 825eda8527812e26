#ifndef TINWRIGHT_TESTS_BENCHMARKS_REPORT_HPP
#define TINWRIGHT_TESTS_BENCHMARKS_REPORT_HPP

#include <optional>
#include <string>
#include <vector>

namespace tinwright_benchmarks {

/// A figure that is asked for.
struct Target {
    enum class Kind { AtMost, AtLeast };
    Kind kind = Kind::AtMost;
    double value = 0;
};

inline std::optional<Target> at_most(double value) { return Target{Target::Kind::AtMost, value}; }
inline std::optional<Target> at_least(double value) { return Target{Target::Kind::AtLeast, value}; }

/// "at most 2 bytes".
std::string to_text(const Target& target, const std::string& unit = "");
bool is_met(const Target& target, double figure);

/// Three significant digits.
std::string number(double value);
/// The same with its unit.
std::string in_seconds(double seconds);
std::string in_megabytes(double bytes);

/// A Markdown table of measurements, ready for docs/benchmarks.md: printed line by line on stdout.
class ResultTable {
  public:
    /// Prints the head; `ours` and `other` name the columns of the two things compared.
    ResultTable(const std::string& what, const std::string& ours, const std::string& other);

    /// One line; `figure` is a ratio or a quantity with its unit in `unit`; none where the peer is missing.
    void add(const std::string& what, const std::string& ours, const std::string& other,
             std::optional<double> figure, std::optional<Target> target = std::nullopt,
             const std::string& unit = "");
};

}  // namespace tinwright_benchmarks

#endif
