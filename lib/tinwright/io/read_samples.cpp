#include "tinwright/io/read_samples.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <gdal_priv.h>

#include "tinwright/geometry/threads.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/placement.hpp"
#include "tinwright/io/raw_slice.hpp"
#include "tinwright/io/read_raster.hpp"
#include "tinwright/io/read_text.hpp"
#include "tinwright/io/read_vector.hpp"

namespace tinwright::io {
namespace {

std::string label(const Source& source) { return "file " + quoted(source.path); }

/// What a source of this kind consists of.
std::string noun(SampleSlice::Kind kind) {
    switch (kind) {
        case SampleSlice::Kind::Vector:
            return "feature";
        case SampleSlice::Kind::Raster:
            return "cell";
        default:
            return "row";
    }
}

std::string describe_id(const SampleSlice& slice, std::int64_t id) {
    const std::string file = "file " + quoted(slice.file);
    switch (slice.kind) {
        case SampleSlice::Kind::Vector:
            return file + ", layer " + quoted(slice.layer) + ", feature " + std::to_string(id);
        case SampleSlice::Kind::Raster:
            return file + ", " + slice.layer + ", cell " + std::to_string(id);
        case SampleSlice::Kind::Text:
            break;
    }
    return file + ", line " + std::to_string(id);
}

/// One read_samples().
class SampleReader {
  public:
    SampleReader(std::span<const Source> sources, const ReadOptions& options)
        : sources_(sources),
          options_(options),
          placement_(
              sources,
              {options.crs, options.source_crs, options.plane, options.heights, options.epoch, false, {}}) {}

    Samples read() {
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            read_source(s);
        }
        // Where all of them are decides what plane they are brought to, so that is done with all at hand.
        run_with_threads(options_.threads, [&] {
            for (std::size_t s = 0; s < sources_.size(); ++s) {
                note(s);
            }
            placement_.choose_plane();
            for (std::size_t s = 0; s < sources_.size(); ++s) {
                place(s);
            }
        });
        drop_failed();
        finish();
        out_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(out_);
    }

  private:
    /// What was read of a source: points [first, first + count), of which some cannot be placed.
    struct Read {
        RawSlice raw;
        std::size_t first = 0;
        std::size_t count = 0;
        std::vector<std::size_t> failed;
    };

    void read_source(std::size_t s) {
        const Source& source = sources_[s];
        if (source.as == Source::Kind::Tin) {
            throw UsageError("source " + quoted(source.path) + ": as=tin does not go with other samples");
        }
        if (source.across) {
            throw UsageError("source " + quoted(source.path) + ": across= is for lines, not for samples");
        }
        if (source.z && *source.z == "drape") {
            throw UsageError("source " + quoted(source.path) +
                             ": samples need elevations of their own; give z=geometry, a field or a number");
        }
        const OpenedSource opened = open_source(source);
        if (!opened.warning.empty()) {
            out_.warnings.push_back(opened.warning);
        }
        const SliceRequest request{source, opened.path, label(source), options_, progress_of(s)};
        const std::size_t first = out_.points.size();
        RawSlice raw = opened.kind == OpenedSource::Kind::Text ? read_text(request, out_.points)
                       : opened.kind == OpenedSource::Kind::Vector
                           ? read_vector(*opened.dataset, request, out_.points)
                           : read_raster(*opened.dataset, request, out_.points);
        refuse_nothing(source, raw, out_.points.size() - first);
        reads_.push_back({std::move(raw), first, out_.points.size() - first, {}});
    }

    /// Reading and transforming share a source's part of the whole.
    [[nodiscard]] Progress progress_of(std::size_t s) const {
        if (!options_.progress) {
            return {};
        }
        return [this, s](double fraction) {
            const double done = (static_cast<double>(s) + fraction) / static_cast<double>(sources_.size());
            return options_.progress(std::min(1.0, done));
        };
    }

    static void refuse_nothing(const Source& source, const RawSlice& raw, std::size_t count) {
        if (count > 0) {
            return;
        }
        const std::string where =
            label(source) + (raw.kind == SampleSlice::Kind::Vector   ? ", layer " + quoted(raw.layer)
                             : raw.kind == SampleSlice::Kind::Raster ? ", " + raw.layer
                                                                     : std::string());
        if (raw.bad.count() > 0) {
            throw InputError(where + ": nothing usable; " + std::to_string(raw.bad.count()) +
                             " skipped, the first is " + raw.bad.first());
        }
        throw InputError(where +
                         (raw.kind == SampleSlice::Kind::Raster ? ": no valid cells" : ": no samples"));
    }

