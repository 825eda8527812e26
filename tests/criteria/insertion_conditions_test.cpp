#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <vector>

#include <doctest/doctest.h>

#include "tinwright/criteria/visit_criterion.hpp"

#include "support/cases.hpp"
#include "support/point_sets.hpp"
#include "support/tins.hpp"
#include "support/triangulation_oracle.hpp"

using namespace tinwright;
using namespace tinwright_tests;

/// The conditions that edge insertion rests on [tan1993, Sec. 3.2], as docs/criteria.md states them: on what
/// is left of the domain when worse faces are obstacles. The hardest case is that every face that both
/// triangulations share is one.

namespace {

using oracle::Sites;
using oracle::Triple;
using Triangulation = std::vector<Triple>;  // corners and faces in ascending order

Triple sorted(Triple face) {
    std::sort(face.begin(), face.end());
    return face;
}

std::vector<Triangulation> triangulations(const Sites& sites) {
    std::vector<Triangulation> all;
    oracle::for_each_triangulation(sites, [&all](const std::vector<Triple>& faces) {
        Triangulation one;
        std::transform(faces.begin(), faces.end(), std::back_inserter(one), sorted);
        std::sort(one.begin(), one.end());
        all.push_back(std::move(one));
    });
    return all;
}

Triangulation difference(const Triangulation& a, const Triangulation& b) {
    Triangulation only;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only));
    return only;
}

/// Whether an edge of `faces` leaves the corner and crosses the opposite edge of `face`.
bool breaks(const Sites& sites, const Triangulation& faces, const Triple& face, unsigned corner) {
    const auto key = [&sites](std::uint32_t v) { return sites.keys[v]; };
    const std::uint32_t y = face[corner];
    for (const Triple& other : faces) {
        if (std::find(other.begin(), other.end(), y) == other.end()) {
            continue;
        }
        for (const std::uint32_t t : other) {
            if (t != y &&
                oracle::do_cross(key(y), key(t), key(face[(corner + 1) % 3]), key(face[(corner + 2) % 3]))) {
                return true;
            }
        }
    }
    return false;
}

long double badness(const Sites& sites, Criterion criterion, const Triple& face) {
    const auto site = [&sites](std::uint32_t v) { return oracle::Site{sites.keys[v], sites.z[v]}; };
    return oracle::badness(criterion, site(face[0]), site(face[1]), site(face[2]));
}

long double worst(const Sites& sites, Criterion criterion, const Triangulation& faces) {
    long double most = badness(sites, criterion, faces[0]);
    for (const Triple& face : faces) {
        most = std::max(most, badness(sites, criterion, face));
    }
    return most;
}

unsigned anchors_of(const Tin& tin, Criterion criterion, const Sites& sites, const Triple& face) {
    const bool is_left = oracle::turn(sites.keys[face[0]], sites.keys[face[1]], sites.keys[face[2]]) > 0;
    const unsigned anchors = visit_criterion(criterion, tin, [&](const FaceCriterion auto& code) {
        return is_left ? code.anchors({face[0]}, {face[1]}, {face[2]})
                       : code.anchors({face[0]}, {face[2]}, {face[1]});
    });
    return is_left ? anchors : (anchors & 1U) | (anchors & 2U) << 1U | (anchors & 4U) >> 1U;
}

/// Calls `visit` for faces of one triangulation that another has not: with the site set, a TIN for the
/// criteria's code, both differences and the face.
template <class Visitor>
void for_each_difference(std::uint64_t seed, Visitor visit) {
    Random random(seed);
    Sites sites;
    const double height = seed % 3 == 0 ? 1e5 : 1e6;
    for (int i = 0; i < 7; ++i) {
        sites.keys.push_back({random.key(1e6), random.key(height)});
        sites.z.push_back(random.key(1e6));
    }
    Tin tin = tin_of(sites.keys);
    tin.z.assign(sites.z.begin(), sites.z.end());
    const std::vector<Triangulation> all = triangulations(sites);
    const auto last = static_cast<std::int64_t>(all.size()) - 1;
    for (int pair = 0; pair < 20; ++pair) {
        const Triangulation& a = all[static_cast<std::size_t>(random.integer(0, last))];
        const Triangulation& t = all[static_cast<std::size_t>(random.integer(0, last))];
        const Triangulation of_a = difference(a, t);
        const Triangulation of_t = difference(t, a);
        for (const Triple& face : of_a) {
            visit(sites, tin, t, of_a, of_t, face);
        }
    }
}

}  // namespace

TEST_SUITE("criteria/insertion_conditions") {
    TEST_CASE("what does not break a face at its anchor leaves a worse one, shared faces not counted") {
        std::array<int, kInsertionCriteria.size()> checked{};
        std::array<int, kInsertionCriteria.size()> weak_only{};
        for (int seed = 0; seed < cases(400); ++seed) {
            CAPTURE(seed);
            const auto check = [&checked, &weak_only](const Sites& sites, const Tin& tin,
                                                      const Triangulation& t, const Triangulation& of_a,
                                                      const Triangulation& of_t, const Triple& face) {
                for (std::size_t i = 0; i < kInsertionCriteria.size(); ++i) {
                    const Criterion criterion = kInsertionCriteria[i];
                    const unsigned anchors = anchors_of(tin, criterion, sites, face);
                    const long double of_face = badness(sites, criterion, face);
                    for (unsigned corner = 0; corner < 3; ++corner) {
                        if ((anchors >> corner & 1U) == 0 || breaks(sites, t, face, corner)) {
                            continue;
                        }
                        ++checked[i];
                        const bool is_strong =
                            criterion_traits(criterion).condition == InsertionCondition::Strong;
                        const bool is_worse_in_t = worst(sites, criterion, of_t) > of_face;
                        weak_only[i] += is_worse_in_t ? 0 : 1;
                        REQUIRE((is_worse_in_t || (!is_strong && worst(sites, criterion, of_a) > of_face)));
                    }
                }
            };
            for_each_difference(static_cast<std::uint64_t>(seed), check);
        }
        for (std::size_t i = 0; i < kInsertionCriteria.size(); ++i) {
            CHECK(checked[i] > cases(400));
            const bool is_weak =
                criterion_traits(kInsertionCriteria[i]).condition == InsertionCondition::Weak;
            CHECK((weak_only[i] > 0) == is_weak);  // as Figures 4.4 and 4.5 of the thesis show
        }
    }

    TEST_CASE("no triangulation is better than the worst face that differs, if that has no anchor") {
        int checked = 0;
        for (int seed = 0; seed < cases(400); ++seed) {
            CAPTURE(seed);
            const auto check = [&checked](const Sites& sites, const Tin& tin, const Triangulation& /*t*/,
                                          const Triangulation& of_a, const Triangulation& of_t,
                                          const Triple& face) {
                for (const Criterion criterion : kInsertionCriteria) {
                    const long double of_face = badness(sites, criterion, face);
                    if (anchors_of(tin, criterion, sites, face) == 0 &&
                        worst(sites, criterion, of_a) <= of_face) {
                        ++checked;
                        REQUIRE(worst(sites, criterion, of_t) >= of_face);
                    }
                }
            };
            for_each_difference(static_cast<std::uint64_t>(seed), check);
        }
        CHECK(checked > cases(400) / 20);
    }
}
