#include "tinwright/breaklines/snap_rounding.hpp"

#include <algorithm>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "tinwright/breaklines/square_passes.hpp"
#include "tinwright/geometry/curve.hpp"
#include "tinwright/geometry/predicates.hpp"

namespace tinwright {
namespace {

/// Sites and crossings, each location once; tells at which of them each site is.
std::vector<Key2> merge_vertices(std::span<const Key2> sites, std::span<const Key2> crossings,
                                 std::vector<std::uint32_t>& of_site) {
    std::vector<Key2> vertices;
    vertices.reserve(sites.size() + crossings.size());
    of_site.reserve(sites.size());
    const auto add = [&](Key2 key) {
        if (vertices.empty() || vertices.back() != key) {
            vertices.push_back(key);
        }
    };
    std::size_t next_site = 0;
    const auto add_sites_until = [&](const auto& is_reached) {
        for (; next_site < sites.size() && !is_reached(sites[next_site]); ++next_site) {
            add(sites[next_site]);
            of_site.push_back(static_cast<std::uint32_t>(vertices.size() - 1));
        }
    };
    for (const std::uint32_t i : sort_along_curve(crossings)) {
        add_sites_until([&](Key2 site) { return precedes_on_curve(crossings[i], site); });
        add(crossings[i]);
    }
    add_sites_until([](Key2 /*site*/) { return false; });
    return vertices;
}

class Rounding {
  public:
    Rounding(const LineNetwork& network, const SegmentCrossings& crossings,
             std::span<const std::uint32_t> led)
        : network_(network), rounded_(crossings.rounded), led_(led) {
        out_.vertices = merge_vertices(network.sites, crossings.keys, out_.of_site);
        segments_.reserve(network.segments.size());
        for (std::uint32_t s = 0; s < network.segments.size(); ++s) {
            segments_.push_back({network.a(s), network.b(s)});
        }
        is_compared_.assign(segments_.size(), 0);
        for (const std::span<const std::uint32_t> segments : {led, std::span(crossings.meeting)}) {
            for (const std::uint32_t segment : segments) {
                is_compared_[segment] = 1;
            }
        }
    }

    RoundedSegments round() && {
        lead_all();
        if (concerns_others()) {
            is_compared_.assign(segments_.size(), 1);
            lead_all();
        }
        make_chains();
        return std::move(out_);
    }

  private:
    /// Leads the segments that have to be, of those that are compared with the vertices.
    void lead_all() {
        by_vertex_ = passes_of_segments(out_.vertices, 1);
        vertex_start_ = starts(out_.vertices.size(), [](const VertexPass& pass) { return pass.vertex; });
        sort_by_segment();
        is_led_.assign(segments_.size(), 0);
        for (const std::span<const std::uint32_t> segments : {led_, rounded_}) {
            std::for_each(segments.begin(), segments.end(), [&](std::uint32_t s) { lead(s); });
        }
        while (!to_follow_.empty()) {
            const std::uint32_t segment = to_follow_.back();
            to_follow_.pop_back();
            lead_crossed_by(segment);
        }
    }

    /// Passes of the segments that are compared with the vertices, or of those that are not.
    [[nodiscard]] std::vector<VertexPass> passes_of_segments(std::span<const Key2> vertices,
                                                             char are_compared) const {
        std::vector<std::uint32_t> numbers;
        std::vector<SegmentKeys> chosen;
        for (std::uint32_t s = 0; s < segments_.size(); ++s) {
            if (is_compared_[s] == are_compared) {
                numbers.push_back(s);
                chosen.push_back(segments_[s]);
            }
        }
        std::vector<VertexPass> passes = find_passes(vertices, chosen);
        for (VertexPass& pass : passes) {
            pass.segment = numbers[pass.segment];
        }
        return passes;
    }

