// What each criterion does to a terrain: Delaunay, flips alone, the optimum. Every tenth sample is held out;
// the table says how steep, how thin and how long the faces are, and how far the surface is from the held-out
// samples.
//   compare_criteria SOURCE [CRS]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tinwright/io/read_samples.hpp"
#include "tinwright/optimal/edge_flip.hpp"
#include "tinwright/optimal/triangulate.hpp"

namespace {

using tinwright::Criterion;
using tinwright::FaceId;
using tinwright::Point3;
using tinwright::Scope;
using tinwright::Tin;

constexpr std::size_t kHeldOutEvery = 10;

template <class Visitor>
void for_each_face(const Tin& tin, Visitor visitor) {
    for (std::uint32_t slot = 0; slot < tin.mesh.slot_count(); ++slot) {
        if (tin.mesh.is_terrain({slot})) {
            visitor(FaceId{slot});
        }
    }
}

/// Samples that the TIN does not know, in square cells so that those within a face are found quickly.
class HeldOut {
  public:
    HeldOut(const std::vector<Point3>& samples, const tinwright::Box& bounds)
        : samples_(samples),
          low_{bounds.x_min, bounds.y_min},
          side_(static_cast<std::size_t>(std::sqrt(static_cast<double>(samples.size()))) + 1) {
        const double extent = std::max(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min);
        cell_ = extent / static_cast<double>(side_);
        cells_.resize(side_ * side_);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const Point3& p = samples[i];
            cells_[index(p.x - low_.x) + side_ * index(p.y - low_.y)].push_back(i);
        }
    }

    /// Root mean square of sample minus surface, over the samples that lie on the surface.
    [[nodiscard]] double rmse(const Tin& tin) const {
        std::vector<std::optional<double>> errors(samples_.size());
        for_each_face(tin, [&](FaceId face) { add_errors(tin, face, errors); });
        double sum = 0;
        std::size_t count = 0;
        for (const std::optional<double>& error : errors) {
            sum += error ? *error * *error : 0;
            count += error ? 1 : 0;
        }
        return std::sqrt(sum / static_cast<double>(count));
    }

  private:
    [[nodiscard]] std::size_t index(double distance) const {
        const auto last = static_cast<double>(side_ - 1);
        return static_cast<std::size_t>(std::clamp(std::floor(distance / cell_), 0.0, last));
    }

    void add_errors(const Tin& tin, FaceId face, std::vector<std::optional<double>>& errors) const {
        const Point3 a = tin.position(tin.mesh.vertex(face, 0));
        const Point3 b = tin.position(tin.mesh.vertex(face, 1));
        const Point3 c = tin.position(tin.mesh.vertex(face, 2));
        const auto [left, right] = std::minmax({a.x, b.x, c.x});
        const auto [low, high] = std::minmax({a.y, b.y, c.y});
        for (std::size_t row = index(low - low_.y); row <= index(high - low_.y); ++row) {
            for (std::size_t column = index(left - low_.x); column <= index(right - low_.x); ++column) {
                for (const std::size_t i : cells_[column + side_ * row]) {
                    const std::optional<double> z = elevation(a, b, c, samples_[i]);
                    errors[i] = z ? std::optional(samples_[i].z - *z) : errors[i];
                }
            }
        }
    }

    /// Of the plane a b c at p, if p lies in the face.
    static std::optional<double> elevation(const Point3& a, const Point3& b, const Point3& c,
                                           const Point3& p) {
        const auto area = [](const Point3& s, const Point3& t, const Point3& u) {
            return (t.x - s.x) * (u.y - s.y) - (t.y - s.y) * (u.x - s.x);
        };
        const double in_a = area(p, b, c);
        const double in_b = area(p, c, a);
        const double in_c = area(p, a, b);
        const double all = in_a + in_b + in_c;
        if (std::min({in_a, in_b, in_c}) < 0 || all <= 0) {
            return std::nullopt;
        }
        return (in_a * a.z + in_b * b.z + in_c * c.z) / all;
    }

    const std::vector<Point3>& samples_;
    tinwright::Point2 low_;
    std::size_t side_ = 0;
    double cell_ = 0;
    std::vector<std::vector<std::size_t>> cells_;
};

