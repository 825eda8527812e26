#ifndef TINWRIGHT_TOOLS_SURFACE_SAMPLER_HPP
#define TINWRIGHT_TOOLS_SURFACE_SAMPLER_HPP

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/geometry/progress.hpp"
#include "tinwright/surface/breakline_distance.hpp"
#include "tinwright/surface/interpolator.hpp"
#include "tinwright/surface/products.hpp"
#include "tinwright/surface/profile.hpp"

#include "options_interpolation.hpp"
#include "profile_plot.hpp"
#include "sample_queries.hpp"
#include "sample_table.hpp"
#include "surface_input.hpp"

namespace tinwright::tools {

/// For each line that the TIN's traces number: whether it is a breakline. Of a surface with origins.
std::vector<bool> breaklines_of(const Surface& surface);

/// The columns of a table of points and of one of lines.
std::span<const TableColumn> point_columns();
std::span<const TableColumn> line_columns();

struct SampledCounts {
    bool are_lines = false;
    std::size_t lines = 0;
    std::size_t points = 0;   ///< rows
    std::size_t outside = 0;  ///< of these, off the terrain
    std::size_t parts = 0;    ///< of profiles
    double step = 0;          ///< of lines; 0: cuts only
    bool has_cuts = false;    ///< of lines
};

/// A surface, ready to be read.
class SurfaceSampler {
  public:
    /// `surface` must outlive it. `place_crs`: of positions on the command line. Parallel inside the caller's
    /// task arena; `threads` for the interpolator; `progress` of each call, which throws `Cancelled` when
    /// asked to stop.
    SurfaceSampler(const Surface& surface, const InterpolationChoice& interpolation, SlopeUnit slope_unit,
                   const io::Crs& place_crs, int threads, Progress progress);

    /// A row for each point. Adds to `counts`.
    void sample_points(const Queries& queries, SampleTable& table, SampledCounts& counts) const;
    /// Rows for each line, and where `curves` is not null its profile.
    void sample_lines(const Queries& queries, const ProfileOptions& options, SampleTable& table,
                      SampledCounts& counts, std::vector<ProfileCurve>* curves) const;

  private:
    void append_reading(std::vector<TableValue>& row, Point2 position, Point2 written,
                        const std::optional<SurfacePlace>& place, const SurfaceReading& reading) const;

    const Surface& surface_;
    SlopeUnit slope_unit_;
    std::unique_ptr<Interpolator> interpolator_;
    std::vector<std::uint32_t> face_numbers_;
    BreaklineDistance breaklines_;
    QueryLattice lattice_;
    io::OutputPositions positions_;
    bool is_given_written_;  ///< positions of the command line are in the system that is written
    Progress progress_;
};

}  // namespace tinwright::tools

#endif
