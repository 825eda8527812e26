#include "optimality_check.hpp"

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "command_check.hpp"
#include "support/messages.hpp"
#include "support/random_tins.hpp"
#include "support/tins.hpp"

namespace {

using namespace tinwright;
using namespace tinwright::tools;
using namespace tinwright_tests;

std::string complaint(const std::vector<std::string>& arguments) {
    return message_of<UsageError>([&] { CommandCheck().setup(arguments); });
}

OptimalityOptions options_of(std::vector<std::string> arguments) {
    CommandCheck command;
    arguments.emplace_back("a.gpkg");
    command.setup(arguments);
    return command.optimality;
}

/// A file's faces: the Delaunay TIN of random samples, and what it says about itself.
io::TinFile random_file(io::TinMetadata metadata) {
    Random random(3);
    const Tin tin = general_families().front().make(random, 120);
    io::TinFile file;
    for (std::uint32_t v = 0; v < tin.vertex_count(); ++v) {
        file.vertices.push_back(tin.position({v}));
    }
    for (const auto& face : terrain_of(tin.mesh)) {
        file.corners.insert(file.corners.end(), face.begin(), face.end());
        file.face_ids.push_back(static_cast<std::int64_t>(1000 + file.face_ids.size()));
    }
    file.layer = "faces";
    file.metadata = std::move(metadata);
    return file;
}

}  // namespace

