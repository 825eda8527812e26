#include "tinwright/breaklines/line_snapping.hpp"

namespace tinwright {

SnappedLines snap_lines(LinePoints& /*points*/, double /*distance*/) { return {}; }

}  // namespace tinwright
