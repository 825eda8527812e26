#ifndef TINWRIGHT_TESTS_SUPPORT_MESSAGES_HPP
#define TINWRIGHT_TESTS_SUPPORT_MESSAGES_HPP

#include <string>

namespace tinwright_tests {

/// Message of the Exception that `action` throws; empty when it throws nothing.
template <class Exception, class Action>
std::string message_of(const Action& action) {
    try {
        action();
    } catch (const Exception& error) {
        return error.what();
    }
    return {};
}

}  // namespace tinwright_tests

#endif
