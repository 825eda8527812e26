#include "water_lines.hpp"

#include <utility>

namespace tinwright::tools {

namespace {

/// Describes the section `line`, which came from the line `from`.
void add_section(io::Lines& lines, std::size_t line, std::uint32_t from) {
    const io::LineSlice& banks = lines.slice_of(from);
    io::LinePart part = lines.parts[from];
    part.is_ring = false;
    lines.parts.push_back(part);
    io::LineSlice& last = lines.slices.back();
    if (last.role == LineRole::Section && last.source == banks.source) {
        ++last.count;
        return;
    }
    io::LineSlice sections = banks;
    sections.role = LineRole::Section;
    sections.first = line;
    sections.count = 1;
    sections.skipped = 0;
    lines.slices.push_back(std::move(sections));
}

}  // namespace

void take_water(io::Samples& samples, io::Lines& lines, std::vector<Breakline> made,
                const std::vector<std::uint32_t>& origin,
                const std::vector<std::pair<std::uint32_t, double>>& lifted) {
    for (const auto& [sample, z] : lifted) {
        samples.points[sample].z = z;
    }
    for (std::size_t line = lines.lines.size(); line < made.size(); ++line) {
        add_section(lines, line, origin[line]);
    }
    lines.lines = std::move(made);
}

}  // namespace tinwright::tools
