#include "benchmarks/contenders.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "tinwright/surface/locator.hpp"
#include "tinwright/surface/sharp_edges.hpp"

namespace tinwright_benchmarks {

using tinwright::SurfacePlace;
using tinwright::Tin;

namespace {

template <class Names>
auto parse_name(const Names& names, std::string_view name) {
    for (const auto& [known, value] : names) {
        if (known == name) {
            return value;
        }
    }
    throw std::runtime_error("there is no " + std::string(name) + " to compare");
}

Tin make_tin(const Fold& fold, const std::string& criterion) {
    tinwright::TriangulateOptions options;
    options.duplicates.policy = tinwright::DuplicatePolicy::Mean;
    options.noding.crossing_z = tinwright::CrossingPolicy::Mean;
    options.threads = 0;
    const std::string_view name = std::string_view(criterion).substr(0, criterion.find(':'));
    if (const auto optimal = tinwright::find_criterion(name)) {
        options.optimize.emplace().criterion = *optimal;
    } else if (!criterion.empty()) {
        options.data_dependent.emplace().measure = parse_name(tinwright::kCreaseMeasures, name);
        if (name.size() < criterion.size()) {
            options.data_dependent->delaunay_order = std::stoi(criterion.substr(name.size() + 1));
        }
    }
    return tinwright::triangulate(fold.samples, fold.lines, options).tin;
}

}  // namespace

Contender parse_contender(const std::string& text) {
    Contender contender;
    contender.name = text;
    std::string rest = text;
    const auto cut = [&rest](char mark) {
        const std::size_t at = rest.find(mark);
        std::string tail = at == std::string::npos ? "" : rest.substr(at + 1);
        rest = rest.substr(0, at);
        return tail;
    };
    contender.criterion = cut('@');
    const std::string gradients = cut('/');
    contender.interpolation.method = parse_name(tinwright::kInterpolationMethods, rest);
    if (!gradients.empty()) {
        contender.interpolation.gradients = parse_name(tinwright::kGradientMethods, gradients);
    }
    return contender;
}

std::vector<std::string> split_list(const std::string& list) {
    std::vector<std::string> parts;
    std::size_t start = 0;
    while (start < list.size()) {
        const std::size_t end = std::min(list.find(',', start), list.size());
        parts.push_back(list.substr(start, end - start));
        start = end + 1;
    }
    return parts;
}

std::vector<Contender> contenders_of(const std::string& list) {
    std::vector<Contender> contenders;
    if (list.empty()) {
        for (const auto& [name, method] : tinwright::kInterpolationMethods) {
            contenders.push_back(parse_contender(std::string(name)));
        }
        for (const auto& [name, measure] : tinwright::kCreaseMeasures) {
            contenders.push_back(parse_contender("linear@" + std::string(name)));
        }
        return contenders;
    }
    contenders.push_back(parse_contender("linear"));
    for (const std::string& name : split_list(list)) {
        if (name != "linear") {
            contenders.push_back(parse_contender(name));
        }
    }
    return contenders;
}

FoldErrors find_errors(const Fold& fold, const std::vector<Contender>& contenders) {
    FoldErrors result;
    std::vector<bool> is_line_sharp;
    for (const tinwright::Breakline& line : fold.lines) {
        is_line_sharp.push_back(line.is_sharp);
    }
    std::map<std::string, std::vector<std::size_t>> by_criterion;
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        by_criterion[contenders[c].criterion].push_back(c);
    }
    for (const auto& [criterion, members] : by_criterion) {
        const Tin tin = make_tin(fold, criterion);
        const tinwright::SharpEdges sharp(tin, is_line_sharp);
        const tinwright::SurfaceLocator locator(tin);
        std::vector<SurfacePlace> places;
        std::vector<std::size_t> inside;
        for (std::size_t i = 0; i < fold.checks.size(); ++i) {
            if (const std::optional<SurfacePlace> place =
                    locator.find(tinwright::Point2{fold.checks[i].x, fold.checks[i].y})) {
                places.push_back(*place);
                inside.push_back(i);
            }
        }
        result.inside = inside;
        result.errors.resize(inside.size(), std::vector<double>(contenders.size()));
        for (const std::size_t c : members) {
            const auto surface = make_interpolator(tin, sharp, contenders[c].interpolation);
            const auto reader = surface->make_reader();
            for (std::size_t i = 0; i < places.size(); ++i) {
                result.errors[i][c] = reader->elevation(places[i]) - fold.checks[inside[i]].z;
            }
        }
    }
    return result;
}

}  // namespace tinwright_benchmarks
