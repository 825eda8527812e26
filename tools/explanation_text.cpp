#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tinwright/criteria/criterion.hpp"
#include "tinwright/geometry/decimal.hpp"

#include "explanation.hpp"

namespace tinwright::tools {

namespace {

constexpr std::size_t kSharesTold = 6;

/// Six significant digits, for what is not compared.
std::string rounded(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value + 0.0);
    return text.data();
}

/// To a hundred-millionth: what surfaces of sums leave in the digits behind is their rounding.
std::string elevation_text(double z) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.8f", z + 0.0);
    std::string digits = text.data();
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.ends_with('.')) {
        digits.pop_back();
    }
    return digits == "-0" ? "0" : digits;
}

std::string provenance_text(const Provenance& from) {
    const SourceName& name = from.source;
    if (name.text.empty() && from.number == 0) {
        return {};
    }
    const std::string source = name.text.empty() ? "source " + std::to_string(from.number) : name.text;
    const std::string word = name.id_word.empty() ? "feature" : name.id_word;
    return ", " + source + (from.feature < 0 ? "" : ", " + word + " " + std::to_string(from.feature));
}

std::string vertex_text(const ExplainedVertex& vertex) {
    return std::to_string(vertex.vertex.value) + " at " +
           location_text({vertex.position.x, vertex.position.y}) + ", z " + decimal_text(vertex.position.z) +
           ": " + vertex.kind + provenance_text(vertex.from);
}

std::string edge_text(const ExplainedEdge& edge) {
    std::string text = std::to_string(edge.a.value) + " to " + std::to_string(edge.b.value) + ", length " +
                       rounded(edge.length);
    text += edge.is_border ? ", on the border" : "";
    if (edge.is_delaunay) {
        text += *edge.is_delaunay ? ", Delaunay" : ", not Delaunay";
    }
    text += edge.is_constrained ? ", constrained" : "";
    text += edge.is_sharp ? ", sharp" : "";
    for (const ExplainedLine& line : edge.lines) {
        text +=
            "; " + std::string(line.is_sharp ? "sharp " : "smooth ") + line.role + provenance_text(line.from);
    }
    return text;
}

const char* unit_word(SlopeUnit unit) {
    return unit == SlopeUnit::Degree ? " degree" : unit == SlopeUnit::Percent ? " percent" : "";
}

std::string incline_text(Point2 gradient, SlopeUnit unit) {
    const double aspect = aspect_of(gradient);
    return rounded(slope_of(gradient, unit)) + unit_word(unit) +
           (std::isfinite(aspect) ? ", falls to " + rounded(aspect) + " degree" : ", level");
}

std::string shares_text(const std::vector<VertexWeight>& weights) {
    std::string text;
    for (std::size_t i = 0; i < std::min(weights.size(), kSharesTold); ++i) {
        text += (i == 0 ? "" : ", ") + std::to_string(weights[i].vertex.value) + ": " +
                rounded(weights[i].weight);
    }
    if (weights.size() > kSharesTold) {
        text += ", and " + std::to_string(weights.size() - kSharesTold) + " more";
    }
    return text;
}

/// "longest edge 12 to 7, 34.5 metre in norm l1; the TIN's longest has 98.1, proven: ...".
std::string length_text(const Explanation& explanation, const Surface& surface) {
    const CriterionReport& criterion = surface.criterion;
    const ExplainedEdge& edge = explanation.edges[explanation.length->edge];
    std::string text = "longest edge " + std::to_string(edge.a.value) + " to " +
                       std::to_string(edge.b.value) + ", " + rounded(explanation.length->told) + " " +
                       explanation.length->unit + " in norm " + norm_name(criterion.edge_norm());
    text += *explanation.measure == explanation.length->of_tin
                ? "; no edge of the TIN is longer"
                : "; the longest of the TIN has " + rounded(explanation.length->of_tin_told);
    return criterion.proven.empty() ? text : text + ", proven: " + criterion.proven;
}

std::string measure_text(const Explanation& explanation, const Surface& surface) {
    if (explanation.length) {
        return length_text(explanation, surface);
    }
    const double measure = *explanation.measure;
    std::string text = surface.criterion.name + " " + rounded(measure) + " " + surface.criterion.unit;
    if (surface.criterion.worst) {
        text += "; the worst face has " + rounded(*surface.criterion.worst);
    }
    return surface.criterion.proven.empty() ? text : text + ", proven: " + surface.criterion.proven;
}

JsonValue provenance_into(JsonValue json, const Provenance& from) {
    if (!from.source.text.empty()) {
        json.set("source", from.source.text);
    }
    if (from.number > 0) {
        json.set("source_number", from.number);
    }
    if (from.feature >= 0) {
        json.set("feature", from.feature);
    }
    return json;
}

JsonValue vertex_json(const ExplainedVertex& vertex) {
    const Point3& p = vertex.position;
    JsonValue json = JsonValue::object();
    json.set("vertex", vertex.vertex.value).set("location", JsonValue::array_of({p.x, p.y, p.z}));
    return provenance_into(json.set("kind", vertex.kind), vertex.from);
}

