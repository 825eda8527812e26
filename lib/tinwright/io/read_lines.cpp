#include "tinwright/io/read_lines.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "tinwright/geometry/decimal.hpp"
#include "tinwright/geometry/error.hpp"
#include "tinwright/io/axis_order.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/line_features.hpp"
#include "tinwright/io/open_source.hpp"
#include "tinwright/io/placement.hpp"

namespace tinwright::io {
namespace {

std::string label(const Source& source) { return "file " + quoted(source.path); }

std::string name_of(LineRole role) {
    const std::string name = role_name(role);
    return role == LineRole::Boundary ? "boundaries" : name + "s";
}

/// One read_lines().
class LineReader {
  public:
    LineReader(std::span<const LineSource> sources, const ReadLinesOptions& options)
        : roles_(sources),
          options_(options),
          sources_(plain(sources)),
          placement_(sources_, {options.crs, options.source_crs, options.plane, options.heights,
                                options.epoch, options.is_plane_decided, options.z_unit}) {}

    Lines read() {
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            read_source(s);
        }
        // Where all of them are decides what plane they are brought to, so that is done with all at hand.
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            note(s);
        }
        placement_.choose_plane();
        for (std::size_t s = 0; s < sources_.size(); ++s) {
            LineRead& read = reads_[s];
            place(s);
            close_rings(read.plan, read.raw);
            require_lines(read.plan, read.raw);  // all may be outside the transformation's area, or open
            keep(s);
        }
        const std::vector<std::string> warnings = placement_.take_warnings();
        out_.warnings.insert(out_.warnings.end(), warnings.begin(), warnings.end());
        out_.plane = placement_.plane();
        out_.crs = out_.plane.crs;
        out_.z_unit = placement_.z_unit();
        out_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(out_);
    }

  private:
    /// What was read of a source.
    struct LineRead {
        LinePlan plan;
        std::string layer;
        CoordinateSystem own;
        RawLines raw;
        std::vector<Point3> points;        // of all lines
        std::vector<std::size_t> line_of;  // one a point
        std::vector<bool> is_draped;       // one a point
    };

    static std::vector<Source> plain(std::span<const LineSource> sources) {
        std::vector<Source> list;
        list.reserve(sources.size());
        for (const LineSource& source : sources) {
            list.push_back(source.source);
        }
        return list;
    }

    void read_source(std::size_t s) {
        const OpenedSource opened = open_line_source(sources_[s]);
        if (!opened.warning.empty()) {
            out_.warnings.push_back(opened.warning);
        }
        const VectorLayer layer(*opened.dataset, sources_[s], label(sources_[s]), wanted_lines());
        const LinePlan plan = make_line_plan(layer, sources_[s], roles_[s].role, options_.keep_faults);
        RawLines raw(options_.skip_bad);
        raw.polygons = polygons_;
        read_features(s, plan, layer, raw);
        require_lines(plan, raw);
        polygons_ = raw.polygons;
        const OGRSpatialReference* const system = layer.layer().GetSpatialRef();
        reads_.push_back({plan,
                          layer.layer().GetName(),
                          {Crs::from_gdal(system), false, is_north_first(system), {}},
                          std::move(raw),
                          {},
                          {},
                          {}});
    }

    void report(std::size_t s, double fraction) const {
        report_progress(options_.progress,
                        (static_cast<double>(s) + fraction) / static_cast<double>(sources_.size()));
    }

    void read_features(std::size_t s, const LinePlan& plan, const VectorLayer& chosen, RawLines& raw) const {
        const GdalMessages messages;
        OGRLayer& layer = chosen.layer();
        if (!sources_[s].where) {
            ignore_other_fields(layer, {plan.z_field, plan.across_field});
        }
        const bool is_counted = layer.TestCapability(OLCFastFeatureCount) != 0;
        const double total = is_counted ? static_cast<double>(layer.GetFeatureCount()) : 0.0;
        FeatureLines lines(plan, raw);
        constexpr std::size_t kFeaturesBetweenReports = 1024;
        std::size_t done = 0;
        layer.ResetReading();
        while (const std::unique_ptr<OGRFeature> feature{layer.GetNextFeature()}) {
            lines.add(*feature);
            if (++done % kFeaturesBetweenReports == 0) {
                const auto count = static_cast<double>(done);
                report(s, total > count ? count / total : count / (count + 1e5));
            }
        }
        chosen.require_no_error(messages, done > 0);
        report(s, 1);
    }

