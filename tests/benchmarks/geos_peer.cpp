#include "benchmarks/geos_peer.hpp"

#include <memory>
#include <stdexcept>
#include <vector>

#include <geos_c.h>

namespace tinwright_benchmarks {

namespace {

class Session {
  public:
    Session() : handle_(GEOS_init_r()) {}
    ~Session() { GEOS_finish_r(handle_); }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    [[nodiscard]] GEOSContextHandle_HS* handle() const { return handle_; }

  private:
    GEOSContextHandle_HS* handle_;
};

}  // namespace

bool has_geos() { return true; }

std::string geos_name() { return "GEOS " GEOS_VERSION; }

void measure_geos_noding(std::span<const tinwright::Breakline> lines, Meter& meter) {
    const Session session;
    GEOSContextHandle_HS* const geos = session.handle();
    const auto destroy = [geos](GEOSGeometry* geometry) { GEOSGeom_destroy_r(geos, geometry); };
    using Geometry = std::unique_ptr<GEOSGeometry, decltype(destroy)>;

    std::vector<GEOSGeometry*> parts;
    parts.reserve(lines.size());
    for (const tinwright::Breakline& line : lines) {
        GEOSCoordSequence* places = GEOSCoordSeq_create_r(geos, static_cast<unsigned>(line.points.size()), 2);
        for (unsigned i = 0; i < line.points.size(); ++i) {
            GEOSCoordSeq_setXY_r(geos, places, i, line.points[i].x, line.points[i].y);
        }
        parts.push_back(GEOSGeom_createLineString_r(geos, places));
    }
    const Geometry all(GEOSGeom_createCollection_r(geos, GEOS_MULTILINESTRING, parts.data(),
                                                   static_cast<unsigned>(parts.size())),
                       destroy);
    meter.start();
    const Geometry noded(GEOSNode_r(geos, all.get()), destroy);
    meter.stop();
    if (noded == nullptr) {
        throw std::runtime_error("GEOS could not node the lines");
    }
    meter.note(GEOSGetNumGeometries_r(geos, noded.get()));
}

}  // namespace tinwright_benchmarks