    [[nodiscard]] std::span<Point3> points_of(std::size_t s) {
        return std::span(out_.points).subspan(reads_[s].first, reads_[s].count);
    }

    void note(std::size_t s) {
        RawSlice& raw = reads_[s].raw;
        const std::vector<std::size_t> strays =
            placement_.note(s, {raw.crs, raw.is_lon_lat, raw.is_north_first, raw.z_unit}, points_of(s));
        if (!strays.empty() && !options_.skip_bad) {
            const Point3& first = points_of(s)[strays.front()];
            raw.bad.add(describe_id(slice_of(s), raw.ids.all()[strays.front()]) + ": " +
                        placement_.failure(s, first));
        }
    }

    /// Brings a slice's points into the plane; those that cannot be are bad.
    void place(std::size_t s) {
        Read& read = reads_[s];
        const std::span<Point3> points = points_of(s);
        const Progress read_progress = progress_of(sources_.size() - 1);
        const Progress go_on = [&](double) { return !read_progress || read_progress(1.0); };
        read.failed = placement_.place(s, points, go_on);
        if (read.failed.empty()) {
            return;
        }
        const std::vector<std::int64_t> ids = read.raw.ids.all();
        const SampleSlice slice = slice_of(s);
        for (const std::size_t i : read.failed) {
            read.raw.bad.add(describe_id(slice, ids[i]) + ": " + placement_.failure(s, points[i]));
        }
        read.raw.ids.erase(read.failed);
        refuse_nothing(sources_[s], read.raw, read.count - read.failed.size());
    }

    /// Leaves out the points that could not be placed.
    void drop_failed() {
        std::size_t kept = 0;
        for (Read& read : reads_) {
            const std::size_t first = kept;
            auto next = read.failed.begin();
            for (std::size_t i = 0; i < read.count; ++i) {
                if (next != read.failed.end() && *next == i) {
                    ++next;
                } else {
                    out_.points[kept++] = out_.points[read.first + i];
                }
            }
            read.first = first;
            read.count = kept - first;
        }
        out_.points.resize(kept);
    }

    [[nodiscard]] SampleSlice slice_of(std::size_t s) const {
        const RawSlice& raw = reads_[s].raw;
        SampleSlice slice;
        slice.kind = raw.kind;
        slice.source = s;
        slice.file = sources_[s].path;
        slice.layer = raw.layer;
        slice.first = reads_[s].first;
        slice.count = reads_[s].count;
        return slice;
    }

    void keep(std::size_t s) {
        const RawSlice& raw = reads_[s].raw;
        SampleSlice slice = slice_of(s);
        slice.skipped = raw.bad.count();
        slice.first_id = raw.ids.front();
        if (!raw.ids.is_one_run()) {
            slice.ids = raw.ids.all();
        }
        out_.slices.push_back(std::move(slice));
        add_warnings(raw.warnings);
        if (raw.bad.count() > 0) {
            out_.warnings.push_back(label(sources_[s]) + ": " + std::to_string(raw.bad.count()) +
                                    " unusable " + noun(raw.kind) + (raw.bad.count() == 1 ? "" : "s") +
                                    " skipped, the first is " + raw.bad.first());
        }
    }

    void finish() {
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            keep(s);
        }
        add_warnings(placement_.take_warnings());
        out_.plane = placement_.plane();
        out_.crs = out_.plane.crs;
        out_.z_unit = placement_.z_unit();
    }

    void add_warnings(const std::vector<std::string>& warnings) {
        out_.warnings.insert(out_.warnings.end(), warnings.begin(), warnings.end());
    }

    std::span<const Source> sources_;
    const ReadOptions& options_;
    Placement placement_;
    Samples out_;
    std::vector<Read> reads_;  // one a source
};

}  // namespace

const SampleSlice* Samples::find_slice(std::size_t sample) const {
    const auto after =
        std::upper_bound(slices.begin(), slices.end(), sample,
                         [](std::size_t s, const SampleSlice& slice) { return s < slice.first; });
    return after == slices.begin() || sample >= points.size() ? nullptr : &*std::prev(after);
}

std::string Samples::describe(std::size_t sample) const {
    const SampleSlice* const slice = find_slice(sample);
    return slice == nullptr ? "sample " + std::to_string(sample)
                            : describe_id(*slice, slice->id(sample - slice->first));
}

Samples read_samples(std::span<const Source> sources, const ReadOptions& options) {
    register_drivers();
    const GdalMessages messages;
    return SampleReader(sources, options).read();
}

}  // namespace tinwright::io
