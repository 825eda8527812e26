#include "tinwright/water/near_samples.hpp"

#include <algorithm>
#include <cmath>

#include "tinwright/breaklines/segment_distance.hpp"
#include "tinwright/geometry/error.hpp"

namespace tinwright {

namespace {

std::vector<Key2> keys_of(std::span<const Point3> samples, const Lattice& lattice) {
    std::vector<Key2> keys;
    keys.reserve(samples.size());
    for (const Point3& sample : samples) {
        keys.push_back(lattice.key({sample.x, sample.y}));
    }
    return keys;
}

BoxTree tree_of(const std::vector<Key2>& keys) {
    std::vector<KeyBox> boxes;
    boxes.reserve(keys.size());
    for (const Key2 key : keys) {
        boxes.push_back({key, key});
    }
    return BoxTree(boxes);
}

}  // namespace

NearSamples::NearSamples(std::span<const Point3> samples, const Lattice& lattice)
    : samples_(samples), lattice_(lattice), keys_(keys_of(samples, lattice)), tree_(tree_of(keys_)) {}

Drape& NearSamples::drape() {
    if (!drape_) {
        // The elevation of water is that of the lowest sample anyway.
        vertices_ = make_sample_vertices(samples_, {lattice_, {}}, {DuplicatePolicy::Min, 0});
        if (vertices_.keys.size() < 3) {
            throw InputError(
                "water without z cannot be measured: there are not three samples to take its elevation from; "
                "give it with z=FIELD or z=NUMBER, or add samples");
        }
        drape_.emplace(vertices_.keys, vertices_.z);
    }
    return *drape_;
}

double NearSamples::terrain(Key2 key) { return drape().at(key).z; }

bool NearSamples::is_at_border(Key2 key, double reach) {
    if (drape().at(key).is_outside) {
        return true;
    }
    const std::vector<VertexId>& hull = drape().hull();
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const Key2 a = vertices_.keys[hull[i].value];
        const Key2 b = vertices_.keys[hull[(i + 1) % hull.size()].value];
        if (measure_distance(key, a, b).squared <= reach * reach) {
            return true;
        }
    }
    return false;
}

double NearSamples::lowest(Key2 a, Key2 b, double reach) {
    double z = std::min(terrain(a), terrain(b));
    KeyBox box = KeyBox::of(std::vector<Key2>{a, b});
    box = {{box.low.x - reach, box.low.y - reach}, {box.high.x + reach, box.high.y + reach}};
    visit_in(box, [&](std::uint32_t sample) {
        const Key2 at = keys_[sample];
        const double squared = a == b ? (at.x - a.x) * (at.x - a.x) + (at.y - a.y) * (at.y - a.y)
                                      : measure_distance(at, a, b).squared;
        if (squared <= reach * reach) {
            z = std::min(z, samples_[sample].z);
        }
    });
    return z;
}

}  // namespace tinwright
