#ifndef TINWRIGHT_WATER_NEAR_SAMPLES_HPP
#define TINWRIGHT_WATER_NEAR_SAMPLES_HPP

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tinwright/delaunay/drape.hpp"
#include "tinwright/delaunay/sample_vertices.hpp"
#include "tinwright/geometry/lattice.hpp"
#include "tinwright/geometry/point.hpp"
#include "tinwright/mesh/box_tree.hpp"

/// What samples say of the elevation of water. Private to the room of water.
namespace tinwright {

class NearSamples {
  public:
    /// `samples` must outlive it; `lattice`: one that they are on. O(n log n).
    NearSamples(std::span<const Point3> samples, const Lattice& lattice);
    ~NearSamples() = default;
    NearSamples(const NearSamples&) = delete;
    NearSamples& operator=(const NearSamples&) = delete;

    [[nodiscard]] bool is_empty() const { return keys_.empty(); }
    [[nodiscard]] Key2 key(std::uint32_t sample) const { return keys_[sample]; }
    [[nodiscard]] double z(std::uint32_t sample) const { return samples_[sample].z; }

    /// Calls `visit(sample)` for the samples in a box.
    template <class Visit>
    void visit_in(const KeyBox& box, const Visit& visit) const {
        tree_.visit_meeting(
            box, [](const KeyBox&) { return false; },
            [&](std::uint32_t sample) {
                visit(sample);
                return true;
            });
    }

    /// Elevation of the samples' TIN, of the nearest place on its hull beyond it. Throws InputError where
    /// there are no three samples, or all on one line.
    [[nodiscard]] double terrain(Key2 key);
    /// Whether the key is outside the samples' hull, or no farther than `reach` (keys) inside.
    [[nodiscard]] bool is_at_border(Key2 key, double reach);
    /// The lowest of the samples no farther than `reach` (keys) from a segment, which may be a point, and of
    /// the terrain at its ends.
    [[nodiscard]] double lowest(Key2 a, Key2 b, double reach);

  private:
    Drape& drape();

    std::span<const Point3> samples_;
    Lattice lattice_;
    std::vector<Key2> keys_;
    BoxTree tree_;
    SampleVertices vertices_;
    std::optional<Drape> drape_;
};

}  // namespace tinwright

#endif
