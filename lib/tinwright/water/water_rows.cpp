#include "tinwright/water/water_rows.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace tinwright {

namespace {

class RowFinder {
  public:
    RowFinder(const WaterMesh& water, const std::vector<bool>& is_open)
        : water_(water),
          is_open_(is_open),
          junction_of_(water.mesh.slot_count(), WaterRow::kEnd),
          is_done_(4 * water.mesh.slot_count(), false) {}

    WaterRows find() {
        const auto slots = static_cast<std::uint32_t>(water_.mesh.slot_count());
        std::vector<FaceId> beginnings;
        std::vector<FaceId> passages;
        for (FaceId f{0}; f.value < slots; ++f.value) {
            if (!is_open_[f.value]) {
                continue;
            }
            const unsigned neighbors = count_neighbors(f);
            if (neighbors == 3) {
                junction_of_[f.value] = static_cast<std::uint32_t>(found_.junctions.size());
                found_.junctions.push_back(f);
            }
            if (neighbors == 0) {
                found_.lonely.push_back(f);
            } else {
                (neighbors == 2 ? passages : beginnings).push_back(f);
            }
        }
        for (const FaceId f : beginnings) {
            begin_rows(f);
        }
        for (const FaceId f : passages) {
            begin_rows(f);  // what has not been passed yet goes round
        }
        return std::move(found_);
    }

  private:
    [[nodiscard]] bool is_open_edge(HalfEdgeId h) const {
        return tinwright::is_open_edge(water_, is_open_, h);
    }

    [[nodiscard]] unsigned count_neighbors(FaceId f) const {
        unsigned count = 0;
        for (unsigned corner = 0; corner < 3; ++corner) {
            count += is_open_edge(half_edge(f, corner)) ? 1U : 0U;
        }
        return count;
    }

    void begin_rows(FaceId f) {
        // Where a face starts in its slot is not to matter.
        const auto& v = water_.mesh.face(f).vertex;
        const auto first = static_cast<unsigned>(std::min_element(v.begin(), v.end()) - v.begin());
        for (const unsigned corner : {first, next_corner(first), previous_corner(first)}) {
            const HalfEdgeId h = half_edge(f, corner);
            if (is_open_edge(h) && !is_done_[h.value]) {
                follow(h);
            }
        }
    }

    void follow(HalfEdgeId way_out) {
        WaterRow row;
        row.first = found_.edges.size();
        row.from = junction_of_[face_of(way_out).value];
        const HalfEdgeId beginning = water_.mesh.twin(way_out);
        HalfEdgeId h = beginning;
        for (;;) {
            found_.edges.push_back(h);
            is_done_[h.value] = true;
            is_done_[water_.mesh.twin(h).value] = true;
            const HalfEdgeId right = next(h);
            const HalfEdgeId left = previous(h);
            const bool goes_right = is_open_edge(right);
            if (goes_right == is_open_edge(left)) {
                break;
            }
            h = water_.mesh.twin(goes_right ? right : left);
            if (h == beginning) {
                row.is_closed = true;
                break;
            }
        }
        row.to = junction_of_[face_of(h).value];
        if (row.is_closed) {
            close(row);
        }
        row.last = found_.edges.size();
        found_.rows.push_back(row);
    }

    void close(const WaterRow& row) {
        const auto first = found_.edges.begin() + static_cast<std::ptrdiff_t>(row.first);
        const auto rank = [this](HalfEdgeId h) {
            return std::tuple(water_.length(h), water_.mesh.origin(h), water_.mesh.destination(h));
        };
        std::rotate(first,
                    std::min_element(first, found_.edges.end(),
                                     [&](HalfEdgeId a, HalfEdgeId b) { return rank(a) < rank(b); }),
                    found_.edges.end());
        found_.edges.push_back(found_.edges[row.first]);
    }

    const WaterMesh& water_;
    const std::vector<bool>& is_open_;
    std::vector<std::uint32_t> junction_of_;  // by face
    std::vector<bool> is_done_;               // by half-edge
    WaterRows found_;
};

}  // namespace

WaterRows find_water_rows(const WaterMesh& water, const std::vector<bool>& is_open) {
    return RowFinder(water, is_open).find();
}

}  // namespace tinwright
