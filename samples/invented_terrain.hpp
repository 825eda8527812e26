#ifndef TINWRIGHT_SAMPLES_INVENTED_TERRAIN_HPP
#define TINWRIGHT_SAMPLES_INVENTED_TERRAIN_HPP

#include <cstdint>
#include <vector>

/// A valley that exists nowhere: a stream runs through a lake and under a road embankment. Only + - * / and
/// square roots are used, so every machine makes the same numbers.
namespace invented {

struct Position {
    double x = 0;
    double y = 0;
};

/// Size of the area, metres; local coordinates run from (0, 0) in the south-west.
inline constexpr double kWidth = 1200;
inline constexpr double kHeight = 800;
inline constexpr double kLakeLevel = 428.4;
inline constexpr double kRoadHalfWidth = 4.5;
inline constexpr double kBankDistance = 4.0;  ///< from the middle of the stream to the top of its bank

/// Random numbers, the same on every machine (splitmix64).
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    /// Uniform in [low, high).
    double uniform(double low, double high);

  private:
    std::uint64_t state_;
};

/// The finished surface: ground, lake and road.
double elevation(Position p);
/// The ground as if nobody had built a road.
double natural_elevation(Position p);

/// Middle of the stream at an easting.
Position stream(double x);
/// Middle of the road at a northing, and its elevation there.
Position road(double y);
double road_elevation(double y);
/// Unit vector to the right of someone who walks the road northward.
Position road_right(double y);
/// Distance to the middle of the road, good near it.
double distance_to_road(Position p);

bool is_in_lake(Position p);
/// The lake's shore, anticlockwise, not closed.
std::vector<Position> lake_shore(int vertices);
bool is_in_survey_area(Position p);
/// The outline of the surveyed area, anticlockwise, not closed.
std::vector<Position> survey_outline(int vertices);

}  // namespace invented

#endif
