#include "tinwright/water/banks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "tinwright/geometry/constructions.hpp"
#include "tinwright/water/bays.hpp"
#include "tinwright/water/level_places.hpp"
#include "tinwright/water/section_choice.hpp"
#include "tinwright/water/water_mesh.hpp"
#include "tinwright/water/water_rows.hpp"

namespace tinwright {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

class NetworkMaker {
  public:
    explicit NetworkMaker(std::span<const std::vector<Key2>> rings)
        : water_(make_water_mesh(rings)),
          is_open_(find_open_water(water_)),
          rows_(find_water_rows(water_, is_open_)),
          level_places_(water_, rows_),
          number_(water_.keys.size()),
          section_of_(water_.keys.size(), kNone),
          place_of_(water_.keys.size(), BankPlace{kNone, kNone, 0}) {
        for (std::uint32_t ring = 0; ring < water_.rings.size(); ++ring) {
            for (std::uint32_t i = 0; i < water_.rings[ring].size(); ++i) {
                number_[water_.rings[ring][i].value] = {ring, i};
            }
        }
    }

    BankNetwork make() {
        add_level_places();
        for (const FaceId f : rows_.lonely) {
            add_lonely(f);
        }
        for (const WaterRow& row : rows_.rows) {
            divide(row);
        }
        level_bays();
        hand_out_places();
        find_ends();
        return std::move(network_);
    }

  private:
    // A section that a row passes, or begins or ends with.
    struct Stop {
        std::uint32_t section;
        std::size_t first;  // edges of the row at the section: one, or at a junction none before or behind it
        std::size_t last;
        std::optional<std::uint32_t> junction;
    };

    std::uint32_t add_section(const std::vector<VertexId>& vertices, Point2 middle, double width,
                              bool is_straight) {
        const auto number = static_cast<std::uint32_t>(network_.sections.size());
        BankSection& section = network_.sections.emplace_back();
        for (const VertexId v : vertices) {
            section.vertices.push_back(number_[v.value]);
            section_of_[v.value] = number;
            place_of_[v.value] = {number, number, 0};
        }
        section.middle = middle;
        section.width = width;
        section.is_straight = is_straight;
        return number;
    }

    void add_level_places() {
        for (const LevelPlaces::Place& place : level_places_.places()) {
            add_section(place.vertices, place.middle, place.width, false);
        }
    }

    void add_lonely(FaceId f) {
        const auto& corner = water_.mesh.face(f).vertex;
        Point2 middle{};
        double width = 0;
        for (unsigned i = 0; i < 3; ++i) {
            middle.x += water_.key(corner[i]).x / 3;
            middle.y += water_.key(corner[i]).y / 3;
            width = std::max(width, water_.length(half_edge(f, i)));
        }
        std::vector<VertexId> vertices(corner.begin(), corner.end());
        std::sort(vertices.begin(), vertices.end());
        add_section(vertices, middle, width, false);
    }

    void divide(const WaterRow& row) {
        const std::vector<Stop> stops = find_stops(row);
        for (std::size_t i = 1; i < stops.size(); ++i) {
            if (stops[i - 1].section != stops[i].section) {
                link(row, stops[i - 1], stops[i]);
            }
        }
        level_bank(row, true);
        level_bank(row, false);
    }

    std::vector<Stop> find_stops(const WaterRow& row) {
        const auto edges = rows_.edges_of(row);
        std::vector<Stop> stops;
        const std::uint32_t from = place_at(row.from);
        const std::uint32_t to = place_at(row.to);
        if (from != kNone) {
            stops.push_back({from, 0, 0, row.from});
        }
        // Water from one junction of a place to another is as level as the place. A way round an island and
        // back to the very junction where it began is not: it may rise towards the middle, and fall.
        if (from == kNone || from != to || row.from == row.to) {
            for (const std::uint32_t i : choose(row)) {
                const HalfEdgeId h = edges[i];
                const std::uint32_t section =
                    add_section({std::min(left(h), right(h)), std::max(left(h), right(h))}, water_.middle(h),
                                water_.length(h), true);
                stops.push_back({section, i, i + 1, {}});
            }
        }
        if (to != kNone) {
            stops.push_back({to, edges.size(), edges.size(), row.to});
        }
        if (row.is_closed) {
            stops.push_back({stops.front().section, edges.size() - 1, edges.size(), {}});
        }
        return stops;
    }

