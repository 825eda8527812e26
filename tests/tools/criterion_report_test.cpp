#include "criterion_report.hpp"

#include <doctest/doctest.h>

#include "surface_input.hpp"

namespace {

using namespace tinwright;
using namespace tinwright::tools;

TriangulationOptions options_for(const std::string& criterion, const std::string& scope = "",
                                 const std::string& budget = "") {
    TriangulationOptions options;
    options.criterion_text = criterion;
    options.scope_text = scope;
    options.budget_text = budget;
    options.finish(DomainRule::Kind::Convex);
    return options;
}

TriangulateReport with(const OptimizeReport& optimum) {
    TriangulateReport report;
    report.optimize = optimum;
    return report;
}

OptimizeReport sample_result() {
    OptimizeReport result;
    result.before = {12.25, 8.5};
    result.after = {4.5, 3.25};
    result.proof = Proof::Theorem;
    result.insertions = 1234;
    result.tries = 5678;
    result.candidates = 7890;
    result.frozen = 12;
    return result;
}

OptimizeReport length_result() {
    OptimizeReport result;
    result.before = {105.5, 88.25};
    result.after = {98, 80.5};
    result.proof = Proof::Theorem;
    result.tries = 345;
    result.length = LengthReport{1000, 345, 3, 25, 12};
    return result;
}

TriangulationOptions length_options(const std::string& norm) {
    TriangulationOptions options;
    options.criterion_text = "length";
    options.norm_text = norm;
    options.finish(DomainRule::Kind::Convex);
    return options;
}

io::Crs in_metres() { return io::Crs::parse("EPSG:25832"); }
io::Crs nowhere() { return {}; }

}  // namespace

