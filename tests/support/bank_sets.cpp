#include "support/bank_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "support/ring_sets.hpp"

namespace tinwright_tests {

using tinwright::Key2;

namespace {

using Keys = std::vector<Key2>;
using Corner = std::pair<int, int>;

constexpr double kOrigin = 1 << 20;

double at_most_last(const std::vector<double>& widths, int i) {
    return widths[std::min(static_cast<std::size_t>(i), widths.size() - 1)];
}

// Where the lines between columns are, or between rows.
std::vector<double> line_places(const std::vector<double>& widths, int count) {
    std::vector<double> places{kOrigin};
    for (int i = 0; i < count; ++i) {
        places.push_back(places.back() + at_most_last(widths, i));
    }
    return places;
}

// The loops of the sides of the '#', with these on the left.
std::vector<std::vector<Corner>> loops_of(std::span<const std::string_view> map) {
    const int rows = static_cast<int>(map.size());
    const int columns = static_cast<int>(map.front().size());
    const auto is_water = [&](int column, int row) {
        return column >= 0 && row >= 0 && column < columns && row < rows &&
               map[static_cast<std::size_t>(rows - 1 - row)][static_cast<std::size_t>(column)] == '#';
    };
    std::map<Corner, Corner> side_from;
    for (int x = 0; x < columns; ++x) {
        for (int y = 0; y < rows; ++y) {
            if (!is_water(x, y)) {
                continue;
            }
            if (!is_water(x, y - 1)) {
                side_from[{x, y}] = {x + 1, y};
            }
            if (!is_water(x + 1, y)) {
                side_from[{x + 1, y}] = {x + 1, y + 1};
            }
            if (!is_water(x, y + 1)) {
                side_from[{x + 1, y + 1}] = {x, y + 1};
            }
            if (!is_water(x - 1, y)) {
                side_from[{x, y + 1}] = {x, y};
            }
        }
    }
    std::vector<std::vector<Corner>> loops;
    while (!side_from.empty()) {
        // The first of all that are left is on the left of its loop: the outer one comes first.
        std::vector<Corner>& loop = loops.emplace_back();
        const Corner first = side_from.begin()->first;
        Corner at = first;
        do {
            loop.push_back(at);
            const auto side = side_from.find(at);
            at = side->second;
            side_from.erase(side);
        } while (at != first);
    }
    return loops;
}

BankSet of_ring(Keys ring) { return {{std::move(ring)}}; }

std::size_t choose(Random& random, std::size_t low, std::size_t high) {
    return static_cast<std::size_t>(
        random.integer(static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)));
}

BankSet straight(Random& random, std::size_t size) {
    return straight_banks(std::max<std::size_t>(size / 2, 2), 10, static_cast<double>(choose(random, 5, 60)));
}

// Banks with stations of their own each, which come nearer to each other or part.
BankSet trapezoid(Random& random, std::size_t size) {
    const double length = 40.0 * static_cast<double>(size);
    const double narrow = random.integer(0, 1) == 0 ? 1 : 50;
    Keys ring;
    std::vector<double> lower{0, length};
    std::vector<double> upper{0, length};
    for (std::size_t i = 4; i < size; ++i) {
        (i % 3 == 0 ? lower : upper).push_back(1 + random.key(length - 2));
    }
    for (std::vector<double>* bank : {&lower, &upper}) {
        std::sort(bank->begin(), bank->end());
        bank->erase(std::unique(bank->begin(), bank->end()), bank->end());
    }
    for (const double x : lower) {
        ring.push_back({kOrigin + x, kOrigin});
    }
    std::reverse(upper.begin(), upper.end());
    for (const double x : upper) {
        ring.push_back({kOrigin + x, kOrigin + narrow + std::round(x * 0.2)});
    }
    return of_ring(ring);
}

BankSet meander(Random& random, std::size_t size) {
    const std::size_t bends = choose(random, 1, 6);
    std::vector<std::size_t> islands;
    for (std::size_t i = 0; i < bends; ++i) {
        if (random.integer(0, 2) == 0) {
            islands.push_back(i);
        }
    }
    return meander_banks(bends, 0.2 + 1.6 * random.real(), std::max(size / 2, 8 * bends), 20000, islands);
}

// A channel to and fro, with hardly anything between.
BankSet hairpins(Random& random, std::size_t size) {
    std::vector<std::string> rows;
    const std::size_t turns = choose(random, 1, 4);
    for (std::size_t i = 0; i < turns; ++i) {
        rows.emplace_back("####");
        rows.emplace_back(i % 2 == 0 ? "...#" : "#...");
    }
    rows.emplace_back("####");
    const std::vector<std::string_view> map(rows.begin(), rows.end());
    MapScale scale{{400}, {}, 3200.0 * static_cast<double>(turns) / static_cast<double>(size)};
    const auto narrow = static_cast<double>(random.integer(1, 5));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        scale.rows.push_back(i % 2 == 0 ? 100 : narrow);
    }
    return banks_from_map(map, scale, random);
}

