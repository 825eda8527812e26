#include "tinwright/delaunay/chord_ends.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tinwright {

namespace {

double dot(Offset a, Offset b) { return a.x * b.x + a.y * b.y; }

// A chord seen from the centre of its disk.
struct CenteredChord {
    LineInDisks* edge;
    Chord* chord;
    Offset begin;
    Offset end;
    Offset normal;      // of length 1
    double distance;    // of the line from the centre, along the normal
    double crease = 0;  // how steeply power grows to either side

    [[nodiscard]] double height(Offset place) const { return std::abs(dot(normal, place) - distance); }
};

// The chords within one disk.
class ChordsOfDisk {
  public:
    ChordsOfDisk(const BlockingDisk& disk, std::span<const Key2> keys)
        : disk_(disk), to_vertex_{-disk.center.x, -disk.center.y} {
        const Key2 vertex = keys[disk.vertex.value];
        const Key2 other = keys[disk.towards.value];
        center_ = {vertex.x + disk.center.x, vertex.y + disk.center.y};
        has_other_ = disk.radius > kNear * 0.5 * std::hypot(other.x - vertex.x, other.y - vertex.y);
    }

    void add(LineInDisks& edge, Chord& chord, Key2 p, Key2 q) {
        const Offset start{p.x - center_.x, p.y - center_.y};
        const Offset way{q.x - p.x, q.y - p.y};
        const auto at = [&](double share) {
            return Offset{start.x + share * way.x, start.y + share * way.y};
        };
        const Offset normal{-way.y / edge.length, way.x / edge.length};
        chords_.push_back({&edge, &chord, at(chord.from), at(chord.to), normal, dot(normal, start)});
    }

    void move_ends() {
        if (chords_.size() > kMost) {
            return;
        }
        for (CenteredChord& chord : chords_) {
            crease(chord);
        }
        const Level level = find_level();
        const auto change = [&](Offset place) { return power(place) - level.at(along(place)); };
        for (const CenteredChord& moved : chords_) {
            Chord& chord = *moved.chord;
            const double length = (chord.to - chord.from) * moved.edge->length;
            const auto step = [&](Offset end) {
                const double way = change(end) / length;  // power grows with the whole chord's length
                return std::clamp(way, -kShare * length, kShare * length) / moved.edge->length;
            };
            if (chord.from > 0) {
                chord.from -= step(moved.begin);
            }
            if (chord.to < 1) {
                chord.to += step(moved.end);
            }
        }
    }

  private:
    static constexpr std::size_t kMost = 1000;
    static constexpr double kNear = 0.99;   // of a full disk: i_j counts as on the circle
    static constexpr double kShare = 0.05;  // of a chord: no end moves farther than that

    // A linear function of how far a place is along the edge of the tree.
    struct Level {
        double at_vertex;  // where that is 1
        double at_other;   // where it is -1
        [[nodiscard]] double at(double along) const {
            return 0.5 * ((1 + along) * at_vertex + (1 - along) * at_other);
        }
    };

    // From the vertex, 1, to the other side of the circle, -1.
    [[nodiscard]] double along(Offset place) const {
        return dot(place, to_vertex_) / (disk_.radius * disk_.radius);
    }

    // What to take off the power of ends: none of them is to leave the disk, but those at vertices stay where
    // they are, and so does the power there.
    [[nodiscard]] Level find_level() const {
        const Level level{power(to_vertex_), power(disk_.center)};
        const bool has_vertex = ends_at(disk_.vertex);
        const bool has_other = has_other_ && ends_at(disk_.towards);
        if (has_vertex) {
            return {level.at_vertex, has_other ? level.at_other : tilt(level.at_vertex, level.at_other, 1)};
        }
        if (has_other) {
            return {tilt(level.at_other, level.at_vertex, -1), level.at_other};
        }
        double most = std::max(level.at_vertex, level.at_other);
        for (const CenteredChord& chord : chords_) {
            most = std::max({most, power(chord.begin), power(chord.end)});
        }
        return {most, most};
    }

    // The level opposite of a side of the circle (1 or -1), given the one there, at which no power exceeds
    // the level; ends so close to that side that they ask for too much do not count.
    [[nodiscard]] double tilt(double fixed, double least, int side) const {
        double level = least;
        for (const CenteredChord& chord : chords_) {
            for (const Offset place : {chord.begin, chord.end}) {
                const double share = 0.5 * (1 - side * along(place));
                if (share > kShare) {
                    level = std::max(level, fixed + (power(place) - fixed) / share);
                }
            }
        }
        return level;
    }

    [[nodiscard]] bool ends_at(VertexId v) const {
        return std::any_of(chords_.begin(), chords_.end(), [&](const CenteredChord& chord) {
            return (chord.chord->from <= 0 && chord.edge->p == v) ||
                   (chord.chord->to >= 1 && chord.edge->q == v);
        });
    }

    // A place that is rounded moves by up to 3 steps, which changes its power by up to 6 radii, and 4 places
    // decide together whether an edge is Delaunay.
    void crease(CenteredChord& chord) const {
        constexpr double kRounding = 24;
        constexpr double kSteepest = 0.005;  // of the radius
        double least = disk_.radius;
        const auto look_at = [&](Offset place) {
            const double height = chord.height(place);
            if (height > 1) {
                least = std::min(least, height);
            }
        };
        for (const CenteredChord& other : chords_) {
            look_at(other.begin);
            look_at(other.end);
        }
        look_at(to_vertex_);
        if (has_other_) {
            look_at(disk_.center);
        }
        chord.crease = std::min(kRounding * disk_.radius / least, kSteepest * disk_.radius);
    }

    [[nodiscard]] double power(Offset place) const {
        double sum = 0;
        for (const CenteredChord& chord : chords_) {
            sum += chord.crease * chord.height(place);
        }
        return sum;
    }

    const BlockingDisk& disk_;
    Offset to_vertex_;  // j, from the centre
    Key2 center_{};
    bool has_other_ = false;  // whether i_j is on the circle, opposite of j
    std::vector<CenteredChord> chords_;
};

}  // namespace

void move_chord_ends(const BlockingDisks& disks, std::span<const Key2> keys, std::span<LineInDisks> edges) {
    struct Entry {
        std::uint32_t disk;
        std::uint32_t edge;
        std::uint32_t chord;
        auto operator<=>(const Entry&) const = default;
    };
    std::vector<Entry> entries;
    for (std::uint32_t k = 0; k < edges.size(); ++k) {
        for (std::uint32_t i = 0; i < edges[k].chords.size(); ++i) {
            entries.push_back({edges[k].chords[i].disk, k, i});
        }
    }
    std::sort(entries.begin(), entries.end());
    for (auto first = entries.begin(); first != entries.end();) {
        const BlockingDisk& disk = disks.disks()[first->disk];
        ChordsOfDisk chords(disk, keys);
        auto entry = first;
        for (; entry != entries.end() && entry->disk == first->disk; ++entry) {
            LineInDisks& edge = edges[entry->edge];
            chords.add(edge, edge.chords[entry->chord], keys[edge.p.value], keys[edge.q.value]);
        }
        chords.move_ends();
        first = entry;
    }
}

}  // namespace tinwright