    static void require_lines(const LinePlan& plan, const RawLines& raw) {
        if (!raw.lines.empty() || plan.keeps_faults) {
            return;
        }
        throw InputError(plan.where + (raw.bad.count() > 0
                                           ? ": nothing usable; " + std::to_string(raw.bad.count()) +
                                                 " skipped, the first is " + raw.bad.first()
                                           : ": no lines"));
    }

    /// Takes the points of a source together, and says where they are.
    void note(std::size_t s) {
        LineRead& read = reads_[s];
        for (std::size_t i = 0; i < read.raw.lines.size(); ++i) {
            const std::vector<Point3>& line = read.raw.lines[i].points;
            read.points.insert(read.points.end(), line.begin(), line.end());
            read.line_of.insert(read.line_of.end(), line.size(), i);
        }
        read.is_draped.resize(read.points.size());
        for (std::size_t i = 0; i < read.points.size(); ++i) {
            if (std::isnan(read.points[i].z)) {
                read.is_draped[i] = true;
                read.points[i].z = 0;  // a transformation of a NaN fails
            }
        }
        read.own.has_z =
            std::find(read.is_draped.begin(), read.is_draped.end(), false) != read.is_draped.end();
        const std::vector<std::size_t> strays = placement_.note(s, read.own, read.points);
        if (!strays.empty() && !options_.skip_bad) {
            const std::size_t line = read.line_of[strays.front()];
            read.raw.add_bad(read.plan, read.raw.parts[line].feature,
                             placement_.failure(s, read.points[strays.front()]));
        }
    }

    /// Brings the lines into the plane; features that cannot be are bad.
    void place(std::size_t s) {
        LineRead& read = reads_[s];
        RawLines& raw = read.raw;
        std::vector<Point3> points = std::move(read.points);
        const std::vector<std::size_t> failed = placement_.place(s, points);
        std::size_t next = 0;
        for (Breakline& line : raw.lines) {
            for (Point3& point : line.points) {
                point = points[next];
                point.z = read.is_draped[next] ? kDraped : point.z;
                ++next;
            }
        }
        std::vector<std::pair<std::size_t, std::string>> bad;
        bad.reserve(failed.size());
        for (const std::size_t i : failed) {
            bad.emplace_back(read.line_of[i], placement_.failure(s, points[i]));
        }
        drop_features(read.plan, raw, bad);
    }

    /// Closes rings within the snapping distance; features with a wider gap are bad.
    void close_rings(const LinePlan& plan, RawLines& raw) {
        std::vector<std::pair<std::size_t, std::string>> bad;
        for (std::size_t i = 0; i < raw.lines.size(); ++i) {
            const bool must_close = is_polygon_role(plan.role) || raw.parts[i].is_ring;
            std::vector<Point3>& points = raw.lines[i].points;
            const Point3 first = points.front();
            const Point3 last = points.back();
            if (!must_close || (last.x == first.x && last.y == first.y)) {
                continue;
            }
            const double gap = std::hypot(last.x - first.x, last.y - first.y);
            LineConflict conflict;
            conflict.kind = LineConflict::Kind::OpenRing;
            conflict.location = {last.x, last.y};
            conflict.line_a = static_cast<std::uint32_t>(i);
            conflict.z_a = last.z;
            if (gap <= options_.snap && points.size() > 3 && !options_.keep_faults) {
                points.back() = first;
                conflict.action = LineConflict::Action::Snapped;
            } else if (!options_.keep_faults) {
                bad.emplace_back(i, "a ring is not closed: it begins at " +
                                        location_text({first.x, first.y}) + " and ends at " +
                                        location_text({last.x, last.y}) +
                                        "; close it, or allow for the gap with --snap DISTANCE");
                continue;
            }
            open_rings_.push_back(conflict);
        }
        const std::vector<std::size_t> kept = drop_features(plan, raw, bad);
        number_anew(kept);
    }