// Passages of a grid: random walks from place to place, wherever they come.
BankSet maze(Random& random, std::size_t size, bool is_on_lattice) {
    const std::size_t side = choose(random, 2, 5);
    std::vector<std::string> rows(2 * side - 1, std::string(2 * side - 1, '.'));
    std::size_t x = choose(random, 0, side - 1);
    std::size_t y = choose(random, 0, side - 1);
    const std::size_t steps = choose(random, 2, 3 * side * side);
    rows[2 * y][2 * x] = '#';
    for (std::size_t i = 0; i < steps; ++i) {
        const bool goes_up = random.integer(0, 1) == 0;
        const bool goes_along_x = random.integer(0, 1) == 0;
        std::size_t& at = goes_along_x ? x : y;
        if (goes_up ? at + 1 == side : at == 0) {
            continue;
        }
        const std::size_t before_x = x;
        const std::size_t before_y = y;
        at = goes_up ? at + 1 : at - 1;
        rows[y + before_y][x + before_x] = '#';
        rows[2 * y][2 * x] = '#';
    }
    MapScale scale;
    double extent = 0;
    double narrowest = 1e9;
    for (std::vector<double>* widths : {&scale.columns, &scale.rows}) {
        for (std::size_t i = 0; i < 2 * side - 1; ++i) {
            // Channels are at even places, and what is between them at odd ones.
            widths->push_back(is_on_lattice ? 4
                                            : static_cast<double>(random.integer(i % 2 == 0 ? 30 : 4, 300)));
            extent += widths->back();
            narrowest = std::min(narrowest, widths->back());
        }
    }
    scale.spacing = std::max(2 * extent * static_cast<double>(side) / static_cast<double>(size), 1.0);
    if (!is_on_lattice) {
        scale.spacing = std::max(scale.spacing, narrowest);
        scale.jitter = std::floor(narrowest / 4.5);
    }
    const std::vector<std::string_view> map(rows.begin(), rows.end());
    return banks_from_map(map, scale, random);
}

BankSet lattice_maze(Random& random, std::size_t size) { return maze(random, size, true); }
BankSet rough_maze(Random& random, std::size_t size) { return maze(random, size, false); }

// A river, arms that it takes up, and an island near a bank.
BankSet arms(Random& random, std::size_t size) {
    constexpr std::array<std::string_view, 6> kMap{"..#...#...",  //
                                                   "..#...#...",  //
                                                   "##########",  //
                                                   "####.#####",  //
                                                   "##########",  //
                                                   ".....#...."};
    MapScale scale{{60, 10, 8, 40}, {70, 50, 5, 6, 40}, 1400.0 / static_cast<double>(size), 0};
    scale.jitter = random.integer(0, 1) == 0 ? 0 : std::floor(std::min(scale.spacing, 5.0) / 4.5);
    return banks_from_map(kMap, scale, random);
}

// A channel whose banks go in and out.
BankSet bays(Random& random, std::size_t size) {
    Keys ring;
    const auto half = static_cast<std::int64_t>(size / 2);
    for (std::int64_t i = 0; i < half; ++i) {
        ring.push_back({kOrigin + 20.0 * static_cast<double>(i), kOrigin - random.key(40)});
    }
    for (std::int64_t i = half; i-- > 0;) {
        ring.push_back({kOrigin + 20.0 * static_cast<double>(i), kOrigin + 50 + random.key(40)});
    }
    return of_ring(ring);
}

