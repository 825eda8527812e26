#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/criteria/visit_criterion.hpp"

#include "support/cases.hpp"
#include "support/insertion_oracle.hpp"
#include "support/optimizing.hpp"
#include "support/random_tins.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// The rules by which the search under condition (I) is cut short never cut off an improvement.

namespace {

/// On the outline of a rounded star, so that many edges are crossed on the way from vertex to vertex.
Tin star_tin(Random& random, std::size_t count) {
    std::vector<oracle::Site> sites;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * random.real();
        const double radius = 0x1p26 * (1 + 0.2 * std::sin(3 * angle) + 0.05 * random.real());
        const double x = std::round(0x1p28 + radius * std::cos(angle));
        const double y = std::round(0x1p28 + radius * std::sin(angle));
        sites.push_back({{x, y}, 0.3 * x + 0x1p24 * random.real()});
    }
    return tin_of_sites(sites);
}

/// Whether the insertion at `corner` of `face` of the edge along a corridor improves the face.
template <FaceCriterion C>
bool is_improvement(const Tin& tin, const C& criterion, const oracle::Corridor& corridor, double measure) {
    for (const FaceId f : corridor.faces) {
        const auto& v = tin.mesh.face(f).vertex;
        if (criterion.measure(v[0], v[1], v[2]) > measure) {
            return false;
        }
    }
    const auto is_better = [&](VertexId a, VertexId b, VertexId c) {
        return criterion.measure(a, b, c) < measure;
    };
    return oracle::can_fill(tin, corridor.left, is_better) &&
           oracle::can_fill(tin, corridor.right, is_better);
}

/// Requires that the cut lets the search through to every improvement of every face. Returns how many edges
/// were crossed on the way, `pr` not counted.
template <WeakCriterion C>
std::size_t check_cut(const Tin& tin, const C& criterion) {
    std::size_t crossed = 0;
    const oracle::Crossings crossings(tin);
    for (std::uint32_t f = 0; f < tin.mesh.slot_count(); ++f) {
        if (!tin.mesh.is_terrain({f})) {
            continue;
        }
        const auto& v = tin.mesh.face({f}).vertex;
        const double measure = criterion.measure(v[0], v[1], v[2]);
        const unsigned anchors = criterion.anchors(v[0], v[1], v[2]);
        for (unsigned corner = 0; corner < 3; ++corner) {
            const VertexId q = v[corner];
            const VertexId r = v[next_corner(corner)];
            const VertexId p = v[previous_corner(corner)];
            for (std::uint32_t s = 0; (anchors >> corner & 1U) != 0 && s < tin.vertex_count(); ++s) {
                const auto corridor = crossings.find(q, {s});
                // The search looks for those only that hold the faces q p s and q s r.
                if (!corridor || corridor->faces[0] != FaceId{f} || criterion.measure(q, p, {s}) >= measure ||
                    criterion.measure(q, {s}, r) >= measure ||
                    !is_improvement(tin, criterion, *corridor, measure)) {
                    continue;
                }
                const typename C::Cut cut(criterion, q, p, r, measure);
                auto state = cut.start();
                for (std::size_t i = 1; i < corridor->crossed.size(); ++i) {
                    REQUIRE(cut.cross(state, corridor->crossed[i][0], corridor->crossed[i][1]));
                    ++crossed;
                }
            }
        }
    }
    return crossed;
}

}  // namespace

TEST_SUITE("optimal/search_cut") {
    TEST_CASE("no improvement of a slope or an eccentricity is cut off") {
        std::size_t of_slope = 0;
        std::size_t of_eccentricity = 0;
        for (int seed = 0; seed < cases(300); ++seed) {
            CAPTURE(seed);
            Random random(static_cast<std::uint64_t>(seed));
            Tin tin = seed % 2 == 0
                          ? star_tin(random, 30)
                          : general_families()[static_cast<std::size_t>(seed / 2) % 4].make(random, 30);
            flip_at_random(random, tin, 20 * (seed % 5));
            of_slope += check_cut(tin, SlopeCriterion(tin));
            of_eccentricity += check_cut(tin, EccentricityCriterion(tin));
        }
        CHECK(of_slope > static_cast<std::size_t>(cases(300)) * 5);
        CHECK(of_eccentricity > static_cast<std::size_t>(cases(300)));
    }
}