/// Whether the worst measure, or for scope vector all of them, are proven to be as good as they can be.
const char* proof_text(tinwright::Proof proof) {
    switch (proof) {
        case tinwright::Proof::Theorem:
            return "theorem";
        case tinwright::Proof::Tested:
            return "tested";
        case tinwright::Proof::None:
            break;
    }
    return "";
}

void print_row(const std::string& name, const Tin& tin, const HeldOut& held_out, double delaunay_rmse,
               tinwright::Proof proof = tinwright::Proof::None) {
    std::vector<double> slopes;
    for_each_face(tin, [&](FaceId face) { slopes.push_back(measure_face(tin, face, Criterion::Slope)); });
    std::sort(slopes.begin(), slopes.end());
    std::printf("| %s | %.4g |", name.c_str(), slopes.back());
    for (const double part : {0.999, 0.99, 0.9, 0.5}) {
        std::printf(" %.3g |", slopes[static_cast<std::size_t>(part * static_cast<double>(slopes.size()))]);
    }
    const double rmse = held_out.rmse(tin);
    std::printf(" %.3g | %.5g | %.4g | %.4g | %.4g | %+.1f %% | %s |\n",
                find_worst(tin, Criterion::Height).all, find_worst(tin, Criterion::Angle).all,
                find_worst(tin, Criterion::Eccentricity).all, find_worst(tin, Criterion::Length).all, rmse,
                100 * (rmse / (delaunay_rmse > 0 ? delaunay_rmse : rmse) - 1), proof_text(proof));
}

/// Of length only the longest edge counts.
std::vector<std::pair<std::string, Scope>> scopes_of(Criterion criterion) {
    if (criterion == Criterion::Length) {
        return {{"max", {Scope::Kind::Max, 0}}};
    }
    return {{"top:0.5%", {Scope::Kind::Top, 0.5}}, {"vector", {Scope::Kind::Vector, 0}}};
}

void compare(const std::vector<Point3>& samples) {
    std::vector<Point3> known;
    std::vector<Point3> unknown;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        (i % kHeldOutEvery == kHeldOutEvery - 1 ? unknown : known).push_back(samples[i]);
    }
    // All TINs share the domain: the Delaunay TIN without the needles along its hull.
    tinwright::TriangulateOptions how;
    how.domain.kind = tinwright::DomainRule::Kind::Trimmed;
    how.duplicates.policy = tinwright::DuplicatePolicy::Mean;
    const tinwright::Triangulated delaunay = tinwright::triangulate(known, how);
    const HeldOut held_out(unknown, delaunay.tin.bounds());
    const double delaunay_rmse = held_out.rmse(delaunay.tin);

    std::printf("%zu samples, %zu of them held out\n\n", samples.size(), unknown.size());
    std::printf(
        "| TIN | worst slope | 99.9 %% | 99 %% | 90 %% | 50 %% | least height | largest angle | "
        "greatest eccentricity | longest edge | RMSE | to Delaunay | proven "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    print_row("Delaunay", delaunay.tin, held_out, delaunay_rmse);
    for (const Criterion criterion : tinwright::kCriteria) {
        const std::string name(criterion_traits(criterion).name);
        Tin flipped = delaunay.tin;
        tinwright::flip_edges(flipped, criterion);
        print_row(name + ", flips only", flipped, held_out, delaunay_rmse);
        for (const auto& [scope_name, scope] : scopes_of(criterion)) {
            Tin optimal = delaunay.tin;
            tinwright::OptimizeOptions options;
            options.criterion = criterion;
            options.scope = scope;
            const tinwright::OptimizeReport report = tinwright::optimize(optimal, options);
            print_row(name + ", " + scope_name, optimal, held_out, delaunay_rmse, report.proof);
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments.empty() || arguments.size() > 2) {
        std::cerr << "usage: compare_criteria SOURCE [CRS]\n";
        return 2;
    }
    try {
        tinwright::io::ReadOptions read;
        if (arguments.size() == 2) {
            read.crs = tinwright::io::Crs::parse(arguments[1]);
        }
        const std::array sources{tinwright::io::parse_source(arguments[0])};
        compare(tinwright::io::read_samples(sources, read).points);
    } catch (const std::exception& error) {
        std::cerr << "compare_criteria: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
