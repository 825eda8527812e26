#include "vertex_origins.hpp"

#include <algorithm>
#include <cstddef>

#include "line_points.hpp"

namespace tinwright::tools {

namespace {

/// Gives sources numbers from 1 in the order in which they are asked for.
class SourceNumbers {
  public:
    explicit SourceNumbers(std::size_t sources) : number_(sources, 0) {}

    std::int32_t operator[](std::size_t source) {
        if (number_[source] == 0) {
            number_[source] = ++last_;
        }
        return number_[source];
    }

  private:
    std::vector<std::int32_t> number_;  // 0: none yet
    std::int32_t last_ = 0;
};

class OriginMaker {
  public:
    OriginMaker(const Tin& tin, std::span<const io::SampleSlice> slices, const io::Lines& lines,
                bool keep_ids)
        : tin_(tin),
          slices_(slices),
          lines_(lines),
          keep_ids_(keep_ids),
          samples_(slices.empty() ? 0 : slices.back().first + slices.back().count),
          sample_sources_(count_sources()),
          line_points_(lines.lines),
          numbers_(sample_sources_ + lines.slices.size()) {}

    TinOrigins make() {
        origins_.vertices.source.resize(tin_.vertex_count(), 0);
        const bool any_feature =
            !lines_.lines.empty() ||
            std::any_of(slices_.begin(), slices_.end(), [&](const auto& slice) { return keeps_ids(slice); });
        if (any_feature) {
            origins_.vertices.feature.resize(tin_.vertex_count(), -1);
        }
        for (std::size_t v = 0; v < tin_.vertex_count(); ++v) {
            const std::size_t sample = tin_.sample[v];
            if (sample < samples_) {
                set_sample(v, sample);
            } else if (const auto line = line_points_.find_line(sample - samples_)) {
                origins_.vertices.source[v] = number_of_line(*line);
                origins_.vertices.feature[v] = lines_.parts[*line].feature;
            }
        }
        for (const LineTrace& trace : tin_.traces) {
            if (trace.line < lines_.lines.size()) {
                static_cast<void>(number_of_line(trace.line));
            }
        }
        for (std::size_t i = 0; i < lines_.lines.size(); ++i) {
            const Breakline& line = lines_.lines[i];
            origins_.lines.push_back({line.role, line.is_sharp, number_of_line(i), lines_.parts[i].feature});
        }
        return std::move(origins_);
    }

  private:
    [[nodiscard]] std::size_t count_sources() const {
        std::size_t sources = 0;
        for (const io::SampleSlice& slice : slices_) {
            sources = std::max(sources, slice.source + 1);
        }
        return sources;
    }

    [[nodiscard]] bool keeps_ids(const io::SampleSlice& slice) const {
        return keep_ids_ || slice.kind == io::SampleSlice::Kind::Vector;
    }

    void set_sample(std::size_t v, std::size_t sample) {
        // The last slice that begins at or before the sample; empty slices begin where the next one does.
        const auto after =
            std::upper_bound(slices_.begin(), slices_.end(), sample,
                             [](std::size_t s, const io::SampleSlice& slice) { return s < slice.first; });
        const io::SampleSlice& slice = *std::prev(after);
        origins_.vertices.source[v] = numbers_[slice.source];
        if (keeps_ids(slice)) {
            origins_.vertices.feature[v] = slice.id(sample - slice.first);
        }
    }

    /// Each source of lines has one slice.
    std::int32_t number_of_line(std::size_t line) {
        return numbers_[sample_sources_ + lines_.slice_of(line).source];
    }

    const Tin& tin_;
    std::span<const io::SampleSlice> slices_;
    const io::Lines& lines_;
    bool keep_ids_;
    std::size_t samples_;
    std::size_t sample_sources_;
    LinePoints line_points_;
    SourceNumbers numbers_;
    TinOrigins origins_;
};

}  // namespace

TinOrigins make_tin_origins(const Tin& tin, std::span<const io::SampleSlice> slices, const io::Lines& lines,
                            bool keep_ids) {
    return OriginMaker(tin, slices, lines, keep_ids).make();
}

}  // namespace tinwright::tools
