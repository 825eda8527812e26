#ifndef TINWRIGHT_TOOLS_MANUAL_PAGES_HPP
#define TINWRIGHT_TOOLS_MANUAL_PAGES_HPP

#include <span>
#include <string_view>

namespace tinwright::tools {

/// A page of docs/man as it was when the program was built; the definitions are made by CMake.
struct ManualPage {
    std::string_view name;  ///< "tinwright-grid"
    std::string_view text;  ///< plain text
};

std::span<const ManualPage> all_manual_pages();

}  // namespace tinwright::tools

#endif
