#include "explanation.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/constructions.hpp"
#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/geometry/predicates.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/mesh/mesh_walk.hpp"
#include "tinwright/surface/breakline_distance.hpp"
#include "tinwright/surface/facets.hpp"
#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/sample_tree.hpp"
#include "tinwright/surface/sharp_edges.hpp"

#include "surface_sampler.hpp"

namespace tinwright::tools {

namespace {

/// Everything that is told of one TIN's vertices and edges.
class Explainer {
  public:
    Explainer(const Surface& surface, const ExplainOptions& options)
        : surface_(surface),
          tin_(surface.tin),
          options_(options),
          sharp_(tin_, surface.is_line_sharp),
          positions_(surface.crs, options.place_crs, surface.bounds()) {}

    Explanation explain() const {
        const SurfaceLocator locator(tin_);
        const Key2 at = locator.lattice().at(options_.in_plane);
        Explanation result;
        result.asked = options_.at;
        result.quantum = tin_.lattice.quantum();
        result.step = locator.lattice().step();
        explain_neighbourhood(at, result);
        if (const std::optional<SurfacePlace> place = locator.find(at)) {
            result.is_inside = true;
            explain_face(*place, result);
            explain_methods(*place, result);
        }
        return result;
    }

  private:
    void explain_neighbourhood(Key2 at, Explanation& result) const {
        const SampleTree samples(tin_);
        const std::optional<VertexId> nearest =
            QueryLattice::is_near(at) ? samples.nearest(at) : nearest_of_all(options_.in_plane);
        if (!nearest) {
            throw InputError("the surface has no vertex: there is nothing to explain");
        }
        result.nearest = vertex(*nearest);
        result.nearest_distance = QueryLattice::is_near(at) && !surface_.ground.is_geodesic()
                                      ? samples.distance(at, *nearest)
                                      : ground_distance(options_.in_plane, *nearest);
        const BreaklineDistance breaklines(tin_, breaklines_of(surface_));
        if (!breaklines.is_empty()) {
            result.breakline_distance = breaklines.at(at, surface_.ground);
        }
    }

    /// For places so far out that keys do not reach them; as `SampleTree` of vertices that were given, or of
    /// all where none was.
    [[nodiscard]] std::optional<VertexId> nearest_of_all(Point2 from) const {
        const auto is_given = [](std::uint32_t sample) { return sample < Tin::kInserted; };
        const bool is_any_given = std::any_of(tin_.sample.begin(), tin_.sample.end(), is_given);
        std::optional<VertexId> best;
        for (std::uint32_t v = 0; v < tin_.vertex_count(); ++v) {
            if ((is_given(tin_.sample[v]) || !is_any_given) &&
                (!best || distance(from, {v}) < distance(from, *best))) {
                best = VertexId{v};
            }
        }
        return best;
    }

    [[nodiscard]] double distance(Point2 from, VertexId v) const {
        const Point3 p = tin_.position(v);
        return std::hypot(p.x - from.x, p.y - from.y);
    }
    [[nodiscard]] double ground_distance(Point2 from, VertexId v) const {
        const Point3 p = tin_.position(v);
        return surface_.ground.length(from, {p.x, p.y});
    }

    void explain_face(const SurfacePlace& place, Explanation& result) const {
        const TriangleMesh& mesh = tin_.mesh;
        result.face = number_terrain(mesh)[place.face.value];
        bool is_delaunay = true;
        std::size_t constrained = 0;
        for (unsigned i = 0; i < 3; ++i) {
            result.corners[i] = vertex(mesh.vertex(place.face, i));
            result.edges[i] = edge(half_edge(place.face, i));
            is_delaunay = is_delaunay && result.edges[i].is_delaunay.value_or(true);
            constrained += result.edges[i].is_constrained ? 1U : 0U;
        }
        result.made_by = maker(is_delaunay, constrained);
        if (const auto criterion = find_criterion(surface_.criterion.name)) {
            const Norm norm = surface_.criterion.edge_norm();
            result.measure =
                told_factor(*criterion, surface_.z_factor) * measure_face(tin_, place.face, *criterion, norm);
            if (*criterion == Criterion::Length) {
                result.length = explain_length(result.edges, norm, *result.measure);
            }
        }
    }

