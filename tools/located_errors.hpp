#ifndef TINWRIGHT_TOOLS_LOCATED_ERRORS_HPP
#define TINWRIGHT_TOOLS_LOCATED_ERRORS_HPP

#include <functional>

#include "tinwright/io/read_lines.hpp"
#include "tinwright/io/read_samples.hpp"

namespace tinwright::tools {

/// Does `work`; its errors about samples and lines get the file, layer and feature or line of the first few
/// added. Samples are numbered as in `samples`, from there on the points of `lines`. Throws what `work` does,
/// InputError instead of DuplicateError and BreaklineError.
void run_located(const io::Samples& samples, const io::Lines& lines, const std::function<void()>& work);

}  // namespace tinwright::tools

#endif
