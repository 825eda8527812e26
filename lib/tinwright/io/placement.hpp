#ifndef TINWRIGHT_IO_PLACEMENT_HPP
#define TINWRIGHT_IO_PLACEMENT_HPP

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tinwright/geometry/point.hpp"
#include "tinwright/geometry/progress.hpp"
#include "tinwright/io/crs.hpp"
#include "tinwright/io/source.hpp"

namespace tinwright::io {

/// What a file says about the coordinates in it.
struct CoordinateSystem {
    Crs crs;                  ///< may be unknown
    bool is_lon_lat = false;  ///< columns are called longitude and latitude
    std::string z_unit;       ///< where the file itself tells it
};

/// Private to the readers: the system that all sources are brought into. It is the one asked for, else that
/// of the first source that has one; sources without any are taken to be in it.
class Placement {
  public:
    /// `sources` are kept by reference. `working`: unknown, if the sources are to decide; `assigned`: for
    /// sources that carry none. Throws UsageError when `working` is geographic or a source's crs= is not
    /// understood.
    Placement(std::span<const Source> sources, Crs working, Crs assigned);

    /// Brings the points of source `s` into the plane, in place. Returns the ascending positions of those
    /// that cannot be transformed, left as they were. Throws InputError for geographic coordinates without a
    /// plane to go to, for a system that differs when none was asked for, and when there is no way between
    /// the two.
    std::vector<std::size_t> place(std::size_t s, const CoordinateSystem& own, std::span<Point3> points,
                                   const Progress& progress = {});
    /// Why a point that `place` returned is none of the plane: `(x, y) cannot be transformed from A to B`.
    [[nodiscard]] std::string failure(const Point3& point) const;

    /// What elevations read before are in; empty when unknown.
    void expect_z_unit(const std::string& unit) { z_unit_ = unit; }

    [[nodiscard]] const Crs& crs() const { return crs_; }
    /// Of the sources read; empty when unknown.
    [[nodiscard]] std::string z_unit() const { return z_unit_.empty() ? crs_.z_unit() : z_unit_; }
    /// Hands over what there is to warn of since the last time, one line each.
    std::vector<std::string> take_warnings();
    /// The warning that sources had no system, when there is one that they were taken to be in; else empty.
    [[nodiscard]] std::string missing_warning() const;

  private:
    Crs system_of(std::size_t s, const CoordinateSystem& own);
    void refuse_geographic(std::size_t s, const Crs& crs, std::span<const Point3> points) const;
    void note_z_unit(std::size_t s, const std::string& unit);

    std::span<const Source> sources_;
    std::vector<Crs> given_;  // by crs=, one a source
    Crs crs_;
    Crs assigned_;
    Crs from_;  // of the last source transformed
    bool is_asked_for_;
    std::size_t decided_by_ = 0;
    std::vector<std::size_t> without_crs_;
    std::string z_unit_;
    bool are_z_units_mixed_ = false;
    std::vector<std::string> warnings_;
};

}  // namespace tinwright::io

#endif
