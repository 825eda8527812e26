#include "tinwright/io/working_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <vector>

#include <ogr_spatialref.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/plane_candidates.hpp"

namespace tinwright::io {
namespace {

// A plane that files or users name may be off by so much before it is worth a word.
constexpr double kWorthAWarning = 0.01;

std::string format(const char* pattern, double value) {
    std::array<char, 64> text{};
    (void)std::snprintf(text.data(), text.size(), pattern, value);
    return text.data();
}

/// "0.1 %", with two digits that count.
std::string percent(double part) {
    const double value = part * 100;
    return format(value < 10 ? "%.2g %%" : "%.0f %%", value);
}

/// "--max-distortion 0.16%", the next larger limit of two digits: it is kept. Empty beyond 100 %.
std::string limit_advice(double distortion) {
    const double value = distortion * 100;
    const double step = std::pow(10, std::floor(std::log10(value)) - 1);
    const double limit = std::ceil(value / step) * step;
    if (!(limit <= 100)) {
        return {};
    }
    return "--max-distortion " + format(limit < 10 ? "%.2g%%" : "%.0f%%", limit);
}

/// How large that is; `radius` of the equator, metres.
std::string size_text(const GeographicExtent& extent, double radius) {
    constexpr double kRadian = std::numbers::pi / 180;
    const double degree = radius * kRadian / 1000;
    const std::string height = format("%.0f km", (extent.north - extent.south) * degree);
    if (extent.has_pole) {
        return "up to " + height + " from it";
    }
    // Along the longest of its parallels.
    const double widest = extent.south > 0 ? extent.south : std::min(extent.north, 0.0);
    const double width = (extent.east - extent.west) * std::cos(widest * kRadian) * degree;
    return format("%.0f", width) + " by " + height;
}

/// "UTM zone 14N is off by up to 5 %" for each candidate.
std::string figures(std::span<const PlaneCandidate> candidates) {
    std::string text;
    for (const PlaneCandidate& candidate : candidates) {
        text += text.empty() ? "" : ", ";
        text += candidate.kind;
        text += candidate.scale ? " is off by up to " + percent(candidate.distortion()) : " cannot hold it";
    }
    return text;
}

[[noreturn]] void refuse(const Crs& geographic, const GeographicExtent& extent,
                         std::span<const PlaneCandidate> candidates, const PlaneRequest& request) {
    double least = candidates.front().distortion();
    for (const PlaneCandidate& candidate : candidates) {
        least = std::min(least, candidate.distortion());
    }
    std::string advice = limit_advice(least);
    advice = advice.empty() ? advice : "give " + advice + ", ";
    if (request.rule == PlaneRequest::Rule::Utm) {
        advice += "choose --working-crs local, ";
    }
    throw InputError("no plane keeps lengths right to " + percent(request.max_distortion) +
                     " (--max-distortion) over the data's extent, " + extent.text() + " (" +
                     size_text(extent, geographic.gdal()->GetSemiMajor()) + "): " + figures(candidates) +
                     "; " + advice +
                     "cut the data with where=, or name a projected system made for the area, such as a "
                     "country's Lambert or Albers, with --working-crs");
}

WorkingPlane make_plane(const Crs& source, const GeographicExtent& extent, const PlaneCandidate& candidate,
                        WorkingPlane::Origin origin) {
    WorkingPlane plane;
    plane.crs = candidate.crs;
    plane.origin = origin;
    plane.source_crs = source;
    plane.extent = extent;
    plane.scale = candidate.scale.value_or(ScaleRange{});
    return plane;
}

bool is_named(const WorkingPlane& plane) {
    return plane.origin == WorkingPlane::Origin::Asked || plane.origin == WorkingPlane::Origin::Shared;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

}  // namespace

PlaneRequest parse_plane_request(const std::string& text) {
    PlaneRequest request;
    const std::string word = lower(text);
    if (word == "auto") {
        return request;
    }
    if (word == "utm" || word == "local") {
        request.rule = word == "utm" ? PlaneRequest::Rule::Utm : PlaneRequest::Rule::Local;
        return request;
    }
    const std::string advice = R"(; give a projected system such as EPSG:32632, or "auto", "utm" or "local")";
    try {
        request.crs = Crs::parse(text);
    } catch (const UsageError&) {
        throw UsageError("--working-crs " + quoted(text) + ": not understood" + advice);
    }
    const std::string name = "--working-crs " + quoted(text) + ": " + request.crs.name() + " ";
    const OGRSpatialReference& system = *request.crs.gdal();
    if (request.crs.is_geocentric()) {
        throw UsageError(name + "is geocentric, which is no plane" + advice);
    }
    if (request.crs.is_geographic()) {
        throw UsageError(name + "is in degrees, which are no plane" + advice);
    }
    if (system.IsVertical() != 0 && system.IsCompound() == 0) {
        throw UsageError(name + "is for elevations alone" + advice);
    }
    request.rule = PlaneRequest::Rule::Given;
    return request;
}

std::string WorkingPlane::text() const {
    if (origin == Origin::Unknown || !crs.is_known()) {
        return "none";
    }
    std::string text = crs.name();
    switch (origin) {
        case Origin::Asked:
            text += ", as asked for";
            break;
        case Origin::Shared:
            text += ", the sources' own";
            break;
        case Origin::Utm:
            text += ", chosen for the data's longitudes and latitudes";
            break;
        case Origin::Local:
            text += ", made for the data's longitudes and latitudes";
            break;
        case Origin::Unknown:
            break;
    }
    if (!extent.is_empty) {
        text += "; scale " + format("%.5f", scale.least) + " to " + format("%.5f", scale.greatest);
    }
    return text;
}

WorkingPlane choose_working_plane(const Crs& source, const GeographicExtent& extent,
                                  const PlaneRequest& request) {
    const Crs geographic = source.geographic();
    if (extent.is_empty || !geographic.is_known()) {
        throw InputError(
            "no plane can be chosen without longitudes and latitudes to choose it for; name one with "
            "--working-crs");
    }
    std::vector<PlaneCandidate> candidates;
    if (request.rule != PlaneRequest::Rule::Local) {
        candidates.push_back(make_utm(geographic, extent));
        if (candidates.front().distortion() <= request.max_distortion) {
            return make_plane(source, extent, candidates.front(), WorkingPlane::Origin::Utm);
        }
    }
    if (request.rule != PlaneRequest::Rule::Utm) {
        candidates.push_back(make_local_transverse_mercator(geographic, extent));
        candidates.push_back(make_local_stereographic(geographic, extent));
        const PlaneCandidate& mercator = candidates[candidates.size() - 2];
        const PlaneCandidate& stereographic = candidates.back();
        const PlaneCandidate& best =
            stereographic.distortion() < mercator.distortion() ? stereographic : mercator;
        if (best.distortion() <= request.max_distortion) {
            return make_plane(source, extent, best, WorkingPlane::Origin::Local);
        }
    }
    const auto least = std::min_element(
        candidates.begin(), candidates.end(),
        [](const PlaneCandidate& a, const PlaneCandidate& b) { return a.distortion() < b.distortion(); });
    if (request.takes_best && std::isfinite(least->distortion())) {
        const bool is_utm = least == candidates.begin() && request.rule != PlaneRequest::Rule::Local;
        return make_plane(source, extent, *least,
                          is_utm ? WorkingPlane::Origin::Utm : WorkingPlane::Origin::Local);
    }
    refuse(geographic, extent, candidates, request);
}

std::string check_distortion(const WorkingPlane& plane, const PlaneRequest& request) {
    const double distortion = plane.scale.distortion();
    const bool does_limit_count = !is_named(plane) || request.is_limit_given;
    if (plane.extent.is_empty || distortion <= std::min(kWorthAWarning, request.max_distortion)) {
        return {};
    }
    const std::string what = plane.crs.name() + " stretches lengths by " + format("%.5g", plane.scale.least) +
                             " to " + format("%.5g", plane.scale.greatest) + " over the data (" +
                             plane.extent.text() + ")";
    if (does_limit_count && distortion > request.max_distortion) {
        const std::string advice = limit_advice(distortion);
        throw InputError(what + ", more than the " + percent(request.max_distortion) +
                         " of --max-distortion; give --working-crs local" +
                         (advice.empty() ? advice : ", " + advice) + " or another projected system");
    }
    if (!is_named(plane) || distortion <= kWorthAWarning) {
        return {};
    }
    return what +
           ": distances, areas and slopes are off by that; --working-crs local makes a plane for the data";
}

}  // namespace tinwright::io
