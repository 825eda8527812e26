#include "tinwright/delaunay/sample_vertices.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <compare>
#include <limits>
#include <numeric>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/large_vector.hpp"

namespace tinwright {

namespace {

constexpr std::size_t kGrain = 1U << 14U;
constexpr std::size_t kMostSamples = std::size_t{1} << 29U;
constexpr std::size_t kNamedConflicts = 10;

// Whether the number was meant as it stands: at most 15 digits, as no rounding error has.
bool is_written(double value) { return std::abs(shortest_decimal(value).digits) < 1'000'000'000'000'000; }

// Samples that a lattice coarser than the data puts on one key must be one location up to rounding noise.
void check_merged(const Point3& a, const Point3& b, double noise, const Lattice& lattice,
                  std::size_t sample_a, std::size_t sample_b) {
    const auto differ = [&](double u, double v) {
        return u != v && (std::abs(u - v) > noise || (is_written(u) && is_written(v)));
    };
    if (differ(a.x, b.x) || differ(a.y, b.y)) {
        throw InputError(
            "the extent of the samples is too large for their detail: " + location_text({a.x, a.y}) +
                " and " + location_text({b.x, b.y}) + " are closer than " + decimal_text(lattice.quantum()) +
                ", the extent divided by 2^45 = 35184372088832; remove outlying samples or round the "
                "coordinates",
            {sample_a, sample_b});
    }
}

class Merger {
  public:
    Merger(std::span<const Point3> samples, const DuplicateOptions& options, SampleVertices& out)
        : samples_(samples), options_(options), out_(out) {
        const Box& b = out.bounds;
        const double largest =
            std::max({std::abs(b.x_min), std::abs(b.x_max), std::abs(b.y_min), std::abs(b.y_max)});
        noise_ = 16 * (std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest);
    }

    // `group`: the ascending indices of two or more samples at the vertex's key.
    void merge(std::size_t vertex, std::span<const std::uint32_t> group) {
        sorted_.clear();
        for (const std::uint32_t i : group) {
            sorted_.push_back(samples_[i].z);
            if (!out_.lattice.is_exact()) {
                check_merged(samples_[group.front()], samples_[i], noise_, out_.lattice, group.front(), i);
            }
        }
        // A total order, so that zeros of both signs do not stay in the order they came in.
        std::sort(sorted_.begin(), sorted_.end(),
                  [](double a, double b) { return std::strong_order(a, b) < 0; });
        const double z_min = sorted_.front();
        const double z_max = sorted_.back();
        const bool conflicts = z_max - z_min > options_.tolerance;
        (conflicts ? out_.duplicates.conflicting : out_.duplicates.equal) += group.size() - 1;
        if (conflicts) {
            ++conflicting_locations_;
            if (out_.duplicates.first.size() < kNamedConflicts) {
                const Point2 location = out_.lattice.position(out_.keys[vertex]);
                out_.duplicates.first.push_back({location, {group.begin(), group.end()}, z_min, z_max});
            }
        }
        const bool takes_last = options_.policy == DuplicatePolicy::Last;
        out_.sample[vertex] = takes_last ? group.back() : group.front();
        out_.z[vertex] = takes_last || options_.policy == DuplicatePolicy::First
                             ? samples_[out_.sample[vertex]].z
                             : choose_elevation(options_.policy, sorted_);
    }

    void finish() const {
        if (conflicting_locations_ == 0 || options_.policy != DuplicatePolicy::Error) {
            return;
        }
        const DuplicateConflict& first = out_.duplicates.first.front();
        const bool one = conflicting_locations_ == 1;
        throw DuplicateError(
            std::to_string(conflicting_locations_) + (one ? " location has" : " locations have") +
                " samples with different elevations, " + (one ? "at " : "the first at ") +
                location_text(first.location) + " with z from " + decimal_text(first.z_min) + " to " +
                decimal_text(first.z_max) +
                "; say which to take with --duplicates first|last|min|max|mean|median, or allow "
                "for the difference with --duplicate-tolerance",
            out_.duplicates.first, conflicting_locations_);
    }

  private:
    std::span<const Point3> samples_;
    const DuplicateOptions& options_;
    SampleVertices& out_;
    std::vector<double> sorted_;  // elevations of the group at hand
    double noise_ = 0;
    std::size_t conflicting_locations_ = 0;
};

// Runs body(i) for each sample index, in parallel.
template <class Body>
void for_each_index(std::size_t count, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i != range.end(); ++i) {
                              body(i);
                          }
                      });
}