JsonValue edge_json(const ExplainedEdge& edge) {
    JsonValue json = JsonValue::object();
    json.set("a", edge.a.value).set("b", edge.b.value).set("length", edge.length);
    json.set("border", edge.is_border).set("constrained", edge.is_constrained).set("sharp", edge.is_sharp);
    if (edge.is_delaunay) {
        json.set("delaunay", *edge.is_delaunay);
    }
    JsonValue lines = JsonValue::array();
    for (const ExplainedLine& line : edge.lines) {
        JsonValue one = JsonValue::object();
        lines.append(provenance_into(one.set("role", line.role).set("sharp", line.is_sharp), line.from));
    }
    return json.set("lines", lines);
}

JsonValue method_json(const ExplainedMethod& method, SlopeUnit unit) {
    JsonValue json = JsonValue::object();
    const Point2 gradient = method.reading.gradient;
    json.set("method", method.name).set("z", method.reading.z);
    json.set("gradient", JsonValue::array_of({gradient.x, gradient.y}));
    json.set("slope", slope_of(gradient, unit)).set("aspect", aspect_of(gradient));
    JsonValue weights = JsonValue::array();
    for (const VertexWeight& weight : method.weights) {
        weights.append(JsonValue::object().set("vertex", weight.vertex.value).set("weight", weight.weight));
    }
    return json.set("weights", weights);
}

JsonValue measure_json(const Explanation& explanation, const Surface& surface) {
    JsonValue json = JsonValue::object();
    json.set("criterion", surface.criterion.name);
    if (explanation.length) {
        json.set("norm", norm_name(surface.criterion.edge_norm()));
    }
    json.set("value", explanation.length ? explanation.length->told : *explanation.measure);
    json.set("unit", explanation.length ? explanation.length->unit : surface.criterion.unit);
    if (explanation.length) {
        const ExplainedEdge& edge = explanation.edges[explanation.length->edge];
        json.set("longest_edge", JsonValue::object().set("a", edge.a.value).set("b", edge.b.value));
        json.set("longest_of_tin", explanation.length->of_tin_told);
    }
    return json;
}

template <class Items, class Make>
JsonValue array_made(const Items& items, const Make& make) {
    JsonValue array = JsonValue::array();
    for (const auto& item : items) {
        array.append(make(item));
    }
    return array;
}

class TextMaker {
  public:
    void add(const std::string& label, const std::string& line) {
        text_ += "  " + label + std::string(26 - std::min<std::size_t>(label.size(), 25), ' ') + line + "\n";
    }
    void start(const std::string& line) { text_ += line + "\n"; }
    std::string take() { return std::move(text_); }

  private:
    std::string text_;
};

}  // namespace

std::string explanation_text(const Explanation& explanation, const Surface& surface,
                             const ExplainOptions& options) {
    TextMaker text;
    const std::string where = location_text(explanation.asked);
    text.start(explanation.is_inside ? where + " is on face " + std::to_string(explanation.face)
                                     : where + " is outside the surface: there is no elevation");
    text.add("lattice",
             "vertices to " + rounded(explanation.quantum) + ", the place to " + rounded(explanation.step));
    if (explanation.is_inside) {
        for (const ExplainedVertex& corner : explanation.corners) {
            text.add("corner", vertex_text(corner));
        }
        for (const ExplainedEdge& edge : explanation.edges) {
            text.add("edge", edge_text(edge));
        }
        text.add("face", explanation.made_by);
        if (explanation.measure) {
            text.add("criterion", measure_text(explanation, surface));
        }
    }
    text.add("nearest sample", vertex_text(explanation.nearest));
    text.add("  its distance", rounded(explanation.nearest_distance));
    if (explanation.breakline_distance) {
        text.add("nearest breakline", rounded(*explanation.breakline_distance) + " away");
    }
    for (const ExplainedMethod& method : explanation.methods) {
        const bool has_incline = method.name != "nearest";
        text.add(
            method.name,
            "z " + elevation_text(method.reading.z) +
                (has_incline ? ", slope " + incline_text(method.reading.gradient, options.slope_unit) : ""));
        text.add("  shares", shares_text(method.weights));
    }
    if (is_z_unit_assumed(surface)) {
        text.add("z unit", z_unit_text(surface));
    }
    return text.take();
}

JsonValue explanation_json(const Explanation& explanation, const Surface& surface,
                           const ExplainOptions& options) {
    JsonValue json = JsonValue::object();
    json.set("at", JsonValue::array_of({explanation.asked.x, explanation.asked.y}));
    json.set("quantum", explanation.quantum).set("step", explanation.step);
    json.set("inside", explanation.is_inside);
    json.set("nearest", vertex_json(explanation.nearest).set("distance", explanation.nearest_distance));
    if (explanation.breakline_distance) {
        json.set("breakline_distance", *explanation.breakline_distance);
    }
    if (!explanation.is_inside) {
        return json;
    }
    json.set("face", explanation.face);
    json.set("corners", array_made(explanation.corners, vertex_json));
    json.set("edges", array_made(explanation.edges, edge_json));
    json.set("made_by", explanation.made_by);
    if (explanation.measure) {
        json.set("measure", measure_json(explanation, surface));
    }
    return json.set("methods", array_made(explanation.methods, [&](const ExplainedMethod& method) {
                        return method_json(method, options.slope_unit);
                    }));
}

}  // namespace tinwright::tools