    /// Leaves out the features of lines that cannot be used; returns the lines kept, ascending.
    static std::vector<std::size_t> drop_features(
        const LinePlan& plan, RawLines& raw, const std::vector<std::pair<std::size_t, std::string>>& bad) {
        std::vector<std::uint32_t> dropped;  // ascending, as lines are in feature order
        for (const auto& [line, why] : bad) {
            if (dropped.empty() || dropped.back() != raw.ordinals[line]) {
                raw.add_bad(plan, raw.parts[line].feature, why);
                dropped.push_back(raw.ordinals[line]);
            }
        }
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < raw.lines.size(); ++i) {
            if (std::binary_search(dropped.begin(), dropped.end(), raw.ordinals[i])) {
                continue;
            }
            const std::size_t to = kept.size();
            if (to != i) {
                raw.lines[to] = std::move(raw.lines[i]);
                raw.parts[to] = raw.parts[i];
                raw.ordinals[to] = raw.ordinals[i];
            }
            kept.push_back(i);
        }
        raw.resize(kept.size());
        return kept;
    }

    /// Conflicts of the slice at hand count its lines as they were before some were left out.
    void number_anew(const std::vector<std::size_t>& kept) {
        std::erase_if(open_rings_, [&](LineConflict& conflict) {
            const auto place = std::lower_bound(kept.begin(), kept.end(), conflict.line_a);
            const bool is_gone = place == kept.end() || *place != conflict.line_a;
            conflict.line_a = static_cast<std::uint32_t>(out_.lines.size()) +
                              static_cast<std::uint32_t>(place - kept.begin());
            return is_gone;
        });
    }

    void note_missing_z(const RawLines& raw) {
        for (std::size_t i = 0; i < raw.lines.size(); ++i) {
            if (!raw.parts[i].lacks_z) {
                continue;
            }
            const std::vector<Point3>& points = raw.lines[i].points;
            const auto place = std::find_if(points.begin(), points.end(),
                                            [](const Point3& point) { return std::isnan(point.z); });
            LineConflict conflict;
            conflict.kind = LineConflict::Kind::MissingZ;
            conflict.line_a = static_cast<std::uint32_t>(out_.lines.size() + i);
            conflict.location = {place->x, place->y};
            out_.conflicts.push_back(conflict);
        }
    }

    void keep(std::size_t s) {
        LineRead& read = reads_[s];
        RawLines& raw = read.raw;
        note_missing_z(raw);
        out_.conflicts.insert(out_.conflicts.end(), open_rings_.begin(), open_rings_.end());
        open_rings_.clear();
        LineSlice slice;
        slice.role = read.plan.role;
        slice.source = s;
        slice.file = sources_[s].path;
        slice.layer = read.layer;
        slice.first = out_.lines.size();
        slice.count = raw.lines.size();
        slice.skipped = raw.bad.count();
        out_.slices.push_back(std::move(slice));
        std::move(raw.lines.begin(), raw.lines.end(), std::back_inserter(out_.lines));
        out_.parts.insert(out_.parts.end(), raw.parts.begin(), raw.parts.end());
        for (FeatureFault& fault : raw.faults) {
            fault.source = s;
            fault.layer = read.layer;
            out_.faults.push_back(std::move(fault));
        }
        if (raw.bad.count() > 0) {
            out_.warnings.push_back(label(sources_[s]) + ": " + std::to_string(raw.bad.count()) +
                                    " unusable feature" + (raw.bad.count() == 1 ? "" : "s") + " among the " +
                                    name_of(read.plan.role) + " skipped, the first is " + raw.bad.first());
        }
    }

    std::span<const LineSource> roles_;
    const ReadLinesOptions& options_;
    std::vector<Source> sources_;
    Placement placement_;
    Lines out_;
    std::vector<LineRead> reads_;  // one a source
    std::uint32_t polygons_ = 0;
    std::vector<LineConflict> open_rings_;  // of the slice at hand
};

}  // namespace

const LineSlice& Lines::slice_of(std::size_t line) const {
    const auto after =
        std::upper_bound(slices.begin(), slices.end(), line,
                         [](std::size_t l, const LineSlice& slice) { return l < slice.first; });
    return *std::prev(after);
}

std::string Lines::describe(std::size_t line) const {
    if (line >= lines.size()) {
        return "line " + std::to_string(line);
    }
    const LineSlice& slice = slice_of(line);
    return "file " + quoted(slice.file) + ", layer " + quoted(slice.layer) + ", feature " +
           std::to_string(parts[line].feature);
}

Lines read_lines(std::span<const LineSource> sources, const ReadLinesOptions& options) {
    register_drivers();
    const GdalMessages messages;
    return LineReader(sources, options).read();
}

}  // namespace tinwright::io
