#include "tinwright/io/read_samples.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <locale>
#include <sstream>
#include <string_view>
#include <utility>

#include <gdal_priv.h>

#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/raw_slice.hpp"
#include "tinwright/io/read_raster.hpp"
#include "tinwright/io/read_text.hpp"
#include "tinwright/io/read_vector.hpp"
#include "tinwright/io/transform_points.hpp"

namespace tinwright::io {
namespace {

std::string label(const Source& source) { return "file " + quoted(source.path); }

std::string number(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(15);
    text << value;
    return text.str();
}

/// Units as the files spell them, by one name each.
std::string z_unit_name(const std::string& unit) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kNames = {
        {{"m", "metre"},
         {"meter", "metre"},
         {"meters", "metre"},
         {"metres", "metre"},
         {"Metre", "metre"},
         {"Meter", "metre"},
         {"ft", "foot"},
         {"feet", "foot"},
         {"Feet", "foot"},
         {"US Survey Foot", "US survey foot"},
         {"us-ft", "US survey foot"},
         {"ftUS", "US survey foot"},
         {"US_survey_foot", "US survey foot"},
         {"survey_foot", "US survey foot"}}};
    for (const auto& [spelling, name] : kNames) {
        if (unit == spelling) {
            return std::string(name);
        }
    }
    return unit;
}

/// "EPSG:32612", the WGS 84 / UTM zone at the middle of points given in degrees; empty when they are not.
std::string utm_zone(std::span<const Point3> points) {
    const auto [west, east] = std::minmax_element(points.begin(), points.end(),
                                                  [](const Point3& a, const Point3& b) { return a.x < b.x; });
    const auto [south, north] = std::minmax_element(
        points.begin(), points.end(), [](const Point3& a, const Point3& b) { return a.y < b.y; });
    const double longitude = std::remainder((west->x + east->x) / 2, 360.0);
    const double latitude = (south->y + north->y) / 2;
    if (!(std::abs(latitude) <= 84) || !(std::abs(longitude) <= 180)) {
        return {};
    }
    const int zone = std::min(60, 1 + static_cast<int>(std::floor((longitude + 180) / 6)));
    return "EPSG:" + std::to_string((latitude < 0 ? 32700 : 32600) + zone);
}

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
        : sources_(sources), options_(options) {
        out_.crs = options.crs;
        if (options.crs.is_geographic()) {
            throw UsageError(
                "--crs " + options.crs.name() +
                " is geographic: degrees cannot be measured as a plane; give a projected system");
        }
        for (const Source& source : sources) {
            given_.push_back(source.crs ? Crs::parse(*source.crs) : Crs());
        }
    }