// Fills keys, z and sample, one entry a sample, in curve order; samples at one key by ascending index.
// Returns a position before which no key is repeated, most often the number of samples. Keys are computed
// twice rather than kept: a pass over fresh memory costs more than the arithmetic.
std::size_t order_samples(std::span<const Point3> samples, SampleVertices& out) {
    const auto key_of = [&](std::size_t i) { return out.lattice.key({samples[i].x, samples[i].y}); };
    const Key2 corner = out.lattice.key({out.bounds.x_max, out.bounds.y_max});
    const std::size_t count = samples.size();
    const CurvePacking packing(std::max(corner.x, corner.y), count);
    LargeVector<std::uint64_t> words(count);
    {
        LargeVector<std::uint64_t> scratch(count);
        for_each_index(count, [&](std::size_t i) { words[i] = packing.pack(key_of(i), i); });
        sort_packed(words, scratch, packing, key_of);
    }
    out.keys.resize(count);
    out.z.resize(count);
    out.sample.resize(count);
    std::atomic<std::size_t> first_repeated = count;
    for_each_index(count, [&](std::size_t i) {
        // Samples come from all over memory: asking for them ahead hides part of the wait.
        constexpr std::size_t kAhead = 24;
        const Point3& ahead = samples[packing.index(words[std::min(i + kAhead, count - 1)])];
        __builtin_prefetch(&ahead.x);
        __builtin_prefetch(&ahead.z);
        const std::uint32_t sample = packing.index(words[i]);
        out.keys[i] = key_of(sample);
        out.z[i] = samples[sample].z;
        out.sample[i] = sample;
        if (i + 1 < count && packing.is_same_place(words[i], words[i + 1])) {
            std::size_t known = first_repeated;
            while (i < known && !first_repeated.compare_exchange_weak(known, i)) {
            }
        }
    });
    return first_repeated;
}

}  // namespace

double choose_elevation(DuplicatePolicy policy, std::span<const double> z) {
    const std::size_t middle = z.size() / 2;
    switch (policy) {
        case DuplicatePolicy::Min:
            return z.front();
        case DuplicatePolicy::Max:
            return z.back();
        case DuplicatePolicy::Median:
            return z.size() % 2 == 1 ? z[middle] : std::midpoint(z[middle - 1], z[middle]);
        default: {  // the mean, counted from the lowest, so that equal elevations give themselves
            double sum = 0;
            for (const double value : z) {
                sum += value - z.front();
            }
            return z.front() + sum / static_cast<double>(z.size());
        }
    }
}

SampleVertices make_sample_vertices(std::span<const Point3> samples, const DuplicateOptions& options) {
    return make_sample_vertices(samples, find_lattice(samples), options);
}

SampleVertices make_sample_vertices(std::span<const Point3> samples, const FoundLattice& found,
                                    const DuplicateOptions& options) {
    if (samples.size() > kMostSamples) {
        throw InputError(std::to_string(samples.size()) + " samples are more than the limit of 2^29 = " +
                         std::to_string(kMostSamples) + "; thin or tile them");
    }
    SampleVertices out;
    out.lattice = found.lattice;
    out.bounds = found.bounds;
    if (samples.empty()) {
        return out;
    }
    std::size_t vertices = order_samples(samples, out);

    // Runs of equal keys shrink to one vertex each; nothing moves as long as there is none.
    Merger merger(samples, options, out);
    for (std::size_t first = vertices; first < out.keys.size();) {
        std::size_t last = first + 1;
        while (last < out.keys.size() && out.keys[last] == out.keys[first]) {
            ++last;
        }
        out.keys[vertices] = out.keys[first];
        out.z[vertices] = out.z[first];
        if (last - first > 1) {
            const std::vector<std::uint32_t> group(out.sample.begin() + static_cast<std::ptrdiff_t>(first),
                                                   out.sample.begin() + static_cast<std::ptrdiff_t>(last));
            merger.merge(vertices, group);
        } else {
            out.sample[vertices] = out.sample[first];
        }
        ++vertices;
        first = last;
    }
    merger.finish();
    out.keys.resize(vertices);
    out.z.resize(vertices);
    out.sample.resize(vertices);
    return out;
}

}  // namespace tinwright
