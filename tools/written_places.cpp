#include "written_places.hpp"

namespace tinwright::tools {

namespace {

void bring_to(const io::OutputPositions& positions, std::vector<WaterFinding>& findings) {
    for (WaterFinding& finding : findings) {
        finding.location = positions.transform(finding.location);
    }
}

}  // namespace

io::Crs audit_crs(const CrsOptions& options, const io::WorkingPlane& plane) {
    const io::Crs asked = options.crs();
    const io::Crs wanted = asked.is_known() ? asked : plane.source_crs;
    const std::string& unit = options.heights.unit;  // a system must not claim another than z has
    const bool is_unit_kept = unit.empty() || unit == plane.crs.z_unit();
    if (!wanted.is_known() || !plane.crs.is_known() || wanted.is_same_horizontally(plane.crs)) {
        return is_unit_kept ? plane.crs : plane.crs.horizontal();
    }
    return is_unit_kept ? wanted.with_heights_of(plane.crs) : wanted.horizontal();
}

io::OutputPositions positions_of(const io::Lines& lines, const io::Samples& samples, const io::Crs& plane,
                                 const io::Crs& output) {
    Box bounds;
    for (const Point3& p : samples.points) {
        bounds.add(p.x, p.y);
    }
    for (const Breakline& line : lines.lines) {
        for (const Point3& p : line.points) {
            bounds.add(p.x, p.y);
        }
    }
    return {plane, output, bounds};
}

void bring_to(const io::OutputPositions& positions, std::span<LineConflict> conflicts) {
    for (LineConflict& conflict : conflicts) {
        conflict.location = positions.transform(conflict.location);
    }
}

void bring_to(const io::OutputPositions& positions, RepairedLines& lines) {
    for (std::vector<std::vector<Point3>>& parts : lines) {
        for (std::vector<Point3>& part : parts) {
            positions.apply_to(part);
        }
    }
}

void bring_to_output(LeveledWater& leveled, const CrsOptions& options) {
    Water& water = leveled.water;
    for (std::size_t i = leveled.lines.lines.size(); i < water.lines.size(); ++i) {
        const Point3& a = water.lines[i].points.front();
        const Point3& b = water.lines[i].points.back();
        leveled.section_widths.push_back(leveled.options.ground.length({a.x, a.y}, {b.x, b.y}));
    }
    leveled.output_crs = audit_crs(options, leveled.plane);
    const io::OutputPositions positions =
        positions_of(leveled.lines, leveled.samples, leveled.crs, leveled.output_crs);
    if (positions.is_identity()) {
        return;
    }
    for (Breakline& line : water.lines) {
        positions.apply_to(line.points);
    }
    for (Reach& reach : water.report.reaches) {
        positions.apply_to(reach.points);
    }
    for (LakeLevel& lake : water.report.lakes) {
        lake.location = positions.transform(lake.location);
    }
    bring_to(positions, water.report.findings);
    if (leveled.raster) {
        bring_to(positions, leveled.raster->report.findings);
    }
}

}  // namespace tinwright::tools