    Samples read() {
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            read_source(s);
        }
        finish();
        out_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(out_);
    }

  private:
    void read_source(std::size_t s) {
        const Source& source = sources_[s];
        if (source.as == Source::Kind::Tin) {
            throw UsageError("source " + quoted(source.path) + ": as=tin does not go with other samples");
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
        refuse_nothing(source, raw, first);
        place(s, raw, first);
        refuse_nothing(source, raw, first);  // of what was read, all may be outside the transformation's area
        keep(s, raw, first);
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

    void refuse_nothing(const Source& source, const RawSlice& raw, std::size_t first) const {
        if (out_.points.size() > first) {
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

    /// Brings a slice's points into the working system, which the first known one is if none was given.
    void place(std::size_t s, RawSlice& raw, std::size_t first) {
        const Crs crs = crs_of(s, raw);
        std::string z_unit = raw.z_unit.empty() ? crs.z_unit() : z_unit_name(raw.z_unit);
        if (!crs.is_known()) {
            without_crs_.push_back(s);
        } else if (!out_.crs.is_known()) {
            refuse_geographic(s, crs, first);
            out_.crs = crs;
            crs_from_ = s;
        } else if (!crs.is_same(out_.crs)) {
            if (!options_.crs.is_known()) {
                throw InputError(label(sources_[crs_from_]) + " is in " + out_.crs.name() + ", " +
                                 label(sources_[s]) + " in " + crs.name() +
                                 "; give the system to work in with --crs");
            }
            transform(s, raw, first, crs);
            if (!crs.z_unit().empty() && !out_.crs.z_unit().empty()) {
                z_unit = out_.crs.z_unit();
            }
        }
        note_z_unit(s, z_unit);
    }

    Crs crs_of(std::size_t s, const RawSlice& raw) {
        if (given_[s].is_known()) {
            if (raw.crs.is_known() && !raw.crs.is_same(given_[s])) {
                out_.warnings.push_back(label(sources_[s]) + ": says " + raw.crs.name() + "; read as " +
                                        given_[s].name() + " because of crs=");
            }
            return given_[s];
        }
        if (raw.crs.is_known()) {
            return raw.crs;
        }
        if (raw.is_lon_lat && !options_.source_crs.is_known()) {
            throw InputError(
                label(sources_[s]) +
                ": coordinates are longitude and latitude in an unknown system; give theirs, for "
                "example crs=EPSG:4326, and a projected one with --crs");
        }
        return options_.source_crs;
    }

    void refuse_geographic(std::size_t s, const Crs& crs, std::size_t first) const {
        if (!crs.is_geographic()) {
            return;
        }
        const std::string zone = utm_zone(std::span(out_.points).subspan(first));
        throw InputError(label(sources_[s]) + ": coordinates are geographic, " + crs.name() +
                         ", and degrees cannot be measured as a plane; give a projected system with --crs" +
                         (zone.empty() ? "" : ", for example --crs " + zone));
    }

    void transform(std::size_t s, RawSlice& raw, std::size_t first, const Crs& from) {
        const std::span<Point3> points = std::span(out_.points).subspan(first);
        const Progress read_progress = progress_of(s);
        const Progress go_on = [&](double) { return !read_progress || read_progress(1.0); };
        const std::vector<std::size_t> failed = transform_points(points, from, out_.crs, go_on);
        if (failed.empty()) {
            return;
        }
        const std::vector<std::int64_t> ids = raw.ids.all();
        const SampleSlice slice = slice_of(s, raw, first);
        for (const std::size_t i : failed) {
            raw.bad.add(describe_id(slice, ids[i]) + ": (" + number(points[i].x) + ", " +
                        number(points[i].y) + ") cannot be transformed from " + from.name() + " to " +
                        out_.crs.name());
        }
        std::size_t kept = first;
        std::size_t next = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (next < failed.size() && failed[next] == i) {
                ++next;
            } else {
                out_.points[kept++] = points[i];
            }
        }
        out_.points.resize(kept);
        raw.ids.erase(failed);
    }

    void note_z_unit(std::size_t s, const std::string& unit) {
        if (unit.empty()) {
            return;
        }
        if (out_.z_unit.empty()) {
            out_.z_unit = unit;
        } else if (out_.z_unit != unit && !are_z_units_mixed_) {
            are_z_units_mixed_ = true;
            out_.warnings.push_back(label(sources_[s]) + ": elevations are in " + unit +
                                    ", those before in " + out_.z_unit + "; they are not converted");
        }
    }

    [[nodiscard]] SampleSlice slice_of(std::size_t s, const RawSlice& raw, std::size_t first) const {
        SampleSlice slice;
        slice.kind = raw.kind;
        slice.source = s;
        slice.file = sources_[s].path;
        slice.layer = raw.layer;
        slice.first = first;
        return slice;
    }

    void keep(std::size_t s, const RawSlice& raw, std::size_t first) {
        SampleSlice slice = slice_of(s, raw, first);
        slice.count = out_.points.size() - first;
        slice.skipped = raw.bad.count();
        slice.first_id = raw.ids.front();
        if (!raw.ids.is_one_run()) {
            slice.ids = raw.ids.all();
        }
        out_.slices.push_back(std::move(slice));
        out_.warnings.insert(out_.warnings.end(), raw.warnings.begin(), raw.warnings.end());
        if (raw.bad.count() > 0) {
            out_.warnings.push_back(label(sources_[s]) + ": " + std::to_string(raw.bad.count()) +
                                    " unusable " + noun(raw.kind) + (raw.bad.count() == 1 ? "" : "s") +
                                    " skipped, the first is " + raw.bad.first());
        }
    }

    void finish() {
        if (out_.z_unit.empty()) {
            out_.z_unit = out_.crs.z_unit();
        }
        if (without_crs_.empty() || !out_.crs.is_known()) {
            return;
        }
        std::vector<std::string> files;
        for (const std::size_t s : without_crs_) {
            files.push_back(sources_[s].path);
        }
        out_.warnings.push_back((files.size() == 1 ? "file " : "files ") + quoted_list(files) +
                                (files.size() == 1 ? ": has" : ": have") + " no CRS; taken to be in " +
                                out_.crs.name());
    }

    std::span<const Source> sources_;
    const ReadOptions& options_;
    Samples out_;
    std::vector<Crs> given_;  // by crs=, one a source
    std::size_t crs_from_ = 0;
    std::vector<std::size_t> without_crs_;
    bool are_z_units_mixed_ = false;
};

}  // namespace

std::string Samples::describe(std::size_t sample) const {
    const auto after =
        std::upper_bound(slices.begin(), slices.end(), sample,
                         [](std::size_t s, const SampleSlice& slice) { return s < slice.first; });
    if (after == slices.begin() || sample >= points.size()) {
        return "sample " + std::to_string(sample);
    }
    const SampleSlice& slice = *std::prev(after);
    return describe_id(slice, slice.id(sample - slice.first));
}

Samples read_samples(std::span<const Source> sources, const ReadOptions& options) {
    register_drivers();
    const GdalMessages messages;
    return SampleReader(sources, options).read();
}

}  // namespace tinwright::io