    [[nodiscard]] std::vector<std::uint32_t> choose(const WaterRow& row) const {
        std::vector<RowEdge> across;
        for (const HalfEdgeId h : rows_.edges_of(row)) {
            across.push_back({left(h), right(h), water_.length(h),
                              section_of_[left(h).value] == kNone && section_of_[right(h).value] == kNone});
        }
        if (!row.is_closed) {
            return choose_sections(across);
        }
        const RowEdge shortest = across.front();
        for (RowEdge& edge : across) {
            edge.is_free = edge.left != shortest.left && edge.right != shortest.right;
        }
        std::vector<std::uint32_t> chosen = choose_sections(across);
        chosen.insert(chosen.begin(), 0);
        return chosen;
    }

    void link(const WaterRow& row, const Stop& from, const Stop& to) {
        const auto edges = rows_.edges_of(row);
        BankLink& made = network_.links.emplace_back();
        made.a = from.section;
        made.b = to.section;
        if (from.junction) {
            level_places_.append_way(*from.junction, made.path);
        }
        for (std::size_t i = from.first; i < to.last; ++i) {
            made.path.push_back(water_.middle(edges[i]));
        }
        if (to.junction) {
            std::vector<Point2> way;
            level_places_.append_way(*to.junction, way);
            made.path.insert(made.path.end(), way.rbegin(), way.rend());
        }
        for (std::size_t i = 1; i < made.path.size(); ++i) {
            made.length +=
                std::hypot(made.path[i].x - made.path[i - 1].x, made.path[i].y - made.path[i - 1].y);
        }
    }

    // Places of the vertices on one bank of a row.
    void level_bank(const WaterRow& row, bool is_left) {
        std::vector<VertexId> bank;
        const auto edges = rows_.edges_of(row);
        if (row.from == WaterRow::kEnd && !row.is_closed) {
            bank.push_back(tip(water_.mesh.twin(edges.front())));
        }
        for (const HalfEdgeId h : edges) {
            const VertexId v = is_left ? left(h) : right(h);
            if (bank.empty() || bank.back() != v) {
                bank.push_back(v);
            }
        }
        if (row.to == WaterRow::kEnd && !row.is_closed) {
            bank.push_back(tip(edges.back()));
        }
        level_chain(bank);
    }

    // Vertices before the first section have its level, those behind the last that one's; those between two
    // are levelled by length.
    void level_chain(std::span<const VertexId> chain) {
        std::size_t last = chain.size();  // with a section
        for (std::size_t i = 0; i < chain.size(); ++i) {
            if (section_of_[chain[i].value] == kNone) {
                continue;
            }
            if (last == chain.size()) {
                fill(chain.first(i), section_of_[chain[i].value]);
            } else {
                interpolate(chain.subspan(last, i + 1 - last));
            }
            last = i;
        }
        fill(chain.subspan(last + 1), section_of_[chain[last].value]);
    }

    void fill(std::span<const VertexId> chain, std::uint32_t section) {
        for (const VertexId v : chain) {
            place_of_[v.value] = {section, section, 0};
        }
    }

