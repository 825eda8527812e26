#include "support/triangulation_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "support/triangulation_sweep.hpp"

namespace tinwright_tests::oracle {

using tinwright::Criterion;
using tinwright::Key2;
using tinwright::Norm;

namespace {

__extension__ using Wide = __int128;

Wide difference(double to, double from) {
    return static_cast<std::int64_t>(to) - static_cast<std::int64_t>(from);
}

Wide cross(Key2 origin, Key2 a, Key2 b) {
    return difference(a.x, origin.x) * difference(b.y, origin.y) -
           difference(a.y, origin.y) * difference(b.x, origin.x);
}

Wide dot(Key2 origin, Key2 a, Key2 b) {
    return difference(a.x, origin.x) * difference(b.x, origin.x) +
           difference(a.y, origin.y) * difference(b.y, origin.y);
}

long double number(Wide value) { return static_cast<long double>(value); }

long double largest_angle(const std::array<Site, 3>& p) {
    long double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Key2 apex = p[i].key;
        const Key2 b = p[(i + 1) % 3].key;
        const Key2 c = p[(i + 2) % 3].key;
        const long double area = std::fabs(number(cross(apex, b, c)));
        largest = std::max(largest, std::atan2(area, number(dot(apex, b, c))));
    }
    return largest * (180 / std::numbers::pi_v<long double>);
}

long double least_height(const std::array<Site, 3>& p) {
    const long double area = std::fabs(number(cross(p[0].key, p[1].key, p[2].key)));
    long double least = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        const Key2 a = p[i].key;
        const Key2 b = p[(i + 1) % 3].key;
        least = std::min(least, area / std::sqrt(number(dot(a, b, b))));
    }
    return least;
}

long double slope(const std::array<Site, 3>& p) {
    const long double area = number(cross(p[0].key, p[1].key, p[2].key));
    const auto along = [&p](std::size_t i, double Key2::*axis) {
        return number(difference(p[i].key.*axis, p[0].key.*axis));
    };
    const auto rise = [&p](std::size_t i) {
        return static_cast<long double>(p[i].z) - static_cast<long double>(p[0].z);
    };
    const long double x = rise(1) * along(2, &Key2::y) - rise(2) * along(1, &Key2::y);
    const long double y = rise(2) * along(1, &Key2::x) - rise(1) * along(2, &Key2::x);
    return std::hypot(x, y) / std::fabs(area);
}

/// The centre is as far beyond the side opposite an obtuse angle as that side's half times its cotangent.
long double eccentricity(const std::array<Site, 3>& p) {
    const long double area = std::fabs(number(cross(p[0].key, p[1].key, p[2].key)));
    for (std::size_t i = 0; i < 3; ++i) {
        const Key2 b = p[(i + 1) % 3].key;
        const Key2 c = p[(i + 2) % 3].key;
        const Wide inner = dot(p[i].key, b, c);
        if (inner < 0) {
            return std::sqrt(number(dot(b, c, c))) * -number(inner) / (2 * area);
        }
    }
    return 0;
}

long double length_of(Norm norm, Key2 a, Key2 b) {
    const long double x = std::fabs(number(difference(b.x, a.x)));
    const long double y = std::fabs(number(difference(b.y, a.y)));
    if (norm.is_maximum()) {
        return std::max(x, y);
    }
    const long double p = norm.power();
    return std::pow(std::pow(x, p) + std::pow(y, p), 1 / p);
}

long double longest_edge(const std::array<Site, 3>& p, Norm norm) {
    return std::max({length_of(norm, p[0].key, p[1].key), length_of(norm, p[1].key, p[2].key),
                     length_of(norm, p[0].key, p[2].key)});
}

