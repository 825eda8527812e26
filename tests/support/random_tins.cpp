#include "support/random_tins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>

#include "tinwright/criteria/visit_criterion.hpp"
#include "tinwright/mesh/mesh_check.hpp"
#include "tinwright/mesh/mesh_edit.hpp"
#include "tinwright/mesh/tin_check.hpp"

#include "support/tins.hpp"

namespace tinwright_tests {

using namespace tinwright;

namespace {

using Keys = std::vector<Key2>;
using Elevation = double (*)(Random& random, Key2 key, double size);

template <class MakeKey>
Keys repeat(std::size_t count, const MakeKey& make_key) {
    Keys keys(count);
    std::generate(keys.begin(), keys.end(), make_key);
    return keys;
}

double at_random(Random& random, Key2, double size) { return size * random.real(); }

double hill(Random& random, Key2 key, double size) {
    const double x = key.x / size - 0.4;
    const double y = key.y / size - 0.7;
    return size * (0.3 * x + x * x - 2 * x * y + 0.01 * random.real());
}

double cliff(Random& random, Key2 key, double size) {
    return (key.x + key.y > size ? size : 0.0) + 0.05 * size * random.real();
}

double level(Random&, Key2, double) { return 7; }

double flat_with_cliff(Random&, Key2 key, double size) { return key.x > 0.6 * size ? 100 : 0; }

/// As of points on contour lines.
double terraces(Random& random, Key2, double) { return static_cast<double>(10 * random.integer(0, 2)); }

Tin make_tin(Random& random, const Keys& keys, Elevation elevation) {
    double size = 1;
    for (const Key2 key : keys) {
        size = std::max({size, key.x, key.y});
    }
    std::vector<oracle::Site> sites;
    for (const Key2 key : keys) {
        sites.push_back({key, elevation(random, key, size)});
    }
    return tin_of_sites(sites);
}

Tin with_any_relief(Random& random, const Keys& keys) {
    constexpr std::array<Elevation, 3> kReliefs{at_random, hill, cliff};
    return make_tin(random, keys, kReliefs[static_cast<std::size_t>(random.integer(0, 2))]);
}

Tin with_tied_relief(Random& random, const Keys& keys) {
    constexpr std::array<Elevation, 4> kReliefs{at_random, level, flat_with_cliff, terraces};
    return make_tin(random, keys, kReliefs[static_cast<std::size_t>(random.integer(0, 3))]);
}

Tin square(Random& random, std::size_t count) {
    return with_any_relief(random, repeat(count, [&] {
                               return Key2{random.key(0x1p26), random.key(0x1p26)};
                           }));
}

Tin strip(Random& random, std::size_t count) {
    return with_any_relief(random, repeat(count, [&] {
                               return Key2{random.key(0x1p30), random.key(0x1p24)};
                           }));
}

Tin ring(Random& random, std::size_t count) {
    return with_any_relief(random, repeat(count, [&] {
                               const double angle = 2 * std::numbers::pi * random.real();
                               const double radius = 0x1p28 * (1 - 0.1 * random.real() * random.real());
                               return Key2{std::round(0x1p28 + radius * std::cos(angle)),
                                           std::round(0x1p28 + radius * std::sin(angle))};
                           }));
}

Tin clusters(Random& random, std::size_t count) {
    return with_any_relief(random, repeat(count, [&] {
                               const double size = std::ldexp(1.0, static_cast<int>(random.integer(22, 29)));
                               return Key2{0x1p28 + std::floor(size * (random.real() - 0.5)),
                                           0x1p28 + std::floor(size * (random.real() - 0.5))};
                           }));
}

template <int kSize>
Tin lattice(Random& random, std::size_t count) {
    return with_tied_relief(random, repeat(count, [&] {
                                return Key2{random.key(kSize), random.key(kSize)};
                            }));
}

Tin grid(Random& random, std::size_t count) {
    const int columns = static_cast<int>(random.integer(2, 4));
    return with_tied_relief(random, grid_keys(columns, std::max(2, static_cast<int>(count) / columns)));
}

Tin rows(Random& random, std::size_t count) {
    return with_tied_relief(random, repeat(count, [&] {
                                return Key2{random.key(1000), 100 * random.key(3)};
                            }));
}

Tin contours(Random& random, std::size_t count) {
    Keys keys = repeat(count, [&] { return Key2{random.key(0x1p20), random.key(0x1p20)}; });
    return make_tin(random, keys, random.integer(0, 1) == 0 ? terraces : flat_with_cliff);
}

Tin circle(Random& random, std::size_t count) {
    Keys keys = circle_keys(random, count);
    if (random.integer(0, 1) == 0) {
        keys.back() = {40000, 40000};
    }
    return with_tied_relief(random, keys);
}

/// A regular polygon as far as keys allow, and perhaps its centre.
Tin regular_polygon(Random& random, std::size_t count) {
    Keys keys;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        keys.push_back({1000000 + std::round(1000000 * std::cos(angle)),
                        1000000 + std::round(1000000 * std::sin(angle))});
    }
    if (random.integer(0, 1) == 0) {
        keys.back() = {1000000, 1000000};
    }
    return with_tied_relief(random, keys);
}

Tin near_line(Random& random, std::size_t count) {
    return with_tied_relief(random, repeat(count, [&] {
                                const double t = random.key(0x1p20);
                                return Key2{3 * t + random.key(2), 5 * t + random.key(2)};
                            }));
}

/// Any of the families of key sets, up to 2^45 wide.
Tin any_keys(Random& random, std::size_t count) {
    const auto families = key_families();
    const auto pick =
        static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(families.size()) - 1));
    Keys keys = without_repetitions(families[pick].make(random, count));
    keys.resize(std::min(keys.size(), count));
    return with_tied_relief(random, keys);
}