// Channel, pool, channel; a boulder in the pool now and then.
BankSet pool(Random& random, std::size_t size) {
    constexpr std::array<std::string_view, 5> kPool{"..###..", "..###..", "#######", "..###..", "..###.."};
    constexpr std::array<std::string_view, 5> kRock{"..###..", "..###..", "###.###", "..###..", "..###.."};
    const bool has_rock = random.integer(0, 1) == 0;
    const auto middle = static_cast<double>(random.integer(1, 40));
    const MapScale scale{{100, 100, 90, middle, 90, 100, 100},
                         {80, 60, middle, 60, 80},
                         1500.0 / static_cast<double>(size),
                         0};
    return banks_from_map(has_rock ? kRock : kPool, scale, random);
}

// One or two keys wide.
BankSet needle(Random& random, std::size_t size) {
    Keys ring;
    const auto half = static_cast<std::int64_t>(size / 2);
    const bool is_even = random.integer(0, 1) == 0;
    for (std::int64_t i = 0; i < half; ++i) {
        ring.push_back({kOrigin + 1000.0 * static_cast<double>(i), kOrigin});
    }
    for (std::int64_t i = half; i-- > 0;) {
        ring.push_back({kOrigin + 1000.0 * static_cast<double>(i) + (is_even || i == 0 ? 0 : random.key(999)),
                        kOrigin + 1 + static_cast<double>(random.integer(0, 1))});
    }
    return of_ring(ring);
}

BankSet few(Random& random, std::size_t /*size*/) {
    constexpr std::array<std::array<double, 8>, 4> kCorners{{{0, 0, 9, 0, 9, 4, 0, 4},
                                                             {0, 0, 9, 1, 3, 7, 0, 5},
                                                             {0, 0, 4, 4, 8, 0, 4, 9},
                                                             {0, 0, 1000, 1, 2000, 0, 1000, 2}}};
    const auto& corners = kCorners[choose(random, 0, 3)];
    Keys ring;
    const std::size_t count = choose(random, 3, 4);
    for (std::size_t i = 0; i < count; ++i) {
        ring.push_back({kOrigin + corners[2 * i], kOrigin + corners[2 * i + 1]});
    }
    return of_ring(ring);
}

// A ring-shaped moat, with the island in its middle or near its edge.
BankSet moat(Random& random, std::size_t size) {
    const double shift = random.integer(0, 1) == 0 ? 0 : 3500;
    BankSet set;
    for (const bool is_island : {false, true}) {
        Keys ring;
        const std::size_t count = std::max<std::size_t>(is_island ? size / 3 : 2 * size / 3, 6);
        const double radius = is_island ? 6000 : 10000;
        for (std::size_t i = 0; i < count; ++i) {
            const double angle = (is_island ? -1 : 1) * 2 * std::numbers::pi * static_cast<double>(i) /
                                 static_cast<double>(count);
            const double far = radius / std::cos(std::numbers::pi / static_cast<double>(count));
            const double used = is_island ? radius : far;
            ring.push_back({kOrigin + (is_island ? shift : 0) + std::round(used * std::cos(angle)),
                            kOrigin + std::round(used * std::sin(angle))});
        }
        set.rings.push_back(ring);
    }
    return set;
}

template <std::size_t number>
BankSet ring_family(Random& random, std::size_t size) {
    return of_ring(ring_families()[number].make(random, std::min<std::size_t>(size, 40)));
}

constexpr std::array kBankFamilies{BankFamily{"straight", straight},
                                   BankFamily{"trapezoid", trapezoid},
                                   BankFamily{"meander", meander},
                                   BankFamily{"hairpins", hairpins},
                                   BankFamily{"lattice maze", lattice_maze},
                                   BankFamily{"rough maze", rough_maze},
                                   BankFamily{"arms", arms},
                                   BankFamily{"bays", bays},
                                   BankFamily{"pool", pool},
                                   BankFamily{"needle", needle},
                                   BankFamily{"few", few},
                                   BankFamily{"moat", moat},
                                   BankFamily{"near a circle", ring_family<0>},
                                   BankFamily{"fan", ring_family<1>},
                                   BankFamily{"regular", ring_family<2>},
                                   BankFamily{"cut circle", ring_family<3>},
                                   BankFamily{"star", ring_family<4>},
                                   BankFamily{"bow", ring_family<5>},
                                   BankFamily{"comb", ring_family<6>},
                                   BankFamily{"tangle", ring_family<7>},
                                   BankFamily{"tangle of 8", ring_family<8>},
                                   BankFamily{"dense", ring_family<9>}};

}  // namespace