bool is_before(Key2 a, Key2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// What a sweep with whole vectors adds up: the sorted badnesses.
class Badnesses {
  public:
    using Value = std::vector<long double>;

    Badnesses(const FaceTable& table, Criterion criterion, Norm norm)
        : size_(table.size()), badness_(size_ * size_ * size_) {
        for (std::size_t a = 0; a < size_; ++a) {
            for (std::size_t b = a + 1; b < size_; ++b) {
                for (std::size_t c = b + 1; c < size_; ++c) {
                    if (table.is_face(a, b, c)) {
                        badness_[(a * size_ + b) * size_ + c] =
                            badness(criterion, table.point(a), table.point(b), table.point(c), norm);
                    }
                }
            }
        }
    }

    [[nodiscard]] Value with_face(Value vector, std::size_t a, std::size_t b, std::size_t c) const {
        const long double value = badness_[(a * size_ + b) * size_ + c];
        vector.insert(std::lower_bound(vector.begin(), vector.end(), value, std::greater<>()), value);
        return vector;
    }

  private:
    std::size_t size_;
    std::vector<long double> badness_;
};

/// All triangulations, one by one.
class Enumeration {
  public:
    Enumeration(const FaceTable& table, const std::function<void(const std::vector<Triple>&)>& visit)
        : table_(table), visit_(visit) {
        const std::size_t n = table.size();
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = 0; b < n; ++b) {
                if (a != b && is_hull_edge(a, b)) {
                    open_[{a, b}] = true;
                    edges_.push_back({a, b});
                }
            }
        }
    }

    void run() {
        const auto edge = std::find_if(open_.begin(), open_.end(), [](const auto& e) { return e.second; });
        if (edge == open_.end()) {
            visit_(faces_);
            return;
        }
        const auto [a, b] = edge->first;
        for (std::size_t p = 0; p < table_.size(); ++p) {
            if (p == a || p == b || table_.side(a, b, p) <= 0) {
                continue;
            }
            std::array<std::size_t, 3> sorted{a, b, p};
            std::sort(sorted.begin(), sorted.end());
            if (table_.is_face(sorted[0], sorted[1], sorted[2]) && is_free(b, p) && is_free(p, a)) {
                place(a, b, p);
            }
        }
    }

  private:
    /// Whether all points are left of a b or on it, and none between a and b.
    [[nodiscard]] bool is_hull_edge(std::size_t a, std::size_t b) const {
        for (std::size_t p = 0; p < table_.size(); ++p) {
            if (table_.side(a, b, p) < 0 ||
                is_inside_segment(table_.point(p).key, table_.point(a).key, table_.point(b).key)) {
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] bool is_free(std::size_t a, std::size_t b) const {
        return std::none_of(edges_.begin(), edges_.end(),
                            [&](const auto& e) { return table_.do_edges_cross(a, b, e[0], e[1]); });
    }

    void place(std::size_t a, std::size_t b, std::size_t p) {
        const auto open = open_;
        const std::size_t edge_count = edges_.size();
        open_[{a, b}] = false;
        for (const auto& [from, to] : {std::array{b, p}, std::array{p, a}}) {
            const auto waiting = open_.find({from, to});
            if (waiting != open_.end() && waiting->second) {
                waiting->second = false;
            } else {
                open_[{to, from}] = true;
                edges_.push_back({from, to});
            }
        }
        faces_.push_back({table_.site(a), table_.site(b), table_.site(p)});
        run();
        faces_.pop_back();
        edges_.resize(edge_count);
        open_ = open;
    }

    const FaceTable& table_;
    const std::function<void(const std::vector<Triple>&)>& visit_;
    std::map<std::array<std::size_t, 2>, bool> open_;  ///< directed edges and whether a face is missing left
    std::vector<std::array<std::size_t, 2>> edges_;
    std::vector<Triple> faces_;
};

}  // namespace

int turn(Key2 a, Key2 b, Key2 c) {
    const Wide area = cross(a, b, c);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

bool do_cross(Key2 a, Key2 b, Key2 c, Key2 d) {
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool is_inside_segment(Key2 p, Key2 a, Key2 b) {
    return p != a && p != b && turn(a, b, p) == 0 && dot(p, a, b) < 0;
}

long double badness(Criterion criterion, Site a, Site b, Site c, Norm norm) {
    std::array<Site, 3> p{a, b, c};
    std::sort(p.begin(), p.end(), [](const Site& s, const Site& t) { return is_before(s.key, t.key); });
    switch (criterion) {
        case Criterion::Angle:
            return largest_angle(p);
        case Criterion::Height:
            return -least_height(p);
        case Criterion::Slope:
            return slope(p);
        case Criterion::Length:
            return longest_edge(p, norm);
        case Criterion::Eccentricity:
            break;
    }
    return eccentricity(p);
}

std::vector<long double> best_badnesses(const Sites& sites, Criterion criterion, Norm norm) {
    const FaceTable table(sites);
    const Badnesses badnesses(table, criterion, norm);
    return Sweep(table, badnesses).best();
}

void for_each_triangulation(const Sites& sites,
                            const std::function<void(const std::vector<Triple>&)>& visit) {
    const FaceTable table(sites);
    Enumeration(table, visit).run();
}

}  // namespace tinwright_tests::oracle