    /// Whether a segment not yet compared has to be: no other's end lies on it, so only the vertices matter
    /// that led segments pass off the centre, and sites without segments.
    [[nodiscard]] bool concerns_others() const {
        std::vector<char> matters(out_.vertices.size(), 1);
        for (const LineSegment& segment : network_.segments) {
            matters[out_.of_site[segment.a]] = matters[out_.of_site[segment.b]] = 0;
        }
        for (const VertexPass& pass : by_vertex_) {
            if (pass.kind == SquarePass::Through && is_led_[pass.segment] != 0) {
                matters[pass.vertex] = 1;
            }
        }
        std::vector<Key2> vertices;
        for (std::size_t v = 0; v < matters.size(); ++v) {
            if (matters[v] != 0) {
                vertices.push_back(out_.vertices[v]);
            }
        }
        return !passes_of_segments(vertices, 0).empty();
    }

    void lead(std::uint32_t segment) {
        if (is_led_[segment] == 0) {
            is_led_[segment] = 1;
            to_follow_.push_back(segment);
        }
    }

    template <class NumberOf>
    std::vector<std::uint32_t> starts(std::size_t count, const NumberOf& number_of) const {
        std::vector<std::uint32_t> start(count + 1);
        for (const VertexPass& pass : by_vertex_) {
            ++start[number_of(pass) + 1];
        }
        for (std::size_t i = 0; i < count; ++i) {
            start[i + 1] += start[i];
        }
        return start;
    }

    /// A straight way through squares is monotone in x and in y, hence so are the squares' centres.
    void sort_by_segment() {
        segment_start_ = starts(segments_.size(), [](const VertexPass& pass) { return pass.segment; });
        by_segment_.resize(by_vertex_.size());
        std::vector<std::uint32_t> next = segment_start_;
        for (const VertexPass& pass : by_vertex_) {
            by_segment_[next[pass.segment]++] = pass;
        }
        for_each_segment([&](std::uint32_t s) {
            const bool falls = segments_[s].b.y < segments_[s].a.y;
            std::sort(by_segment_.begin() + segment_start_[s], by_segment_.begin() + segment_start_[s + 1],
                      [&](const VertexPass& left, const VertexPass& right) {
                          const Key2 p = out_.vertices[left.vertex];
                          const Key2 q = out_.vertices[right.vertex];
                          return p.x < q.x || (p.x == q.x && (falls ? q.y < p.y : p.y < q.y));
                      });
        });
    }

    template <class Body>
    void for_each_segment(const Body& body) const {
        constexpr std::size_t kGrain = 1024;
        tbb::parallel_for(
            tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(segments_.size()), kGrain),
            [&](const tbb::blocked_range<std::uint32_t>& range) {
                for (std::uint32_t s = range.begin(); s != range.end(); ++s) {
                    body(s);
                }
            });
    }

    [[nodiscard]] std::uint32_t vertex_a(std::uint32_t s) const {
        return out_.of_site[network_.segments[s].a];
    }
    [[nodiscard]] std::uint32_t vertex_b(std::uint32_t s) const {
        return out_.of_site[network_.segments[s].b];
    }
    [[nodiscard]] std::span<const VertexPass> passes_of(std::uint32_t s) const {
        return std::span(by_segment_).subspan(segment_start_[s], segment_start_[s + 1] - segment_start_[s]);
    }
    [[nodiscard]] std::span<const VertexPass> passes_at(std::uint32_t vertex) const {
        return std::span(by_vertex_)
            .subspan(vertex_start_[vertex], vertex_start_[vertex + 1] - vertex_start_[vertex]);
    }
    [[nodiscard]] bool leads_through(std::uint32_t s, SquarePass kind) const {
        return kind == SquarePass::Center || (kind == SquarePass::Through && is_led_[s] != 0);
    }

