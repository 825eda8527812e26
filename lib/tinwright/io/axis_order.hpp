#ifndef TINWRIGHT_IO_AXIS_ORDER_HPP
#define TINWRIGHT_IO_AXIS_ORDER_HPP

class OGRSpatialReference;

namespace tinwright::io {

/// Whether the first coordinate in a data set with this system is northing or latitude, as some authorities
/// order axes and some drivers hand them over; may be null.
bool is_north_first(const OGRSpatialReference* system);

}  // namespace tinwright::io

#endif
