#include "length_check.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "tinwright/criteria/length.hpp"
#include "tinwright/geometry/decimal.hpp"

#include "criterion_report.hpp"

namespace tinwright::tools {

namespace {

std::string length_text(double length) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.6g", length);
    return text.data();
}

/// "longest edge, 12.5 from (0, 0) to (7.5, 10),".
std::string edge_text(const LengthCheck& check) {
    return "longest edge, " + length_text(check.certificate.longest) + " from " +
           location_text({check.from.x, check.from.y}) + " to " + location_text({check.to.x, check.to.y});
}

/// What the file promises, as far as it is less than what was examined.
std::string promise_text(const LengthCheck& check) {
    if (check.is_unfinished) {
        return "; the file says that it was not finished";
    }
    if (check.made_with.empty()) {
        return check.is_improvable() ? "; the file does not tell that it was made for this criterion" : "";
    }
    return check.made_with == norm_name(check.norm) ? "" : "; the file was made for norm " + check.made_with;
}

std::string polygons_text(std::size_t count) {
    if (count == 0) {
        return "no polygon had to be triangulated anew";
    }
    return std::to_string(count) + (count == 1 ? " polygon" : " polygons") + " triangulated anew";
}

/// Feature id of the first face that has the edge.
std::int64_t find_face(const io::TinFile& file, const Tin& tin, const std::array<VertexId, 2>& edge) {
    // The mesh keeps the faces in the file's order; ghosts follow.
    for (std::uint32_t f = 0; f < file.face_ids.size(); ++f) {
        const auto& corners = tin.mesh.face({f}).vertex;
        const auto has = [&corners](VertexId v) {
            return std::find(corners.begin(), corners.end(), v) != corners.end();
        };
        if (has(edge[0]) && has(edge[1])) {
            return file.face_ids[f];
        }
    }
    return -1;
}

JsonValue location_json(const Point3& p) { return JsonValue::array_of({p.x, p.y, p.z}); }

}  // namespace

LengthCheck check_length(const io::TinFile& file, const Tin& tin, const LengthCheckOptions& options,
                         const Progress& progress) {
    LengthCheck check;
    const CriterionReport made = read_criterion_report(file.metadata);
    if (made.name == LengthCriterion::kTraits.name) {
        check.made_with = norm_name(made.edge_norm());
        check.is_unfinished = made.stopped_by == "budget" || made.stopped_by == "interrupt";
    }
    check.norm = options.norm.value_or(find_norm(check.made_with).value_or(Norm()));
    LengthCertificateOptions certificate;
    certificate.norm = check.norm;
    if (options.all) {
        certificate.largest_polygon.reset();
    }
    certificate.progress = progress;
    check.largest_polygon = certificate.largest_polygon;
    check.certificate = certify_length(tin, certificate);
    check.face = find_face(file, tin, check.certificate.edge);
    check.from = tin.position(check.certificate.edge[0]);
    check.to = tin.position(check.certificate.edge[1]);
    return check;
}

std::string length_verdict(const LengthCheck& check) {
    const LengthCertificate& certificate = check.certificate;
    std::string text = "length, norm " + norm_name(check.norm) + ": the " + edge_text(check) + ", ";
    if (certificate.is_optimal) {
        text += "is as short as it can be";
    } else if (certificate.attainable) {
        text += "can be " + length_text(*certificate.attainable);
    } else {
        text += "is not proven: --all looks at polygons of more than " +
                std::to_string(check.largest_polygon.value_or(0)) + " sides too";
    }
    text += " (" + polygons_text(certificate.polygons);
    if (certificate.left_out > 0) {
        text += ", " + std::to_string(certificate.left_out) + " left out";
    }
    return text + ")" + promise_text(check);
}

std::string length_line(const LengthCheck& check, const std::string& file) {
    return check.is_improvable() ? file + ": face " + std::to_string(check.face) + ": " + edge_text(check) +
                                       ", can be " + length_text(*check.certificate.attainable) + "\n"
                                 : std::string();
}

JsonValue length_json(const LengthCheck& check) {
    const LengthCertificate& certificate = check.certificate;
    JsonValue json = JsonValue::object();
    json.set("criterion", std::string(LengthCriterion::kTraits.name)).set("norm", norm_name(check.norm));
    if (!check.made_with.empty()) {
        json.set("made_with", check.made_with);
    }
    json.set("worst", certificate.longest)
        .set("face", check.face)
        .set("from", location_json(check.from))
        .set("to", location_json(check.to));
    json.set("proven", certificate.is_optimal);
    if (certificate.attainable) {
        json.set("attainable", *certificate.attainable);
    }
    json.set("polygons", certificate.polygons).set("left_out", certificate.left_out);
    return json.set("improvable", check.is_improvable() ? 1 : 0);
}

}  // namespace tinwright::tools