constexpr std::array kGeneralFamilies{TinFamily{"square", square}, TinFamily{"strip", strip},
                                      TinFamily{"ring", ring}, TinFamily{"clusters", clusters}};

constexpr std::array kDegenerateFamilies{
    TinFamily{"lattice of 4", lattice<4>},     TinFamily{"lattice of 8", lattice<8>},
    TinFamily{"lattice of 100", lattice<100>}, TinFamily{"grid", grid},
    TinFamily{"collinear rows", rows},         TinFamily{"contours", contours},
    TinFamily{"on a circle", circle},          TinFamily{"regular polygon", regular_polygon},
    TinFamily{"near a line", near_line},       TinFamily{"any keys", any_keys},
};

/// All faces but ghosts.
std::vector<FaceId> faces_of(const TriangleMesh& mesh) {
    std::vector<FaceId> faces;
    for (std::uint32_t f = 0; f < mesh.slot_count(); ++f) {
        if (!mesh.is_ghost({f})) {
            faces.push_back({f});
        }
    }
    return faces;
}

HalfEdgeId random_half_edge(Random& random, const std::vector<FaceId>& faces) {
    const auto face = random.integer(0, static_cast<std::int64_t>(faces.size()) - 1);
    return half_edge(faces[static_cast<std::size_t>(face)], static_cast<unsigned>(random.integer(0, 2)));
}

}  // namespace

std::span<const TinFamily> general_families() { return kGeneralFamilies; }
std::span<const TinFamily> degenerate_families() { return kDegenerateFamilies; }

Tin tin_of_sites(const std::vector<oracle::Site>& sites) {
    Keys keys;
    for (const oracle::Site& site : sites) {
        keys.push_back(site.key);
    }
    Tin tin = delaunay_tin(keys);
    for (std::size_t v = 0; v < tin.keys.size(); ++v) {
        tin.z[v] = std::find_if(sites.begin(), sites.end(), [&](const oracle::Site& site) {
                       return site.key == tin.keys[v];
                   })->z;
    }
    return tin;
}

Tin tin_of_faces(const std::vector<oracle::Site>& sites, const std::vector<std::uint32_t>& corners) {
    Tin tin = tin_of_sites(sites);
    std::vector<VertexId> vertices;
    for (const std::uint32_t corner : corners) {
        const auto place = std::find(tin.keys.begin(), tin.keys.end(), sites[corner].key);
        vertices.push_back({static_cast<std::uint32_t>(place - tin.keys.begin())});
    }
    tin.mesh = make_mesh(tin.keys.size(), vertices);
    return tin;
}

void flip_at_random(Random& random, Tin& tin, int count) {
    TriangleMesh& mesh = tin.mesh;
    const std::vector<FaceId> faces = faces_of(mesh);
    for (int i = 0; i < count; ++i) {
        const HalfEdgeId h = random_half_edge(random, faces);
        const HalfEdgeId t = mesh.twin(h);
        if (mesh.is_constrained(h) || !mesh.is_terrain(face_of(h)) || !mesh.is_terrain(face_of(t))) {
            continue;
        }
        if (oracle::do_cross(tin.key(mesh.origin(h)), tin.key(mesh.origin(t)),
                             tin.key(mesh.origin(previous(h))), tin.key(mesh.origin(previous(t))))) {
            flip_edge(mesh, h);
        }
    }
}

