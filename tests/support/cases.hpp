#ifndef TINWRIGHT_TESTS_SUPPORT_CASES_HPP
#define TINWRIGHT_TESTS_SUPPORT_CASES_HPP

#include <algorithm>
#include <cstdlib>

namespace tinwright_tests {

/// How many times a seeded loop runs: `usual` times the environment variable TINWRIGHT_CASES (default 1),
/// once at least. CI runs with 1, the full counts with 20 or more.
inline int cases(int usual) {
    const char* text = std::getenv("TINWRIGHT_CASES");
    const double factor = text == nullptr ? 1.0 : std::strtod(text, nullptr);
    return std::max(1, static_cast<int>(usual * factor));
}

}  // namespace tinwright_tests

#endif
