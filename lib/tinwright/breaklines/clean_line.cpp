#include "tinwright/breaklines/clean_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {
namespace {

using Kind = LineConflict::Kind;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

class LineCleaner {
  public:
    LineCleaner(std::span<const Point3> points, const Lattice& lattice, const CleanOptions& options,
                std::vector<LineFault>& faults)
        : points_(points), lattice_(lattice), options_(options), faults_(faults) {}

    CleanLine run() {
        const auto before = static_cast<std::ptrdiff_t>(faults_.size());
        merge_repeated();
        if (options_.is_ring) {
            close();
        } else {
            drop_retraced_end();
            reverse();
            drop_retraced_end();
            reverse();
        }
        if (line_.is_closed()) {
            cut_spikes(false);
            cut_spikes_at_closure();
        } else {
            cut_spikes(true);
        }
        const bool is_listed =
            std::any_of(faults_.begin() + before, faults_.end(),
                        [](const LineFault& fault) { return fault.kind == Kind::ZeroLength; });
        if (line_.keys.size() == 1 && !is_listed) {
            faults_.push_back({Kind::ZeroLength, line_.keys[0], line_.z[0], kNone});
        }
        return std::move(line_);
    }

  private:
    void merge_repeated();
    void close();
    void reverse();
    void drop_retraced_end();
    void cut_spikes(bool is_open);
    void cut_spikes_at_closure();
    [[nodiscard]] bool is_spike(Key2 a, Key2 tip, Key2 b) const;

    std::span<const Point3> points_;
    const Lattice& lattice_;
    const CleanOptions& options_;
    std::vector<LineFault>& faults_;
    CleanLine line_;
};

void LineCleaner::merge_repeated() {
    std::vector<double> z;
    for (std::size_t begin = 0, end = 0; begin < points_.size(); begin = end) {
        const Key2 key = lattice_.key({points_[begin].x, points_[begin].y});
        z.clear();
        for (end = begin; end < points_.size(); ++end) {
            if (!(lattice_.key({points_[end].x, points_[end].y}) == key)) {
                break;
            }
            z.push_back(points_[end].z);
        }
        line_.keys.push_back(key);
        line_.z.push_back(merge_z(z, options_.crossing_z));
        if (z.size() > 1) {
            const auto other =
                std::find_if(z.begin() + 1, z.end(), [&](double value) { return value != z.front(); });
            faults_.push_back({Kind::ZeroLength, key, z.front(), other == z.end() ? z[1] : *other});
        }
    }
}

void LineCleaner::close() {
    if (line_.keys.size() < 2 || line_.keys.front() == line_.keys.back()) {
        return;
    }
    faults_.push_back({Kind::OpenRing, line_.keys.back(), line_.z.back(), kNone});
    const bool is_narrow = line_.keys.size() > 3 && squared_distance(line_.keys.front(), line_.keys.back()) <=
                                                        options_.snap * options_.snap;
    if (is_narrow) {
        line_.keys.back() = line_.keys.front();
        line_.z.back() = line_.z.front();
    } else {
        line_.keys.push_back(line_.keys.front());
        line_.z.push_back(line_.z.front());
    }
}

void LineCleaner::reverse() {
    std::reverse(line_.keys.begin(), line_.keys.end());
    std::reverse(line_.z.begin(), line_.z.end());
}

/// A line that turns round and goes back along itself until it ends is cut where it turns.
void LineCleaner::drop_retraced_end() {
    std::vector<Key2>& keys = line_.keys;
    for (std::size_t tip = keys.size() / 2; tip + 1 < keys.size(); ++tip) {
        std::size_t i = tip + 1;
        while (i < keys.size() && keys[i] == keys[2 * tip - i]) {
            ++i;
        }
        if (i == keys.size()) {
            faults_.push_back({Kind::Spike, keys[tip], line_.z[tip], kNone});
            keys.resize(tip + 1);
            line_.z.resize(tip + 1);
            return;
        }
    }
}

bool LineCleaner::is_spike(Key2 a, Key2 tip, Key2 b) const {
    if (angle_sign(a, tip, b) <= 0) {
        return false;
    }
    if (orient2d(a, tip, b) == 0) {
        return true;
    }
    const bool is_a_shorter = compare_distances(a, tip, b, tip) < 0;
    const Key2 shorter = is_a_shorter ? a : b;
    const Key2 longer = is_a_shorter ? b : a;
    const double limit = options_.snap * options_.snap;
    return squared_distance(shorter, tip) > limit && measure_distance(shorter, tip, longer).squared <= limit;
}

void LineCleaner::cut_spikes(bool is_open) {
    CleanLine kept;
    const auto erase_at = [&](std::size_t i) {
        kept.keys.erase(kept.keys.begin() + static_cast<std::ptrdiff_t>(i));
        kept.z.erase(kept.z.begin() + static_cast<std::ptrdiff_t>(i));
    };
    for (std::size_t i = 0; i < line_.keys.size(); ++i) {
        if (!kept.keys.empty() && kept.keys.back() == line_.keys[i]) {
            continue;  // back where a spike began
        }
        kept.keys.push_back(line_.keys[i]);
        kept.z.push_back(line_.z[i]);
        for (std::size_t n = kept.keys.size(); n > 2; n = kept.keys.size()) {
            const Key2 a = kept.keys[n - 3];
            const Key2 tip = kept.keys[n - 2];
            const Key2 b = kept.keys[n - 1];
            if (!is_spike(a, tip, b)) {
                break;
            }
            faults_.push_back({Kind::Spike, tip, kept.z[n - 2], kNone});
            const bool is_last = is_open && i + 1 == line_.keys.size();
            if (is_last && compare_distances(b, tip, a, tip) <= 0) {
                erase_at(n - 1);
            } else if (is_open && n == 3 && compare_distances(a, tip, b, tip) <= 0) {
                erase_at(0);
            } else {
                erase_at(n - 2);
                if (a == b) {
                    erase_at(n - 2);
                }
            }
        }
    }
    line_ = std::move(kept);
}

void LineCleaner::cut_spikes_at_closure() {
    while (line_.is_closed()) {
        const std::size_t n = line_.keys.size();
        if (!is_spike(line_.keys[n - 2], line_.keys[0], line_.keys[1])) {
            return;
        }
        faults_.push_back({Kind::Spike, line_.keys[0], line_.z[0], kNone});
        line_.keys.erase(line_.keys.begin());
        line_.z.erase(line_.z.begin());
        if (line_.keys[n - 3] == line_.keys[0]) {
            line_.keys.pop_back();
            line_.z.pop_back();
        } else {
            line_.keys.back() = line_.keys.front();
            line_.z.back() = line_.z.front();
        }
    }
}

}  // namespace

CleanLine clean_line(std::span<const Point3> points, const Lattice& lattice, const CleanOptions& options,
                     std::vector<LineFault>& faults) {
    return LineCleaner(points, lattice, options, faults).run();
}

double merge_z(std::vector<double> z, CrossingPolicy policy) {
    std::erase_if(z, [](double value) { return std::isnan(value); });
    if (z.empty()) {
        return kNone;
    }
    if (policy == CrossingPolicy::First) {
        return z.front();
    }
    std::sort(z.begin(), z.end());  // so that the sum does not depend on the order
    if (policy == CrossingPolicy::Min || z.front() == z.back()) {
        return z.front();
    }
    if (policy == CrossingPolicy::Max) {
        return z.back();
    }
    return std::accumulate(z.begin(), z.end(), 0.0) / static_cast<double>(z.size());
}

}  // namespace tinwright