TEST_SUITE("tools/optimality_check") {
    TEST_CASE("nothing is proven unless a criterion is given") {
        CHECK_FALSE(options_of({}).criterion.has_value());
        const OptimalityOptions usual = options_of({"--criterion", "height"});
        CHECK(usual.criterion == Criterion::Height);
        CHECK_FALSE(usual.worst.has_value());
        CHECK_FALSE(usual.all);
        CHECK(usual.reach == 100);
    }

    TEST_CASE("how many faces and how far is told") {
        CHECK(options_of({"--criterion", "slope", "--worst", "12"}).worst == 12);
        CHECK(options_of({"--criterion", "slope", "--all"}).all);
        CHECK(options_of({"--criterion", "slope", "--reach", "7"}).reach == 7);
        CHECK_FALSE(options_of({"--criterion", "slope", "--reach", "all"}).reach.has_value());
    }

    TEST_CASE("wrong command lines are refused with one line that says what to do") {
        CHECK(complaint({"a.gpkg", "--criterion", "delaunay"}) ==
              "--criterion takes slope, height, angle, eccentricity or length, not \"delaunay\"");
        for (const std::vector<std::string>& option :
             {std::vector<std::string>{"--worst", "5"}, {"--all"}, {"--reach", "5"}}) {
            CAPTURE(option.front());
            std::vector<std::string> arguments{"a.gpkg"};
            arguments.insert(arguments.end(), option.begin(), option.end());
            CHECK(complaint(arguments) ==
                  option.front() +
                      " is for --criterion: say which, slope, height, angle, eccentricity or length");
        }
        CHECK(complaint({"a.gpkg", "--criterion", "slope", "--worst", "5", "--all"}) ==
              "--worst and --all exclude each other");
        CHECK(complaint({"a.gpkg", "--criterion", "slope", "--worst", "0"}) ==
              "--worst needs a whole number from 1 up, not \"0\"");
        CHECK(complaint({"a.gpkg", "--criterion", "slope", "--worst", "many"}) ==
              "--worst needs a whole number from 1 up, not \"many\"");
        CHECK(complaint({"a.gpkg", "--criterion", "slope", "--reach", "1"}) ==
              "--reach (unless all) needs a whole number from 2 up, not \"1\"");
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"a.gpkg", "--norm", "l1"},
              {"a.gpkg", "--criterion", "slope", "--norm", "l1"}}) {
            CHECK(complaint(arguments) == "--norm says how edges are measured: it is for --criterion length");
        }
        CHECK(complaint({"a.gpkg", "--criterion", "length", "--norm", "l0"}) ==
              "--norm takes l1, l2, linf or lp:P with a whole number P from 1 to 64, not \"l0\"");
        for (const std::string option : {"--worst", "--reach"}) {
            CHECK(complaint({"a.gpkg", "--criterion", "length", option, "5"}) ==
                  option +
                      " does not apply to --criterion length, which is about the longest edge; --all looks "
                      "at polygons of any size");
        }
    }

    TEST_CASE("a hundred faces are examined where the file says nothing of a scope") {
        const OptimalityOptions options = options_of({"--criterion", "angle"});
        for (const io::TinMetadata& metadata :
             {io::TinMetadata{},
              {{"TINWRIGHT_CRITERION", "height"}, {"TINWRIGHT_SCOPE", "max"}},
              {{"TINWRIGHT_CRITERION", "angle"}, {"TINWRIGHT_SCOPE", "vector"}}}) {
            const OptimalityReport report = check_optimality(random_file(metadata), options, {});
            CHECK(report.certificate.faces == 100);
            CHECK(report.improvable() > 1);
            CHECK_FALSE(report.is_next_improvable);
        }
    }

    TEST_CASE("a promise of the worst face is broken by that face alone") {
        const io::TinMetadata promise{{"TINWRIGHT_CRITERION", "angle"}, {"TINWRIGHT_SCOPE", "top:1%"}};
        io::TinFile kite;
        kite.vertices = {{0, 10, 0}, {50, 0, 0}, {100, 10, 0}, {50, 30, 0}};
        kite.corners = {0, 1, 2, 0, 2, 3};
        kite.face_ids = {7, 8};
        kite.metadata = promise;
        const OptimalityReport broken = check_optimality(kite, options_of({"--criterion", "angle"}), {});
        CHECK(broken.certificate.faces == 1);
        REQUIRE(broken.improvable() == 1);
        CHECK(broken.listed.front().face == 7);

        const OptimalityReport all =
            check_optimality(random_file(promise), options_of({"--criterion", "angle", "--all"}), {});
        REQUIRE(all.listed.front().measure <
                all.certificate.worst.all);  // the worst face is as good as can be
        CHECK(all.certificate.faces == random_file(promise).face_ids.size());
        CHECK(all.listed.size() == all.improvable());
        const OptimalityReport kept =
            check_optimality(random_file(promise), options_of({"--criterion", "angle"}), {});
        CHECK(kept.improvable() == 0);
        CHECK(kept.is_next_improvable);
        CHECK(kept.certificate.faces < all.certificate.faces);
    }

    TEST_CASE("faces beyond the value of scope above are examined") {
        const OptimalityReport all =
            check_optimality(random_file({}), options_of({"--criterion", "angle", "--all"}), {});
        const double worst = all.certificate.worst.all;
        const auto examined = [](const std::string& value) {
            return check_optimality(
                       random_file({{"TINWRIGHT_CRITERION", "angle"}, {"TINWRIGHT_SCOPE", "above:" + value}}),
                       options_of({"--criterion", "angle"}), {})
                .certificate.faces;
        };
        CHECK(examined("180") == 0);
        CHECK(examined(std::to_string(worst - 1e-3)) == 1);
        CHECK(examined("60") == 100);
    }

    TEST_CASE("slopes are told, and a scope is taken, as ratios whatever the unit of z") {
        constexpr double kFactor = 0.25;
        const OptimalityOptions all = options_of({"--criterion", "slope", "--all"});
        const OptimalityReport plain = check_optimality(random_file({}), all, {});
        const OptimalityReport scaled = check_optimality(random_file({}), all, {}, kFactor);
        REQUIRE(plain.improvable() > 0);
        REQUIRE(scaled.improvable() == plain.improvable());
        CHECK(scaled.certificate.worst.all == kFactor * plain.certificate.worst.all);
        CHECK(scaled.certificate.worst.interior == kFactor * *plain.certificate.worst.interior);
        CHECK(scaled.listed.front().measure == kFactor * plain.listed.front().measure);
        CHECK(scaled.listed.front().improved == kFactor * plain.listed.front().improved);
        const double worst = plain.certificate.worst.all;
        const auto examined = [&](double value) {
            return check_optimality(random_file({{"TINWRIGHT_CRITERION", "slope"},
                                                 {"TINWRIGHT_SCOPE", "above:" + std::to_string(value)}}),
                                    options_of({"--criterion", "slope"}), {}, kFactor)
                .certificate.faces;
        };
        CHECK(examined(worst * kFactor * 1.001) == 0);
        CHECK(examined(worst * kFactor * 0.999) >= 1);
        CHECK(examined(0) == 100);
        const OptimalityOptions height = options_of({"--criterion", "height", "--all"});
        CHECK(check_optimality(random_file({}), height, {}, kFactor).certificate.worst.all ==
              check_optimality(random_file({}), height, {}).certificate.worst.all);
    }

    TEST_CASE("a TIN that was not finished is said to be so") {
        const OptimalityReport report = check_optimality(random_file({{"TINWRIGHT_CRITERION", "slope"},
                                                                      {"TINWRIGHT_SCOPE", "vector"},
                                                                      {"TINWRIGHT_STOPPED_BY", "budget"}}),
                                                         options_of({"--criterion", "slope"}), {});
        CHECK(optimality_verdict(report).ends_with("; the file says that it was not finished"));
    }

    // Of the rhombus one diagonal is short and one long.
    TEST_CASE("a longest edge that need not be so long is listed with the length that can be had") {
        io::TinFile rhombus;
        rhombus.vertices = {{0, 0, 0}, {50, -10, 0}, {100, 0, 0}, {50, 10, 0}};
        rhombus.corners = {0, 1, 2, 0, 2, 3};
        rhombus.face_ids = {7, 8};
        const OptimalityReport broken = check_optimality(rhombus, options_of({"--criterion", "length"}), {});
        REQUIRE(broken.length.has_value());
        CHECK(broken.improvable() == 1);
        CHECK(broken.listed.front().face == 7);
        CHECK(
            optimality_verdict(broken) ==
            "length, norm l2: the longest edge, 100 from (0, 0) to (100, 0), can be 50.9902 (no polygon had "
            "to be triangulated anew); the file does not tell that it was made for this criterion");
        CHECK(improvable_lines(broken, "a.gpkg") ==
              "a.gpkg: face 7: longest edge, 100 from (0, 0) to (100, 0), can be 50.9902\n");

        rhombus.corners = {0, 1, 3, 1, 2, 3};
        rhombus.metadata = {{"TINWRIGHT_CRITERION", "length"}, {"TINWRIGHT_NORM", "l1"}};
        const OptimalityReport kept = check_optimality(rhombus, options_of({"--criterion", "length"}), {});
        CHECK(kept.improvable() == 0);
        CHECK(improvable_lines(kept, "a.gpkg").empty());
        CHECK(optimality_verdict(kept).starts_with("length, norm l1: the longest edge, 60 from "));
        CHECK(kept.length->certificate.is_optimal);
        const OptimalityReport other =
            check_optimality(rhombus, options_of({"--criterion", "length", "--norm", "linf"}), {});
        CHECK(optimality_verdict(other).ends_with("; the file was made for norm l1"));
        CHECK(optimality_json(other).text().find("\"made_with\": \"l1\"") != std::string::npos);
    }
}