BankSet banks_from_map(std::span<const std::string_view> map, const MapScale& scale, Random& random) {
    const std::vector<double> x = line_places(scale.columns, static_cast<int>(map.front().size()));
    const std::vector<double> y = line_places(scale.rows, static_cast<int>(map.size()));
    const auto most = static_cast<std::int64_t>(scale.jitter);
    BankSet set;
    for (const std::vector<Corner>& loop : loops_of(map)) {
        Keys& ring = set.rings.emplace_back();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto place = [&](Corner c) {
                return Key2{x[static_cast<std::size_t>(c.first)], y[static_cast<std::size_t>(c.second)]};
            };
            const Key2 a = place(loop[i]);
            const Key2 b = place(loop[(i + 1) % loop.size()]);
            const double length = std::abs(b.x - a.x) + std::abs(b.y - a.y);
            const double pieces = std::max(std::min(std::ceil(length / scale.spacing), length), 1.0);
            for (double k = 0; k < pieces; ++k) {
                ring.push_back({std::round(a.x + (b.x - a.x) * k / pieces) +
                                    static_cast<double>(random.integer(-most, most)),
                                std::round(a.y + (b.y - a.y) * k / pieces) +
                                    static_cast<double>(random.integer(-most, most))});
            }
        }
    }
    return set;
}

BankSet straight_banks(std::size_t stations, double spacing, double width) {
    Keys ring;
    for (std::size_t i = 0; i < stations; ++i) {
        ring.push_back({kOrigin + spacing * static_cast<double>(i), kOrigin});
    }
    for (std::size_t i = stations; i-- > 0;) {
        ring.push_back({kOrigin + spacing * static_cast<double>(i), kOrigin + width});
    }
    return of_ring(ring);
}

BankSet meander_banks(std::size_t bends, double steepest, std::size_t stations, double width,
                      std::span<const std::size_t> islands) {
    // Half a wave is five widths long: no bend is narrower than the water is wide.
    constexpr std::size_t kSteps = 64;  // between stations
    const double wave = 5 * width;
    const double length = wave * static_cast<double>(bends);
    const double step = length / static_cast<double>((stations - 1) * kSteps);
    struct Station {
        double x;
        double y;
        double direction;
        double way;
    };
    std::vector<Station> curve;
    Station at{100 * width, 100 * width, steepest, 0};
    for (std::size_t i = 0; i <= (stations - 1) * kSteps; ++i) {
        at.way = step * static_cast<double>(i);
        at.direction = steepest * std::cos(std::numbers::pi * at.way / wave);
        if (i % kSteps == 0) {
            curve.push_back(at);
        }
        at.x += step * std::cos(at.direction);
        at.y += step * std::sin(at.direction);
    }
    const auto beside = [](const Station& s, double offset) {
        return Key2{std::round(s.x - offset * std::sin(s.direction)),
                    std::round(s.y + offset * std::cos(s.direction))};
    };
    BankSet set;
    Keys outer;
    for (const Station& s : curve) {
        outer.push_back(beside(s, -width / 2));
    }
    for (auto s = curve.rbegin(); s != curve.rend(); ++s) {
        outer.push_back(beside(*s, width / 2));
    }
    set.rings.push_back(outer);
    for (const std::size_t number : islands) {
        const double middle = (static_cast<double>(number) + 0.5) * wave;
        Keys ring;
        Keys other;
        for (const Station& s : curve) {
            const double part = (s.way - middle) / (0.3 * wave);
            if (std::abs(part) < 0.999) {
                const double offset = width / 4 * std::sqrt(1 - part * part);
                ring.push_back(beside(s, offset));
                other.push_back(beside(s, -offset));
            }
        }
        ring.insert(ring.end(), other.rbegin(), other.rend());
        if (ring.size() > 3) {
            set.rings.push_back(ring);
        }
    }
    return set;
}

std::span<const BankFamily> bank_families() { return kBankFamilies; }

}  // namespace tinwright_tests
