#include "tinwright/io/tin_triangles.hpp"

#include <bit>
#include <cmath>
#include <utility>

#include <ogr_geometry.h>

#include "tinwright/geometry/error.hpp"

namespace tinwright::io {
namespace {

constexpr std::uint32_t kFree = 0xFFFFFFFFU;

std::optional<std::string> append_ring(const OGRPolygon& polygon, std::vector<Triangle>& triangles) {
    const OGRLinearRing* const ring = polygon.getExteriorRing();
    if (ring == nullptr || ring->getNumPoints() == 0) {
        return "an empty polygon";
    }
    if (polygon.getNumInteriorRings() > 0) {
        return "a polygon with a hole";
    }
    const int n = ring->getNumPoints();
    if (n < 2 || ring->getX(0) != ring->getX(n - 1) || ring->getY(0) != ring->getY(n - 1)) {
        return "a ring that is not closed";
    }
    if (n != 4) {
        return "a polygon with " + std::to_string(n - 1) + " corners";
    }
    if (ring->Is3D() == FALSE) {
        return "a triangle without z";
    }
    Triangle triangle;
    for (int i = 0; i < 3; ++i) {
        const Point3 p{ring->getX(i), ring->getY(i), ring->getZ(i)};
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            return "a coordinate that is not finite";
        }
        triangle[static_cast<std::size_t>(i)] = p;
    }
    triangles.push_back(triangle);
    return std::nullopt;
}

template <class Collection>
std::optional<std::string> append_parts(const Collection& parts, std::vector<Triangle>& triangles) {
    if (parts.getNumGeometries() == 0) {
        return "an empty geometry";
    }
    for (int i = 0; i < parts.getNumGeometries(); ++i) {
        if (auto problem = append_triangles(parts.getGeometryRef(i), triangles)) {
            return problem;
        }
    }
    return std::nullopt;
}

Point3 without_negative_zero(const Point3& p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }

std::uint64_t mix(std::uint64_t value) {
    value ^= value >> 32U;
    value *= 0x9E3779B97F4A7C15U;
    return value ^ (value >> 29U);
}

}  // namespace

std::optional<std::string> append_triangles(const OGRGeometry* geometry, std::vector<Triangle>& triangles) {
    if (geometry == nullptr) {
        return "no geometry";
    }
    switch (wkbFlatten(geometry->getGeometryType())) {
        case wkbPolygon:
        case wkbTriangle:
            return append_ring(*geometry->toPolygon(), triangles);
        case wkbTIN:
        case wkbPolyhedralSurface:
            return append_parts(*geometry->toPolyhedralSurface(), triangles);
        case wkbMultiPolygon:
        case wkbGeometryCollection:
            return append_parts(*geometry->toGeometryCollection(), triangles);
        default:
            return std::string("a ") + OGRGeometryTypeToName(geometry->getGeometryType());
    }
}

VertexTable::VertexTable() : slots_(1024, kFree) {}

// The slot that holds the point, or the free one where it belongs.
std::size_t VertexTable::slot_of(const Point3& point) const {
    const std::uint64_t hash =
        mix(std::bit_cast<std::uint64_t>(point.x) +
            mix(std::bit_cast<std::uint64_t>(point.y) + mix(std::bit_cast<std::uint64_t>(point.z))));
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash & mask;
    while (slots_[slot] != kFree && !(points_[slots_[slot]] == point)) {
        slot = (slot + 1) & mask;
    }
    return slot;
}

std::uint32_t VertexTable::insert(Point3 point) {
    const Point3 p = without_negative_zero(point);
    std::size_t slot = slot_of(p);
    if (slots_[slot] != kFree) {
        return slots_[slot];
    }
    if (points_.size() >= (std::size_t{1} << 29U)) {
        throw InputError("the TIN has more than 2^29 vertices");
    }
    if (3 * points_.size() >= 2 * slots_.size()) {
        grow();
        slot = slot_of(p);
    }
    slots_[slot] = static_cast<std::uint32_t>(points_.size());
    points_.push_back(p);
    return slots_[slot];
}

std::optional<std::uint32_t> VertexTable::find(Point3 point) const {
    const std::uint32_t index = slots_[slot_of(without_negative_zero(point))];
    return index == kFree ? std::nullopt : std::optional(index);
}

void VertexTable::grow() {
    slots_.assign(2 * slots_.size(), kFree);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        slots_[slot_of(points_[i])] = i;
    }
}

std::vector<Point3> VertexTable::take() {
    slots_.assign(slots_.size(), kFree);
    return std::exchange(points_, {});
}

}  // namespace tinwright::io