    /// The straight segments that edges of a led segment's chain cross are led too.
    void lead_crossed_by(std::uint32_t s) {
        const std::span<const VertexPass> passes = passes_of(s);
        std::uint32_t before = vertex_a(s);
        for (std::size_t i = 0; i < passes.size(); ++i) {
            if (passes[i].kind == SquarePass::Corner) {
                continue;
            }
            std::size_t next = i + 1;
            while (next < passes.size() && passes[next].kind == SquarePass::Corner) {
                ++next;
            }
            const std::uint32_t after = next < passes.size() ? passes[next].vertex : vertex_b(s);
            if (passes[i].kind == SquarePass::Through) {
                lead_crossed_at(before, passes[i].vertex, after);
            }
            before = passes[i].vertex;
        }
    }

    void lead_crossed_at(std::uint32_t before, std::uint32_t vertex, std::uint32_t after) {
        const Key2 here = out_.vertices[vertex];
        for (const VertexPass& pass : passes_at(vertex)) {
            const std::uint32_t s = pass.segment;
            if (pass.kind == SquarePass::Through && is_led_[s] == 0 &&
                (do_cross(segments_[s].a, segments_[s].b, out_.vertices[before], here) ||
                 do_cross(segments_[s].a, segments_[s].b, here, out_.vertices[after]))) {
                lead(s);
            }
        }
    }

    void make_chains() {
        out_.start.resize(segments_.size() + 1);
        for_each_segment([&](std::uint32_t s) {
            std::uint32_t length = 0;
            visit_chain(s, [&](std::uint32_t /*vertex*/) { ++length; });
            out_.start[s + 1] = length;
        });
        for (std::size_t s = 0; s < segments_.size(); ++s) {
            out_.start[s + 1] += out_.start[s];
        }
        out_.chains.resize(out_.start.back());
        for_each_segment([&](std::uint32_t s) {
            std::uint32_t place = out_.start[s];
            visit_chain(s, [&](std::uint32_t vertex) { out_.chains[place++] = vertex; });
        });
        out_.is_rounded = std::any_of(by_vertex_.begin(), by_vertex_.end(), [&](const VertexPass& pass) {
            return pass.kind == SquarePass::Through && is_led_[pass.segment] != 0;
        });
    }

    template <class Visit>
    void visit_chain(std::uint32_t s, const Visit& visit) const {
        const std::span<const VertexPass> passes = passes_of(s);
        visit(vertex_a(s));
        std::uint32_t before = vertex_a(s);
        for (std::size_t i = 0; i < passes.size();) {
            std::size_t next = i;  // the next that the chain certainly goes through
            while (next < passes.size() && !leads_through(s, passes[next].kind)) {
                ++next;
            }
            const std::uint32_t after = next < passes.size() ? passes[next].vertex : vertex_b(s);
            for (; i < next; ++i) {
                if (is_led_[s] != 0 && is_between(before, passes[i].vertex, after)) {
                    visit(passes[i].vertex);
                }
            }
            if (next < passes.size()) {
                visit(after);
                before = after;
                ++i;
            }
        }
        visit(vertex_b(s));
    }

    /// Whether an edge goes exactly through a vertex whose square its segment touches with a corner.
    [[nodiscard]] bool is_between(std::uint32_t before, std::uint32_t vertex, std::uint32_t after) const {
        return pass_square(out_.vertices[before], out_.vertices[after], out_.vertices[vertex]) ==
               SquarePass::Center;
    }

    const LineNetwork& network_;
    std::span<const std::uint32_t> rounded_;
    std::span<const std::uint32_t> led_;
    RoundedSegments out_;
    std::vector<SegmentKeys> segments_;
    std::vector<char> is_compared_;  // one a segment
    std::vector<VertexPass> by_vertex_;
    std::vector<std::uint32_t> vertex_start_;
    std::vector<VertexPass> by_segment_;  // in the order along each segment
    std::vector<std::uint32_t> segment_start_;
    std::vector<char> is_led_;
    std::vector<std::uint32_t> to_follow_;
};

}  // namespace

RoundedSegments round_segments(const LineNetwork& network, const SegmentCrossings& crossings,
                               std::span<const std::uint32_t> led) {
    return Rounding(network, crossings, led).round();
}

}  // namespace tinwright
