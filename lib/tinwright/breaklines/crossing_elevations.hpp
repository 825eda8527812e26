#ifndef TINWRIGHT_BREAKLINES_CROSSING_ELEVATIONS_HPP
#define TINWRIGHT_BREAKLINES_CROSSING_ELEVATIONS_HPP

#include <span>
#include <vector>

#include "tinwright/breaklines/breakline.hpp"
#include "tinwright/breaklines/line_visits.hpp"
#include "tinwright/breaklines/noding.hpp"

namespace tinwright {

/// What lines say about the elevation of a vertex.
struct MeetingElevation {
    double z = kDraped;  ///< the one chosen
    bool is_clash = false;
    bool is_settled = false;  ///< a clash of water with other lines, which the water wins under any policy
    /// Only for a clash: the visits with the lowest and the highest elevation, and these.
    const LineVisit* low = nullptr;
    const LineVisit* high = nullptr;
    double z_low = kDraped;
    double z_high = kDraped;
};

/// Elevations where lines meet: that of a line's own point, else linear along the segment of the line as it
/// came. Those that are to be draped say nothing. One object a thread.
class CrossingElevations {
  public:
    CrossingElevations(std::span<const Breakline> lines, const LinePoints& points, const LineNetwork& network,
                       const RoundedSegments& rounded, const NodingOptions& options)
        : lines_(lines), points_(points), network_(network), rounded_(rounded), options_(options) {}

    /// What the line of a visit says.
    [[nodiscard]] double elevation(const LineVisit& visit, std::uint32_t vertex) const;

    /// Chooses from what all lines say. They clash if points differ by more than the tolerance, or any by
    /// more than that and what comes of rounding: of arithmetic, and of locations. Without a clash it is the
    /// mean of the lines, or of the points where the rest differs by rounding only.
    /// Where one of them is water, only water has a say, and rivers have none where they meet other water.
    [[nodiscard]] MeetingElevation meet(std::span<const LineVisit> visits, std::uint32_t vertex);

  private:
    struct Said {
        double z;
        const LineVisit* visit;
    };
    [[nodiscard]] double z_of_point(std::uint32_t line, std::uint32_t point) const {
        return lines_[line].points[point - points_.start[line]].z;
    }
    /// Whose elevation counts where lines meet: shores, banks and sections before rivers, those before the
    /// rest.
    [[nodiscard]] int rank_of(const LineVisit& visit) const {
        const LineRole role = lines_[visit.line].role;
        return role == LineRole::River ? 1 : is_water_role(role) ? 2 : 0;
    }
    [[nodiscard]] MeetingElevation meet_all(std::span<const LineVisit> visits, std::uint32_t vertex);
    [[nodiscard]] double slack(std::span<const LineVisit> visits) const;
    [[nodiscard]] double mean(bool of_points_only);
    [[nodiscard]] double choose(double low, double high);

    std::span<const Breakline> lines_;
    const LinePoints& points_;
    const LineNetwork& network_;
    const RoundedSegments& rounded_;
    const NodingOptions& options_;
    std::vector<LineVisit> of_water_;  // scratch
    std::vector<Said> said_;           // in the order of the visits
    std::vector<double> of_line_;      // scratch
    std::vector<double> line_means_;   // scratch
};

}  // namespace tinwright

#endif
