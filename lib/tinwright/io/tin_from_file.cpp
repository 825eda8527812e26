#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/read_tin.hpp"

namespace tinwright::io {
namespace {

std::string at(const Point3& p) { return "at " + location_text({p.x, p.y}); }

constexpr const char* kCheck = "; `tinwright check` lists every such place";

/// Turns a TinFile into a Tin.
class TinMaker {
  public:
    explicit TinMaker(const TinFile& file) : file_(file) {}

    Tin make() {
        number_vertices();
        orient_faces();
        link_faces();
        constrain_edges();
        trace_lines();
        return std::move(tin_);
    }

  private:
    void number_vertices();
    void orient_faces();
    void link_faces();
    void constrain_edges();
    void trace_lines();
    [[noreturn]] void refuse_edges() const;
    [[nodiscard]] std::string feature(std::size_t face) const {
        return "layer " + io::quoted(file_.layer) + ", feature " + std::to_string(file_.face_ids[face]);
    }
    [[nodiscard]] const Point3& corner(std::size_t i) const { return file_.vertices[file_.corners[i]]; }

    const TinFile& file_;
    Tin tin_;
    std::vector<std::uint32_t> vertex_of_;  // of each of the file's vertices
    std::vector<VertexId> corners_;         // counter-clockwise
};

void TinMaker::number_vertices() {
    tin_.lattice = find_lattice(file_.vertices).lattice;
    std::vector<Key2> keys;
    keys.reserve(file_.vertices.size());
    for (const Point3& p : file_.vertices) {
        keys.push_back(tin_.lattice.key({p.x, p.y}));
    }
    vertex_of_.resize(keys.size());
    for (const std::uint32_t i : sort_along_curve(keys)) {
        const Point3& p = file_.vertices[i];
        const bool is_repeated = !tin_.keys.empty() && tin_.keys.back() == keys[i];
        if (is_repeated && tin_.z.back() != p.z) {
            throw InputError("layer " + io::quoted(file_.layer) + ": two elevations " + at(p) + ", " +
                             decimal_text(tin_.z.back()) + " and " + decimal_text(p.z) + kCheck);
        }
        if (!is_repeated) {
            const bool is_steiner = i < file_.is_steiner.size() && file_.is_steiner[i];
            const bool is_crossing = i < file_.is_crossing.size() && file_.is_crossing[i];
            tin_.keys.push_back(keys[i]);
            tin_.z.push_back(p.z);
            const bool is_inserted = i < file_.is_inserted.size() && file_.is_inserted[i];
            tin_.sample.push_back(is_steiner    ? Tin::kNoSample
                                  : is_crossing ? Tin::kCrossing
                                  : is_inserted ? Tin::kInserted
                                                : i);
        }
        vertex_of_[i] = static_cast<std::uint32_t>(tin_.keys.size() - 1);
    }
}

void TinMaker::orient_faces() {
    corners_.reserve(file_.corners.size());
    for (std::size_t f = 0; f < file_.face_ids.size(); ++f) {
        std::array<VertexId, 3> v{};
        for (std::size_t i = 0; i < 3; ++i) {
            v[i] = {vertex_of_[file_.corners[3 * f + i]]};
        }
        const int side = orient2d(tin_.key(v[0]), tin_.key(v[1]), tin_.key(v[2]));
        if (side == 0) {
            throw InputError(feature(f) + ": a face without area " + at(corner(3 * f)) + kCheck);
        }
        if (side < 0) {
            std::swap(v[1], v[2]);
        }
        corners_.insert(corners_.end(), v.begin(), v.end());
    }
}

void TinMaker::link_faces() {
    try {
        tin_.mesh = make_mesh(tin_.keys.size(), corners_);
    } catch (const InputError&) {
        refuse_edges();
        throw;
    }
}

/// Names the first two faces that lie on the same side of one edge: among consistently turned faces that is
/// what makes no surface.
void TinMaker::refuse_edges() const {
    struct Use {
        std::uint32_t from;
        std::uint32_t to;
        std::size_t corner;
        auto operator<=>(const Use&) const = default;
    };
    std::vector<Use> uses;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        uses.push_back({corners_[i].value, corners_[next].value, i});
    }
    std::sort(uses.begin(), uses.end());
    for (std::size_t i = 1; i < uses.size(); ++i) {
        if (uses[i].from == uses[i - 1].from && uses[i].to == uses[i - 1].to) {
            const Point3 p = tin_.position({uses[i].from});
            throw InputError(feature(uses[i].corner / 3) + ": overlaps feature " +
                             std::to_string(file_.face_ids[uses[i - 1].corner / 3]) +
                             ", on the same side of an edge " + at(p) + kCheck);
        }
    }
    throw InputError("layer " + io::quoted(file_.layer) + ": the faces are no surface" + kCheck);
}

void TinMaker::constrain_edges() {
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    if (file_.constrained_edges.empty()) {
        return;
    }
    std::vector<Edge> edges;
    edges.reserve(file_.constrained_edges.size());
    for (const auto& [a, b] : file_.constrained_edges) {
        edges.emplace_back(std::minmax(vertex_of_[a], vertex_of_[b]));
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<bool> is_found(edges.size());
    for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
        for (unsigned i = 0; i < 3 && tin_.mesh.is_terrain({f}); ++i) {
            const HalfEdgeId h = half_edge({f}, i);
            const Edge edge = std::minmax(tin_.mesh.origin(h).value, tin_.mesh.destination(h).value);
            const auto place = std::lower_bound(edges.begin(), edges.end(), edge);
            if (place != edges.end() && *place == edge) {
                tin_.mesh.set_constrained(h, true);
                is_found[static_cast<std::size_t>(place - edges.begin())] = true;
            }
        }
    }
    const auto missing = std::find(is_found.begin(), is_found.end(), false);
    if (missing != is_found.end()) {
        const Edge edge = edges[static_cast<std::size_t>(missing - is_found.begin())];
        throw InputError("layer " + io::quoted(file_.layer) + ": the constrained edge from " +
                         at(tin_.position({edge.first})).substr(3) + " to " +
                         at(tin_.position({edge.second})).substr(3) + " is no edge of a face");
    }
}

void TinMaker::trace_lines() {
    tin_.traces.reserve(file_.line_edges.size());
    for (const TinFile::LineEdge& edge : file_.line_edges) {
        const auto [a, b] = std::minmax(vertex_of_[edge.a], vertex_of_[edge.b]);
        tin_.traces.push_back({{a}, {b}, edge.line});
    }
    std::sort(tin_.traces.begin(), tin_.traces.end());
    tin_.traces.erase(std::unique(tin_.traces.begin(), tin_.traces.end()), tin_.traces.end());
}

}  // namespace

Tin make_tin(const TinFile& file) { return TinMaker(file).make(); }

std::vector<bool> water_faces_of(const TinFile& file, const Tin& tin) {
    std::vector<bool> is_water = file.is_water;
    if (!is_water.empty()) {
        is_water.resize(tin.mesh.slot_count());  // faces have the file's order, then come ghosts
    }
    return is_water;
}

}  // namespace tinwright::io