    // Between the places of the ends.
    void interpolate(std::span<const VertexId> chain) {
        if (chain.size() < 3) {
            return;
        }
        const BankPlace from = place_of_[chain.front().value];
        const BankPlace to = place_of_[chain.back().value];
        // At most one of them is between sections and not at one, or both are between the same.
        const BankPlace& between = from.a != from.b ? from : to;
        BankPlace span{from.a, to.a, 0};
        if (between.a != between.b) {
            span = between;
        }
        const auto part_of = [&](const BankPlace& place) {
            if (place.a != place.b) {
                return place.part;
            }
            return place.a == span.a ? 0.0 : 1.0;
        };
        const double first = part_of(from);
        const double last = part_of(to);
        double whole = 0;
        for (std::size_t i = 1; i < chain.size(); ++i) {
            whole += distance(chain[i - 1], chain[i]);
        }
        double way = 0;
        for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
            way += distance(chain[i - 1], chain[i]);
            BankPlace place = span;
            place.part = std::clamp(first + (last - first) * (way / whole), std::min(first, last),
                                    std::max(first, last));
            if (span.a == span.b || place.part == 0) {
                place = {span.a, span.a, 0};
            } else if (place.part == 1) {
                place = {span.b, span.b, 0};
            }
            place_of_[chain[i].value] = place;
        }
    }

    // Bays as parts of the bank: between the places of the two ends of their mouths.
    void level_bays() {
        const TriangleMesh& mesh = water_.mesh;
        std::vector<VertexId> next_on_bank(water_.keys.size());
        for_each_edge([&](HalfEdgeId h) {
            if (mesh.is_constrained(h)) {
                next_on_bank[mesh.origin(h).value] = mesh.destination(h);
            }
        });
        std::vector<VertexId> bay;
        for_each_edge([&](HalfEdgeId mouth) {
            if (mesh.is_constrained(mouth) || !is_open_[face_of(mouth).value] ||
                is_open_[face_of(mesh.twin(mouth)).value]) {
                return;
            }
            bay.assign(1, mesh.origin(mouth));
            while (bay.back() != mesh.destination(mouth)) {
                bay.push_back(next_on_bank[bay.back().value]);
            }
            interpolate(bay);
        });
    }

    template <class Visit>
    void for_each_edge(const Visit& visit) const {
        for (FaceId f{0}; f.value < water_.mesh.slot_count(); ++f.value) {
            for (unsigned corner = 0; corner < 3 && water_.mesh.is_terrain(f); ++corner) {
                visit(half_edge(f, corner));
            }
        }
    }

    void hand_out_places() {
        for (const std::vector<VertexId>& ring : water_.rings) {
            std::vector<BankPlace>& places = network_.places.emplace_back();
            places.reserve(ring.size());
            for (const VertexId v : ring) {
                places.push_back(place_of_[v.value]);
            }
        }
    }

    void find_ends() {
        std::vector<std::uint32_t> counts(network_.sections.size(), 0);
        for (const BankLink& made : network_.links) {
            ++counts[made.a];
            ++counts[made.b];
        }
        for (std::uint32_t i = 0; i < counts.size(); ++i) {
            if (counts[i] == 1) {
                network_.ends.push_back(i);
            }
        }
    }

    // The level place at the end of a row, which is the section of this number.
    [[nodiscard]] std::uint32_t place_at(std::uint32_t junction) const {
        return junction == WaterRow::kEnd
                   ? kNone
                   : level_places_.place_at(water_.mesh.vertex(rows_.junctions[junction], 0));
    }
    [[nodiscard]] VertexId left(HalfEdgeId h) const { return water_.mesh.origin(h); }
    [[nodiscard]] VertexId right(HalfEdgeId h) const { return water_.mesh.destination(h); }
    [[nodiscard]] VertexId tip(HalfEdgeId h) const { return water_.mesh.origin(previous(h)); }
    [[nodiscard]] double distance(VertexId a, VertexId b) const {
        return std::sqrt(squared_distance(water_.key(a), water_.key(b)));
    }

    WaterMesh water_;
    std::vector<bool> is_open_;
    WaterRows rows_;
    LevelPlaces level_places_;
    std::vector<std::array<std::uint32_t, 2>> number_;  // ring, and number in it, of each vertex
    std::vector<std::uint32_t> section_of_;             // of each vertex
    std::vector<BankPlace> place_of_;                   // of each vertex
    BankNetwork network_;
};

}  // namespace

BankNetwork make_bank_network(std::span<const std::vector<Key2>> rings) { return NetworkMaker(rings).make(); }

}  // namespace tinwright
