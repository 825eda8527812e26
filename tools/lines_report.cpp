#include "lines_report.hpp"

#include "conflict_layer.hpp"
#include "option_values.hpp"

namespace tinwright::tools {

namespace {

constexpr const char* kConstraintsKey = "TINWRIGHT_CONSTRAINTS";
constexpr const char* kMethodKey = "TINWRIGHT_CONFORMING_METHOD";
constexpr const char* kConformingKey = "TINWRIGHT_CONFORMING";
constexpr const char* kSteinerKey = "TINWRIGHT_STEINER_VERTICES";

std::string counted(std::size_t count, const std::string& singular, const std::string& plural) {
    return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

/// "3 breaklines, 1 hole" of those that there are.
std::string roles_text(const LineCounts& counts) {
    std::string text;
    const auto add = [&text](std::size_t count, const char* one, const char* many) {
        if (count > 0) {
            text += (text.empty() ? "" : ", ") + counted(count, one, many);
        }
    };
    add(counts.breaklines, "breakline", "breaklines");
    add(counts.boundaries, "boundary ring", "boundary rings");
    add(counts.holes, "hole ring", "hole rings");
    add(counts.lakes, "lake ring", "lake rings");
    add(counts.rivers, "river", "rivers");
    add(counts.banks, "bank ring", "bank rings");
    add(counts.sections, "section", "sections");
    return text;
}

std::string edges_text(const LineCounts& counts) {
    std::string text = counted(counts.edges, "constrained edge", "constrained edges");
    if (counts.crossing_vertices > 0) {
        text += ", " + counted(counts.crossing_vertices, "vertex", "vertices") + " where they cross";
    }
    if (counts.draped_vertices > 0) {
        text += ", " + counted(counts.draped_vertices, "vertex", "vertices") + " draped";
    }
    return text;
}

std::size_t count_line_edges(const Tin& tin) {
    std::size_t edges = 0;
    for (std::size_t i = 0; i < tin.traces.size(); ++i) {
        const bool is_new =
            i == 0 || tin.traces[i].a != tin.traces[i - 1].a || tin.traces[i].b != tin.traces[i - 1].b;
        edges += is_new ? 1U : 0U;
    }
    return edges;
}

std::size_t& count_of(LineCounts& counts, LineRole role) {
    switch (role) {
        case LineRole::Boundary:
            return counts.boundaries;
        case LineRole::Hole:
            return counts.holes;
        case LineRole::Lake:
            return counts.lakes;
        case LineRole::Bank:
            return counts.banks;
        case LineRole::River:
            return counts.rivers;
        case LineRole::Section:
            return counts.sections;
        case LineRole::Breakline:
            break;
    }
    return counts.breaklines;
}

}  // namespace

LinesSummary summarize_lines(const LineOptions& options, const io::Lines& lines, const Tin& tin,
                             const TriangulateReport& report) {
    LinesSummary summary;
    if (options.sources.empty()) {
        return summary;
    }
    summary.constraints = options.constraints_name();
    summary.method = options.method_name();
    summary.is_conforming = report.is_conforming && report.is_left_delaunay();
    summary.steiner_vertices = report.conforming ? report.conforming->steiner_vertices : 0;
    LineCounts& counts = summary.counts.emplace();
    for (const Breakline& line : lines.lines) {
        ++count_of(counts, line.role);
    }
    counts.points = report.lines.line_points;
    counts.sources = options.sources.size();
    for (const io::LineSlice& slice : lines.slices) {
        counts.skipped += slice.skipped;
    }
    counts.edges = count_line_edges(tin);
    counts.crossing_vertices = report.lines.crossing_vertices;
    counts.draped_vertices = report.lines.draped_vertices;
    counts.open_edges = report.conforming ? report.conforming->open_edges : 0;
    counts.is_budget_spent = report.conforming && report.conforming->is_budget_spent;
    counts.conflicts = count_conflicts(report.lines.conflicts);
    return summary;
}

LinesSummary read_lines_summary(const io::TinMetadata& metadata) {
    LinesSummary summary;
    for (const auto& [key, value] : metadata) {
        if (key == kConstraintsKey) {
            summary.constraints = value;
        } else if (key == kMethodKey) {
            summary.method = value;
        } else if (key == kConformingKey && (value == "true" || value == "false")) {
            summary.is_conforming = value == "true";
        } else if (key == kSteinerKey) {
            const std::optional<double> count = find_number(value);
            if (count && *count >= 0) {
                summary.steiner_vertices = static_cast<std::size_t>(*count);
            }
        }
    }
    return summary;
}

io::TinMetadata lines_metadata(const LinesSummary& summary) {
    io::TinMetadata metadata;
    if (!summary.constraints.empty()) {
        metadata.emplace_back(kConstraintsKey, summary.constraints);
    }
    if (!summary.method.empty()) {
        metadata.emplace_back(kMethodKey, summary.method);
    }
    if (summary.is_conforming) {
        metadata.emplace_back(kConformingKey, *summary.is_conforming ? "true" : "false");
    }
    if (summary.steiner_vertices) {
        metadata.emplace_back(kSteinerKey, std::to_string(*summary.steiner_vertices));
    }
    return metadata;
}

JsonValue lines_json(const LinesSummary& summary) {
    const LineCounts& counts = *summary.counts;
    JsonValue kinds = JsonValue::object();
    for (std::size_t i = 0; i < counts.conflicts.size(); ++i) {
        if (counts.conflicts[i] > 0) {
            kinds.set(conflict_key(static_cast<LineConflict::Kind>(i)), counts.conflicts[i]);
        }
    }
    JsonValue json = JsonValue::object();
    json.set("constraints", summary.constraints);
    if (!summary.method.empty()) {
        json.set("method", summary.method).set("open_edges", counts.open_edges);
    }
    return json.set("breaklines", counts.breaklines)
        .set("boundaries", counts.boundaries)
        .set("holes", counts.holes)
        .set("lakes", counts.lakes)
        .set("rivers", counts.rivers)
        .set("banks", counts.banks)
        .set("sections", counts.sections)
        .set("points", counts.points)
        .set("skipped", counts.skipped)
        .set("edges", counts.edges)
        .set("crossing_vertices", counts.crossing_vertices)
        .set("draped_vertices", counts.draped_vertices)
        .set("conflicts", kinds);
}

std::vector<std::pair<std::string, std::string>> lines_lines(const LinesSummary& summary) {
    std::vector<std::pair<std::string, std::string>> lines;
    if (summary.counts) {
        const LineCounts& counts = *summary.counts;
        lines.emplace_back(
            "lines", roles_text(counts) + " with " + counted(counts.points, "point", "points") + " from " +
                         counted(counts.sources, "source", "sources") +
                         (counts.skipped > 0
                              ? "; " + counted(counts.skipped, "bad feature", "bad features") + " skipped"
                              : std::string()));
        lines.emplace_back("", edges_text(counts));
        const std::string conflicts = conflict_counts_text(counts.conflicts);
        if (!conflicts.empty()) {
            lines.emplace_back("conflicts", conflicts);
        }
    }
    if (summary.constraints == "conforming" && summary.steiner_vertices) {
        std::string text = counted(*summary.steiner_vertices, "Steiner point", "Steiner points");
        text += summary.method.empty() ? "" : ", method " + summary.method;
        if (summary.counts) {
            const std::size_t open = summary.counts->open_edges;
            text += open == 0 ? "; every edge of a line lies in an empty disk"
                              : "; " + counted(open, "edge of a line lies", "edges of lines lie") +
                                    " in no empty disk";
        }
        lines.emplace_back("conforming", text);
    }
    return lines;
}

std::vector<std::string> lines_warnings(const LinesSummary& summary) {
    if (!summary.counts || summary.counts->open_edges == 0) {
        return {};
    }
    return {"the TIN is valid but does not conform: " +
            counted(summary.counts->open_edges, "edge of a line lies", "edges of lines lie") +
            " in no empty disk; " +
            (summary.counts->is_budget_spent
                 ? "--max-steiner is used up, a higher one may help"
                 : "lines run too close together there for the lattice, --snap joins them")};
}

}  // namespace tinwright::tools