void constrain_at_random(Random& random, Tin& tin, int count) {
    const std::vector<FaceId> faces = faces_of(tin.mesh);
    for (int i = 0; i < count; ++i) {
        tin.mesh.set_constrained(random_half_edge(random, faces), true);
    }
}

void make_voids_at_random(Random& random, Tin& tin, int count) {
    const std::vector<FaceId> faces = faces_of(tin.mesh);
    for (int i = 0; i < count && tin.mesh.count_terrain() > 1; ++i) {
        tin.mesh.set_terrain(face_of(random_half_edge(random, faces)), false);
    }
}

oracle::Site site_of(const Tin& tin, VertexId v) { return {tin.key(v), tin.z[v.value]}; }

oracle::Sites sites_of(const Tin& tin) {
    oracle::Sites sites;
    sites.keys.assign(tin.keys.begin(), tin.keys.end());
    sites.z.assign(tin.z.begin(), tin.z.end());
    const TriangleMesh& mesh = tin.mesh;
    for (const FaceId f : faces_of(mesh)) {
        for (unsigned i = 0; i < 3; ++i) {
            const HalfEdgeId h = half_edge(f, i);
            if (mesh.is_constrained(h) || !mesh.is_terrain(f)) {
                sites.constraints.push_back({mesh.origin(h).value, mesh.destination(h).value});
            }
        }
    }
    return sites;
}

std::vector<long double> badnesses_of(const Tin& tin, Criterion criterion, Faces which, Norm norm) {
    std::vector<long double> vector;
    for (const FaceId f : faces_of(tin.mesh)) {
        if (which == Faces::All || tin.mesh.is_terrain(f)) {
            const auto& [a, b, c] = tin.mesh.face(f).vertex;
            vector.push_back(
                oracle::badness(criterion, site_of(tin, a), site_of(tin, b), site_of(tin, c), norm));
        }
    }
    std::sort(vector.begin(), vector.end(), std::greater<>());
    return vector;
}

double report_of(const Tin& tin, Criterion criterion, long double badness) {
    const auto number = static_cast<double>(criterion == Criterion::Height ? -badness : badness);
    switch (criterion) {
        case Criterion::Height:
        case Criterion::Eccentricity:
        case Criterion::Length:
            return number * tin.lattice.quantum();
        case Criterion::Slope:
            return number / tin.lattice.quantum();
        case Criterion::Angle:
            break;
    }
    return number;
}

bool are_close(long double a, long double b) {
    return std::fabs(a - b) <= 1e-9L * std::max(std::fabs(a), std::fabs(b));
}

bool are_close(const std::vector<long double>& a, const std::vector<long double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](long double x, long double y) { return are_close(x, y); });
}

std::vector<double> measures_of(const Tin& tin, Criterion criterion, Norm norm) {
    return visit_criterion(
        criterion, tin,
        [&tin](const FaceCriterion auto& code) {
            std::vector<double> vector;
            for (const FaceId f : faces_of(tin.mesh)) {
                if (tin.mesh.is_terrain(f)) {
                    const auto& [a, b, c] = tin.mesh.face(f).vertex;
                    vector.push_back(code.measure(a, b, c));
                }
            }
            std::sort(vector.begin(), vector.end(), std::greater<>());
            return vector;
        },
        norm);
}

bool is_sound(const Tin& tin) { return check_mesh(tin.mesh).is_clean() && check_tin(tin).is_clean(); }

std::string describe(const Tin& tin) {
    std::ostringstream text;
    text.precision(17);
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        text << (v == 0 ? "vertices" : ",") << ' ' << tin.keys[v].x << ' ' << tin.keys[v].y << ' '
             << tin.z[v];
    }
    text << "; faces";
    const TriangleMesh& mesh = tin.mesh;
    for (const FaceId f : faces_of(mesh)) {
        text << (mesh.is_terrain(f) ? " (" : " void(");
        for (unsigned i = 0; i < 3; ++i) {
            text << mesh.vertex(f, i).value
                 << (mesh.is_constrained(half_edge(f, i)) ? "="
                     : i < 2                              ? " "
                                                          : "");
        }
        text << ')';
    }
    return text.str();
}

}  // namespace tinwright_tests
