#include "tinwright/io/geoid.hpp"

namespace tinwright::io {

struct Geoid::State {
    std::string path;
    std::string description;
};
Geoid::Geoid(const std::string& file) : state_(std::make_unique<State>(State{file, {}})) {}
Geoid::~Geoid() = default;
void Geoid::prepare(const GeographicExtent& /*extent*/) {}
double Geoid::height(double /*latitude*/, double /*longitude*/) const { return 0; }
const std::string& Geoid::path() const { return state_->path; }
const std::string& Geoid::description() const { return state_->description; }
std::string Geoid::vertical_code() const { return {}; }
void shift_by_geoid(const Geoid& /*geoid*/, std::span<const Point3> /*at*/, std::span<Point3> /*points*/,
                    int /*sign*/, double /*metres_per_unit*/, const Progress& /*progress*/) {}

}  // namespace tinwright::io