    [[nodiscard]] ExplainedLength explain_length(const std::array<ExplainedEdge, 3>& edges, Norm norm,
                                                 double measure) const {
        ExplainedLength longest;
        for (std::size_t i = 1; i < edges.size(); ++i) {
            const ExplainedEdge& best = edges[longest.edge];
            if (compare_lengths(norm, tin_.key(edges[i].a), tin_.key(edges[i].b), tin_.key(best.a),
                                tin_.key(best.b)) > 0) {
                longest.edge = i;
            }
        }
        longest.of_tin = find_worst(tin_, Criterion::Length, norm).all;
        const bool is_on_ground = surface_.ground.is_geodesic() && norm.is_euclidean();
        longest.told = is_on_ground ? edges[longest.edge].length : measure;
        longest.of_tin_told = is_on_ground ? longest_edge_on_ground() : longest.of_tin;
        longest.unit = is_on_ground ? surface_.ground.unit : surface_.criterion.unit;
        return longest;
    }

    /// On the ground, of the edge that is longest in the plane.
    [[nodiscard]] double longest_edge_on_ground() const {
        double longest = -1;
        HalfEdgeId edge{};
        for (std::uint32_t f = 0; f < tin_.mesh.slot_count(); ++f) {
            for (unsigned i = 0; i < 3 && tin_.mesh.is_terrain({f}); ++i) {
                const HalfEdgeId h = half_edge({f}, i);
                const double squared =
                    squared_distance(tin_.key(tin_.mesh.origin(h)), tin_.key(tin_.mesh.destination(h)));
                if (squared > longest) {
                    longest = squared;
                    edge = h;
                }
            }
        }
        const Point3 p = tin_.position(tin_.mesh.origin(edge));
        return ground_distance({p.x, p.y}, tin_.mesh.destination(edge));
    }

    [[nodiscard]] std::string maker(bool is_delaunay, std::size_t constrained) const {
        const std::string& criterion = surface_.criterion.name;
        std::string text = is_delaunay ? "Delaunay: no neighbour lies in its circle" : "not Delaunay: ";
        if (!is_delaunay) {
            text += constrained > 0 ? "a constrained edge holds it" : "a neighbour lies in its circle";
            if (!criterion.empty() && criterion != "delaunay") {
                text += constrained > 0 ? ", or the criterion " + criterion + " made it"
                                        : "; the criterion " + criterion + " made it";
            } else if (constrained == 0) {
                text += "; made by a constraint near by, or as the file has it";
            }
        }
        return text;
    }

    [[nodiscard]] ExplainedVertex vertex(VertexId v) const {
        ExplainedVertex explained{v, tin_.position(v), kind_of(v), {}};
        positions_.apply_to(std::span(&explained.position, 1));
        const io::VertexOrigins& origins = surface_.origins.vertices;
        explained.from = provenance(v.value < origins.source.size() ? origins.source[v.value] : 0,
                                    v.value < origins.feature.size() ? origins.feature[v.value] : -1);
        return explained;
    }

    [[nodiscard]] std::string kind_of(VertexId v) const {
        const std::uint32_t sample = tin_.sample[v.value];
        if (sample == Tin::kNoSample) {
            return "Steiner point";
        }
        if (sample == Tin::kCrossing) {
            return "crossing";
        }
        if (sample == Tin::kInserted) {
            return "inserted point";
        }
        return is_of_line(v) ? "line vertex" : "sample";
    }

