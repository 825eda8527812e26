#include "tinwright/io/coordinate_transform.hpp"

namespace tinwright::io {

struct CoordinateTransform::State {
    std::string warning;
};

CoordinateTransform::CoordinateTransform(const Crs& /*from*/, const Crs& /*to*/,
                                         const TransformOptions& /*options*/)
    : state_(std::make_unique<State>()) {}
CoordinateTransform::~CoordinateTransform() = default;
CoordinateTransform::CoordinateTransform(CoordinateTransform&&) noexcept = default;
CoordinateTransform& CoordinateTransform::operator=(CoordinateTransform&&) noexcept = default;

std::vector<std::size_t> CoordinateTransform::forward(std::span<Point3> /*points*/,
                                                      const Progress& /*progress*/) const {
    return {};
}
std::vector<std::size_t> CoordinateTransform::inverse(std::span<Point3> /*points*/,
                                                      const Progress& /*progress*/) const {
    return {};
}
void CoordinateTransform::forward(std::span<Point2> /*positions*/) const {}
void CoordinateTransform::inverse(std::span<Point2> /*positions*/) const {}
std::string CoordinateTransform::operation() const { return {}; }
std::optional<double> CoordinateTransform::accuracy() const { return std::nullopt; }
const std::string& CoordinateTransform::warning() const { return state_->warning; }

}  // namespace tinwright::io
