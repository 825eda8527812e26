#ifndef TINWRIGHT_TESTS_SUPPORT_OPTIMIZING_HPP
#define TINWRIGHT_TESTS_SUPPORT_OPTIMIZING_HPP

#include <string>

#include "tinwright/optimal/optimize.hpp"

/// Short ways to optimised TINs for tests.
namespace tinwright_tests {

inline constexpr tinwright::Scope kVectorScope{tinwright::Scope::Kind::Vector, 0};
inline constexpr tinwright::Scope kMaxScope{tinwright::Scope::Kind::Max, 0};

inline tinwright::OptimizeReport optimize_to(tinwright::Scope scope, tinwright::Criterion criterion,
                                             tinwright::Tin& tin) {
    tinwright::OptimizeOptions options;
    options.criterion = criterion;
    options.scope = scope;
    return tinwright::optimize(tin, options);
}

inline std::string name_of(tinwright::Criterion criterion) {
    return std::string(tinwright::criterion_traits(criterion).name);
}

}  // namespace tinwright_tests

#endif
