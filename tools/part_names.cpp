#include "part_names.hpp"

#include <cmath>
#include <utility>

namespace tinwright::tools {

PartNames::PartNames(const io::Lines& lines, const io::Samples& samples) : lines_(lines), samples_(samples) {
    std::set<std::pair<std::string, std::string>> layers;
    for (const io::LineSlice& slice : lines.slices) {
        layers.emplace(slice.file, slice.layer);
    }
    for (const io::SampleSlice& slice : samples.slices) {
        if (slice.kind == io::SampleSlice::Kind::Vector) {
            layers.emplace(slice.file, slice.layer);
        }
    }
    std::set<std::string> files;
    for (const auto& [file, layer] : layers) {
        (files.contains(file) ? several_ : files).insert(file);
    }
}

std::string PartNames::of_line(std::uint32_t line) const {
    const io::LineSlice& slice = lines_.slice_of(line);
    const io::LinePart& part = lines_.parts[line];
    return of_feature(slice.file, slice.layer, part.feature) +
           (part.part > 0 ? ", part " + std::to_string(part.part) : std::string());
}

std::string PartNames::of_feature(const std::string& file, const std::string& layer,
                                  std::int64_t feature) const {
    return file + (several_.contains(file) ? ", layer " + layer : std::string()) + ": feature " +
           std::to_string(feature);
}

std::string PartNames::of_sample(std::uint32_t sample) const {
    const io::SampleSlice* const slice = samples_.find_slice(sample);
    if (slice == nullptr) {
        return "sample " + std::to_string(sample);
    }
    if (slice->kind == io::SampleSlice::Kind::Vector) {
        return of_feature(slice->file, slice->layer, slice->id(sample - slice->first));
    }
    const std::string noun = slice->kind == io::SampleSlice::Kind::Raster ? ": cell " : ": line ";
    return slice->file + noun + std::to_string(slice->id(sample - slice->first));
}

double rounded(double value) {
    constexpr double kSteps = 1e6;
    return std::abs(value) < 1e9 ? std::round(value * kSteps) / kSteps : value;
}

}  // namespace tinwright::tools