TEST_SUITE("tools/criterion_report") {
    TEST_CASE("people read what became better, whether that is proven, and what it took") {
        const CriterionReport report =
            make_criterion_report(options_for("slope"), with(sample_result()), in_metres());
        CHECK(criterion_lines(report) ==
              std::vector<std::string>{
                  "slope, scope top:0.5%", "greatest slope 12.25 -> 4.5 (interior 8.5 -> 3.25)",
                  "the worst face proven optimal (theorem)",
                  "1234 edges inserted of 7890 considered, 5678 faces tried, 12 as good as can be, no ties"});
    }

    TEST_CASE("lengths have the unit of the CRS, angles are degrees") {
        const auto second_line = [](const char* criterion, const io::Crs& crs) {
            return criterion_lines(make_criterion_report(options_for(criterion), with(sample_result()), crs))
                .at(1);
        };
        CHECK(second_line("height", in_metres()) ==
              "least height 12.25 -> 4.5 metre (interior 8.5 -> 3.25 metre)");
        CHECK(second_line("eccentricity", nowhere()) ==
              "greatest eccentricity 12.25 -> 4.5 (interior 8.5 -> 3.25)");
        CHECK(second_line("angle", in_metres()) ==
              "largest angle 12.25 -> 4.5 deg (interior 8.5 -> 3.25 deg)");
        const auto unit = [](const char* criterion, const io::Crs& crs) {
            return make_criterion_report(options_for(criterion), with(sample_result()), crs).unit;
        };
        CHECK(unit("height", in_metres()) == "metre");
        CHECK(unit("height", nowhere()) == "CRS unit");
        CHECK(unit("angle", nowhere()) == "degree");
        CHECK(unit("slope", in_metres()) == "ratio");
    }

    TEST_CASE("of length people read what the longest edge became, in which norm, and that it is proven") {
        CHECK(criterion_lines(
                  make_criterion_report(length_options("l1"), with(length_result()), in_metres())) ==
              std::vector<std::string>{"length, norm l1, scope max",
                                       "longest edge 105.5 -> 98 metre (interior 88.25 -> 80.5 metre)",
                                       "proven: no triangulation has a shorter longest edge",
                                       "345 polygons between relative neighbours looked at, up to 25 sides "
                                       "each, 12 triangulated anew"});
        OptimizeReport same = length_result();
        same.after = same.before;
        same.length = LengthReport{1000, 0, 0, 0, 0};
        const auto lines =
            criterion_lines(make_criterion_report(length_options(""), with(same), in_metres()));
        CHECK(lines.at(0) == "length, norm l2, scope max");
        CHECK(lines.at(2) ==
              "proven: no triangulation has a shorter longest edge; the Delaunay TIN's is as short");
        CHECK(lines.at(3) == "the longest edge is one of border, lines or relative neighbours");
        OptimizeReport stopped = length_result();
        stopped.proof = Proof::None;
        stopped.stopped_by = StoppedBy::Budget;
        CHECK(criterion_lines(make_criterion_report(length_options(""), with(stopped), in_metres())).at(2) ==
              "not proven the shortest possible: stopped by the budget");
        stopped.length = LengthReport();
        CHECK(criterion_lines(make_criterion_report(length_options(""), with(stopped), in_metres())).size() ==
              3);
        CHECK(criterion_warnings(length_options(""), with(stopped)) ==
              std::vector<std::string>{"the budget of 0 s ran out: the TIN is valid but its longest edge is "
                                       "not proven the shortest possible; give a longer --budget"});
    }

    TEST_CASE("a file keeps the norm and what the polygons were like") {
        const CriterionReport report =
            make_criterion_report(length_options("lp:3"), with(length_result()), in_metres());
        const io::TinMetadata metadata = criterion_metadata(report);
        CHECK(metadata_value(metadata, "TINWRIGHT_NORM") == "lp:3");
        CHECK(metadata_value(metadata, "TINWRIGHT_LARGEST_POLYGON") == "25");
        CHECK(metadata_value(metadata, "TINWRIGHT_INSERTIONS").empty());
        const CriterionReport read = read_criterion_report(metadata);
        CHECK(read.edge_norm() == Norm::lp(3));
        CHECK(criterion_json(read).text() == criterion_json(report).text());
        CHECK(criterion_metadata(read) == metadata);
        const std::string json = criterion_json(report).text();
        for (const char* key :
             {"\"norm\": \"lp:3\"", "\"scope\": \"max\"", "\"worst\": 98", "\"worst_delaunay\": 105.5",
              "\"proven\": \"theorem\"", "\"graph_edges\": 1000", "\"polygons\": 345", "\"incomplete\": 3",
              "\"largest_polygon\": 25", "\"changed\": 12"}) {
            CAPTURE(key);
            CHECK(json.find(key) != std::string::npos);
        }
        CHECK(json.find("insertions") == std::string::npos);
        CHECK(read_criterion_report({{"TINWRIGHT_CRITERION", "length"}, {"TINWRIGHT_NORM", "l7"}})
                  .edge_norm() == Norm());
    }

    TEST_CASE("every kind of proof, and of none, has its words") {
        const auto third_line = [](const char* scope, Proof proof, StoppedBy stopped_by) {
            OptimizeReport result = sample_result();
            result.proof = proof;
            result.stopped_by = stopped_by;
            return criterion_lines(
                       make_criterion_report(options_for("slope", scope), with(result), in_metres()))
                .at(2);
        };
        CHECK(third_line("vector", Proof::Theorem, StoppedBy::Finished) ==
              "every face proven optimal (theorem)");
        CHECK(third_line("max", Proof::Tested, StoppedBy::Finished) ==
              "the worst face tested to be optimal; equal measures, which the theorem excludes, were met");
        CHECK(third_line("above:9", Proof::None, StoppedBy::Finished) ==
              "not proven optimal: the scope ends before a face that cannot be improved; choose --scope max "
              "for a proof");
        CHECK(third_line("max", Proof::None, StoppedBy::Budget) ==
              "not proven optimal: stopped by the budget");
        CHECK(third_line("max", Proof::None, StoppedBy::Interrupt) ==
              "not proven optimal: stopped by an interrupt");
    }

    TEST_CASE("what a file keeps is read back") {
        const CriterionReport report =
            make_criterion_report(options_for("height", "vector"), with(sample_result()), in_metres());
        const io::TinMetadata metadata = criterion_metadata(report);
        const CriterionReport read = read_criterion_report(metadata);
        CHECK(criterion_json(read).text() == criterion_json(report).text());
        CHECK(criterion_metadata(read) == metadata);
        std::vector<std::string> lines = criterion_lines(report);
        lines.at(0) = "height, scope vector (as the file says)";
        CHECK(criterion_lines(read) == lines);
    }

    TEST_CASE("a Delaunay TIN, and one that says nothing, have no more than a name") {
        const CriterionReport report =
            make_criterion_report(options_for(""), TriangulateReport(), in_metres());
        CHECK(criterion_lines(report).empty());
        CHECK(criterion_metadata(report) == io::TinMetadata{{"TINWRIGHT_CRITERION", "delaunay"}});
        CHECK(criterion_json(report).text() == JsonValue::object().set("name", "delaunay").text());
        CHECK(criterion_metadata(read_criterion_report({{"author", "somebody"}})).empty());
    }

    TEST_CASE("JSON says false, not a text, where nothing is proven, and leaves out what is not there") {
        OptimizeReport result = sample_result();
        result.proof = Proof::None;
        result.after.interior.reset();
        const std::string text =
            criterion_json(make_criterion_report(options_for("slope"), with(result), in_metres())).text();
        CHECK(text.find("\"proven\": false") != std::string::npos);
        CHECK(text.find("\"worst_interior\":") == std::string::npos);
    }

    TEST_CASE("a job that was stopped is warned about, with what to do") {
        OptimizeReport result = sample_result();
        result.stopped_by = StoppedBy::Budget;
        CHECK(criterion_warnings(options_for("angle", "", "5"), with(result)) ==
              std::vector<std::string>{"the budget of 5 s ran out: the TIN is valid but its worst angle is "
                                       "not proven optimal; give a longer --budget"});
        result.stopped_by = StoppedBy::Interrupt;
        CHECK(criterion_warnings(options_for("height"), with(result)) ==
              std::vector<std::string>{"interrupted while optimising: the TIN is valid but its worst height "
                                       "is not proven optimal"});
        CHECK(criterion_warnings(options_for(""), TriangulateReport()).empty());
    }

    TEST_CASE("slopes are told as ratios, whatever the unit of z, and other measures as they are") {
        const CriterionReport slope =
            make_criterion_report(options_for("slope"), with(sample_result()), in_metres(), 0.25);
        CHECK(slope.worst == 4.5 / 4);
        CHECK(slope.worst_interior == 3.25 / 4);
        CHECK(slope.worst_delaunay == 12.25 / 4);
        CHECK(slope.worst_interior_delaunay == 8.5 / 4);
        CHECK(make_criterion_report(options_for("height"), with(sample_result()), in_metres(), 0.25).worst ==
              4.5);
        OptimizeReport without = sample_result();
        without.after.interior.reset();
        CHECK_FALSE(make_criterion_report(options_for("slope"), with(without), in_metres(), 0.25)
                        .worst_interior.has_value());
    }

    TEST_CASE("slopes are doubted where one unit of two is known") {
        CHECK(slope_warning(in_metres(), "metre").empty());
        CHECK(slope_warning(in_metres(), "foot").empty());  // both known: they are reconciled
        CHECK(slope_warning(nowhere(), "").empty());
        CHECK(slope_warning(in_metres(), "") ==
              "the unit of z is unknown; taken to be that of the CRS, metre, in slopes; --z-unit tells it");
        CHECK(slope_warning(nowhere(), "foot") ==
              "the CRS's unit is unknown; slopes take z, in foot, to be in it");
    }

    TEST_CASE("the criteria of slopes, and of creases, are about slopes") {
        CHECK(is_about_slopes(options_for("slope")));
        CHECK(is_about_slopes(options_for("normal-angle")));
        CHECK(is_about_slopes(options_for("normal-jump")));
        CHECK_FALSE(is_about_slopes(options_for("height")));
        CHECK_FALSE(is_about_slopes(options_for("")));
    }
}