    /// Of sources the index says it; of a TIN file that its source has lines.
    [[nodiscard]] bool is_of_line(VertexId v) const {
        if (surface_.report) {
            const auto& slices = surface_.slices;
            return slices.empty() || tin_.sample[v.value] >= slices.back().first + slices.back().count;
        }
        const std::vector<std::int32_t>& sources = surface_.origins.vertices.source;
        const auto& lines = surface_.origins.lines;
        return v.value < sources.size() && sources[v.value] > 0 &&
               std::any_of(lines.begin(), lines.end(),
                           [&](const io::LineOrigin& line) { return line.source == sources[v.value]; });
    }

    [[nodiscard]] Provenance provenance(std::int32_t number, std::int64_t feature) const {
        const auto index = static_cast<std::size_t>(std::max(number, 1)) - 1;
        const bool is_named = number > 0 && index < surface_.source_names.size();
        return {is_named ? surface_.source_names[index] : SourceName{}, number, feature};
    }

    [[nodiscard]] ExplainedEdge edge(HalfEdgeId h) const {
        const TriangleMesh& mesh = tin_.mesh;
        ExplainedEdge explained;
        explained.a = mesh.origin(h);
        explained.b = mesh.destination(h);
        const Point3 p = tin_.position(explained.a);
        explained.length = ground_distance({p.x, p.y}, explained.b);
        explained.is_constrained = mesh.is_constrained(h);
        explained.is_border = mesh.is_border(h);
        explained.is_sharp = sharp_.is_sharp(h);
        const HalfEdgeId twin = mesh.twin(h);
        if (!mesh.is_ghost(face_of(twin))) {
            explained.is_delaunay =
                incircle(tin_.key(explained.a), tin_.key(explained.b), tin_.key(mesh.origin(previous(h))),
                         tin_.key(mesh.origin(previous(twin)))) <= 0;
        }
        const LineTrace first{std::min(explained.a, explained.b), std::max(explained.a, explained.b), 0, 0};
        for (auto trace = std::lower_bound(tin_.traces.begin(), tin_.traces.end(), first);
             trace != tin_.traces.end() && trace->a == first.a && trace->b == first.b; ++trace) {
            if (trace->line < surface_.origins.lines.size()) {
                const io::LineOrigin& line = surface_.origins.lines[trace->line];
                explained.lines.push_back(
                    {role_name(line.role), line.is_sharp, provenance(line.source, line.feature)});
            }
        }
        return explained;
    }

    void explain_methods(const SurfacePlace& place, Explanation& result) const {
        for (const auto& [name, method] : kInterpolationMethods) {
            InterpolationOptions options = options_.interpolation.options;
            const bool is_asked = options.method == method;
            if (method == InterpolationMethod::SmoothC1 && !is_asked) {
                std::erase_if(options.smooth.kernels,
                              [](const SmoothOptions::Kernel& kernel) { return kernel.exponent < 1.5; });
            }
            options.method = method;
            options.threads = options_.threads;
            const auto surface =
                keep_facets(tin_, make_interpolator(tin_, sharp_, options), surface_.is_water_face);
            const auto reader = surface->make_reader();
            ExplainedMethod explained{std::string(name), reader->read(place), {}};
            explained.reading.gradient = {surface_.z_factor * explained.reading.gradient.x,
                                          surface_.z_factor * explained.reading.gradient.y};
            reader->find_weights(place, explained.weights);
            std::sort(explained.weights.begin(), explained.weights.end(),
                      [](const VertexWeight& a, const VertexWeight& b) {
                          return std::abs(a.weight) != std::abs(b.weight)
                                     ? std::abs(a.weight) > std::abs(b.weight)
                                     : a.vertex < b.vertex;
                      });
            result.methods.push_back(std::move(explained));
        }
    }

    const Surface& surface_;
    const Tin& tin_;
    const ExplainOptions& options_;
    SharpEdges sharp_;
    io::OutputPositions positions_;
};

}  // namespace

Explanation explain(const Surface& surface, const ExplainOptions& options) {
    return Explainer(surface, options).explain();
}

}  // namespace tinwright::tools
