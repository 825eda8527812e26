#include <variant>

#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "command_check.hpp"
#include "command_contour.hpp"
#include "command_explain.hpp"
#include "command_grid.hpp"
#include "command_info.hpp"
#include "command_sample.hpp"
#include "command_tin.hpp"

namespace {

using namespace tinwright;
using namespace tinwright::tools;

/// The message of the UsageError that a command line gives, or "fine".
template <class Made>
std::string complaint(const std::vector<std::string>& arguments) {
    Made command;
    try {
        command.setup(arguments);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "fine";
}

}  // namespace

TEST_SUITE("tools/setup") {
    TEST_CASE("tin knows its defaults") {
        CommandTin tin;
        tin.setup({"a.csv", "-o", "b.gpkg"});
        REQUIRE(tin.sources.sources.size() == 1);
        CHECK(tin.sources.sources[0].path == "a.csv");
        CHECK(tin.output.path == "b.gpkg");
        CHECK(tin.triangulation.domain.kind == DomainRule::Kind::Convex);
        CHECK(tin.triangulation.duplicates.policy == DuplicatePolicy::Error);
        CHECK(tin.triangulation.duplicates.tolerance == 0);
        CHECK(tin.triangulation.threads == 0);
        CHECK(tin.geometry == io::WriteTinOptions::Geometry::Polygon);
        CHECK_FALSE(tin.output.overwrite);
        CHECK_FALSE(tin.keep_ids);
    }

    TEST_CASE("grid trims the domain unless told otherwise") {
        CommandGrid grid;
        grid.setup({"a.csv", "-o", "b.tif"});
        CHECK(grid.triangulation.domain.kind == DomainRule::Kind::Trimmed);
        CHECK_FALSE(grid.raster.nodata.has_value());
        CHECK_FALSE(grid.raster.request.extent.has_value());
    }

    TEST_CASE("contour knows its defaults, and reads levels of either sign") {
        CommandContour contour;
        contour.setup({"a.csv", "-o", "b.gpkg", "--interval", "0.50", "--levels", "-5,0,7.25", "-nln", "c"});
        CHECK(contour.triangulation.domain.kind == DomainRule::Kind::Trimmed);
        CHECK(contour.contours.request.interval == 0.5);
        CHECK(contour.contours.request.base == 0);
        CHECK(contour.contours.request.levels == std::vector<double>{-5, 0, 7.25});
        CHECK_FALSE(contour.contours.is_bands);
        CHECK(contour.interpolation.is_linear());
        CHECK(contour.layer_name == "c");
        CHECK(contour.contours.canonical() == "--interval 0.5 --base 0 --levels -5,0,7.25");
    }

    TEST_CASE("contours need levels that make sense") {
        const auto of_contours = [](std::vector<std::string> arguments) {
            arguments.insert(arguments.begin(), {"a.csv", "-o", "b.gpkg"});
            return complaint<CommandContour>(arguments);
        };
        CHECK(of_contours({"--interval", "5", "--base", "-2.5", "--index", "4"}) == "fine");
        CHECK(of_contours({"--levels", "5"}) == "fine");
        CHECK(of_contours({"--interval", "5", "--method", "smooth", "--tolerance", "0.1"}) == "fine");
        CHECK(of_contours({}) == "which contours? Give --interval or --levels");
        CHECK(of_contours({"--interval", "-5"}) == "--interval needs a number above zero, not \"-5\"");
        CHECK(of_contours({"--interval", "nan"}) == "--interval needs a number above zero, not \"nan\"");
        CHECK(of_contours({"--levels", "5,,6"}) == "--levels needs a number, not \"\"");
        CHECK(of_contours({"--levels", "5,inf"}) == "--levels needs a number, not \"inf\"");
        CHECK(of_contours({"--levels", "5", "--base", "1"}) ==
              "--base is where the levels of --interval start: give --interval too");
        CHECK(of_contours({"--levels", "5", "--index", "5"}) ==
              "--index counts the lines of --interval: give --interval too");
        CHECK(of_contours({"--interval", "5", "--index", "0"}) ==
              "--index needs a whole number from 1 up, not \"0\"");
        CHECK(of_contours({"--interval", "5", "--index", "5", "--polygons"}) ==
              "--index marks lines: it does not go with --polygons");
        CHECK(of_contours({"--interval", "5", "--tolerance", "1"}) ==
              "--tolerance is for surfaces that are traced: lines of --method linear are exact");
        CHECK(of_contours({"--interval", "5", "--method", "nearest"}) ==
              "--method nearest has steps and no slopes: contours need another method");
    }

    TEST_CASE("options and sources come in any order") {
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"a.csv", "b.csv", "-o", "d.tif", "-tr", "2", "-te", "0", "1", "2",
                                       "3"},
              {"-tr", "2", "a.csv", "-te", "0", "1", "2", "3", "b.csv", "-o", "d.tif"},
              {"-o", "d.tif", "-te", "0", "1", "2", "3", "-tr", "2", "a.csv", "b.csv"},
              {"--output=d.tif", "a.csv", "--extent=0", "1", "2", "3", "b.csv", "--resolution=2"}}) {
            CAPTURE(arguments.front());
            CommandGrid grid;
            grid.setup(arguments);
            REQUIRE(grid.sources.sources.size() == 2);
            CHECK(grid.sources.sources[1].path == "b.csv");
            CHECK(grid.output.path == "d.tif");
            CHECK(grid.raster.request.resolution == Point2{2, 2});
            CHECK(grid.raster.request.extent == Box{0, 1, 2, 3});
        }
    }

    TEST_CASE("every list option takes exactly one value each time") {
        CommandTin tin;
        tin.setup({"--co", "A=1", "a.csv", "--lco", "B=2", "b.csv", "--co", "C=3", "--oo", "D=4", "c.csv",
                   "-o", "o.gpkg"});
        CHECK(tin.sources.texts == std::vector<std::string>{"a.csv", "b.csv", "c.csv"});
        CHECK(tin.output.creation_options == std::vector<std::string>{"A=1", "C=3"});
        CHECK(tin.layer_options == std::vector<std::string>{"B=2"});
        CHECK(tin.sources.sources[2].open_options == std::vector<std::string>{"D=4"});
    }

    TEST_CASE("numbers may be negative") {
        CommandGrid grid;
        grid.setup({"a.csv", "-o", "b.tif", "--extent", "-10", "-20.5", "-.5", "6e1", "--nodata", "-9999",
                    "-tr", ".5", "2"});
        CHECK(grid.raster.request.extent == Box{-10, -20.5, -0.5, 60});
        CHECK(grid.raster.nodata == -9999.0);
        CHECK(grid.raster.request.resolution == Point2{0.5, 2});
    }

    TEST_CASE("what follows two dashes is a source") {
        CommandGrid grid;
        grid.setup({"-o", "b.tif", "--", "-tap", "--like"});
        CHECK(grid.sources.texts == std::vector<std::string>{"-tap", "--like"});
        CHECK_FALSE(grid.raster.tap);
    }

    TEST_CASE("domains, policies and tolerances are read and written back canonically") {
        CommandTin tin;
        tin.setup({"a.csv", "-o", "b.gpkg", "--duplicate-tolerance", "0.010", "--max-edge", "8e1", "--domain",
                   "concave:50.0", "--duplicates", "mean", "-j", "3", "-v"});
        CHECK(tin.triangulation.domain.kind == DomainRule::Kind::Concave);
        CHECK(tin.triangulation.domain.length == 50);
        CHECK(tin.triangulation.threads == 3);
        CHECK(tin.triangulation.canonical() ==
              "--criterion delaunay --domain concave:50 --max-edge 80 --duplicates mean "
              "--duplicate-tolerance 0.01");
    }

    TEST_CASE("a TIN is Delaunay unless a criterion is given, whose worst faces are then improved") {
        CommandTin tin;
        tin.setup({"a.csv", "-o", "b.gpkg"});
        CHECK_FALSE(tin.triangulation.optimize.has_value());
        CHECK(tin.triangulation.criterion_name() == "delaunay");
        CHECK(tin.triangulation.canonical() == "--criterion delaunay --domain convex --duplicates error");
        for (const Criterion criterion : kInsertionCriteria) {
            const std::string name(criterion_traits(criterion).name);
            CAPTURE(name);
            CommandGrid grid;
            grid.setup({"a.csv", "-o", "b.tif", "--criterion", name});
            REQUIRE(grid.triangulation.optimize.has_value());
            CHECK(grid.triangulation.optimize->criterion == criterion);
            CHECK(grid.triangulation.optimize->scope.kind == Scope::Kind::Top);
            CHECK(grid.triangulation.optimize->scope.value == 0.5);
            CHECK_FALSE(grid.triangulation.optimize->budget_seconds.has_value());
            CHECK(grid.triangulation.canonical() ==
                  "--criterion " + name + " --scope top:0.5% --domain trimmed --duplicates error");
        }
    }

    TEST_CASE("scopes and budgets are read and written back canonically") {
        const auto scope = [](const std::string& criterion, const std::string& text) {
            CommandInfo info;
            info.setup({"a.csv", "--criterion", criterion, "--scope", text});
            return info.triangulation.scope_name();
        };
        CHECK(scope("slope", "max") == "max");
        CHECK(scope("slope", "vector") == "vector");
        CHECK(scope("slope", "top:1.50%") == "top:1.5%");
        CHECK(scope("slope", "top:100") == "top:100%");
        CHECK(scope("slope", "above:0") == "above:0");
        CHECK(scope("angle", "above:1.2e2") == "above:120");
        CHECK(scope("height", "above:.25") == "above:0.25");
        CHECK(scope("eccentricity", "above:1000") == "above:1000");
        CommandTin tin;
        tin.setup({"a.csv", "-o", "b.gpkg", "--budget", "0.50", "--criterion", "slope", "--scope", "max"});
        CHECK(tin.triangulation.optimize->budget_seconds == 0.5);
        CHECK(tin.triangulation.canonical() ==
              "--criterion slope --scope max --budget 0.5 --domain convex --duplicates error");
    }

    TEST_CASE("scopes and budgets that make no sense are refused") {
        const auto tin = [](const std::string& criterion, std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b", "--criterion", criterion});
            return complaint<CommandTin>(more);
        };
        for (const std::string text : {"all", "top", "top 5%", "maximum", "Max", "above"}) {
            CAPTURE(text);
            CHECK(tin("slope", {"--scope", text}) ==
                  "--scope takes max, vector, top:P% or above:VALUE, not \"" + text + "\"");
        }
        for (const std::string share : {"", "%", "0", "-1%", "100.1%", "nan", "inf", "5%%", "5 %"}) {
            CAPTURE(share);
            CHECK(tin("slope", {"--scope", "top:" + share}) ==
                  "--scope top:P% needs a number above 0 and up to 100, not \"" + share + "\"");
        }
        CHECK(tin("slope", {"--scope", "above:-1"}) ==
              "--scope above:VALUE needs a number from 0 up, not \"-1\"");
        CHECK(tin("slope", {"--scope", "above:steep"}) ==
              "--scope above:VALUE needs a number, not \"steep\"");
        CHECK(tin("height", {"--scope", "above:0"}) ==
              "--scope above:VALUE needs a number above zero, not \"0\"");
        CHECK(tin("angle", {"--scope", "above:2.5"}) ==
              "--scope above:VALUE needs degrees from 60 to 180, not \"2.5\"");
        CHECK(tin("angle", {"--budget", "0"}) == "--budget needs a number above zero, not \"0\"");
        CHECK(tin("angle", {"--budget", "5s"}) == "--budget needs a number above zero, not \"5s\"");
        CHECK(tin("delaunay", {"--scope", "max"}) ==
              "--scope is for optimising: give --criterion slope, height, angle or eccentricity too");
        CHECK(
            complaint<CommandGrid>({"a.csv", "-o", "b.tif", "--budget", "5"}) ==
            "--budget is for optimising: give --criterion slope, height, angle, eccentricity or length too");
    }

    TEST_CASE("length has a norm, and no scope but the longest edge") {
        const auto canonical = [](std::vector<std::string> more) {
            CommandTin tin;
            more.insert(more.begin(), {"a.csv", "-o", "b.gpkg", "--criterion", "length"});
            tin.setup(more);
            return tin.triangulation.canonical();
        };
        const std::string rest = " --domain convex --duplicates error";
        CHECK(canonical({}) == "--criterion length --norm l2 --scope max" + rest);
        CHECK(canonical({"--scope", "max", "--norm", "l1"}) ==
              "--criterion length --norm l1 --scope max" + rest);
        CHECK(canonical({"--norm", "linf", "--budget", "2"}) ==
              "--criterion length --norm linf --scope max --budget 2" + rest);
        CHECK(canonical({"--norm", "lp:3"}) == "--criterion length --norm lp:3 --scope max" + rest);
        CHECK(canonical({"--norm", "lp:2"}) == "--criterion length --norm l2 --scope max" + rest);
        CHECK(canonical({"--norm", "lp:64"}) == "--criterion length --norm lp:64 --scope max" + rest);
        CommandGrid grid;
        grid.setup({"a.csv", "-o", "b.tif", "--criterion", "length", "--norm", "l1"});
        REQUIRE(grid.triangulation.optimize.has_value());
        CHECK(grid.triangulation.optimize->criterion == Criterion::Length);
        CHECK(grid.triangulation.optimize->norm == Norm::lp(1));
        CHECK(grid.triangulation.optimize->scope.kind == Scope::Kind::Max);
    }

    TEST_CASE("norms and scopes that make no sense are refused") {
        const auto refusal = [](std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b"});
            return complaint<CommandTin>(more);
        };
        for (const std::string norm :
             {"l3", "lp", "lp:", "lp:0", "lp:65", "lp:2.5", "lp:-1", "L2", "euclid"}) {
            CAPTURE(norm);
            CHECK(refusal({"--criterion", "length", "--norm", norm}) ==
                  "--norm takes l1, l2, linf or lp:P with a whole number P from 1 to 64, not \"" + norm +
                      "\"");
        }
        for (const std::string criterion : {"delaunay", "slope", "normal-angle"}) {
            CAPTURE(criterion);
            CHECK(refusal({"--criterion", criterion, "--norm", "l2"}) ==
                  "--norm says how edges are measured: it is for --criterion length, and for --graph mst and "
                  "rng of tinwright tin");
        }
        for (const std::string scope : {"vector", "top:5%", "above:10"}) {
            CAPTURE(scope);
            CHECK(
                refusal({"--criterion", "length", "--scope", scope}) ==
                "--scope " + scope +
                    " does not apply to --criterion length, which makes the longest edge as short as it can "
                    "be and knows no order of the others: leave --scope out, or give max");
        }
        CHECK(
            refusal({"--budget", "5"}) ==
            "--budget is for optimising: give --criterion slope, height, angle, eccentricity or length too");
    }

    TEST_CASE("a graph is told by its name and norm") {
        const auto canonical = [](std::vector<std::string> more) {
            CommandTin tin;
            more.insert(more.begin(), {"a.csv", "-o", "b.gpkg"});
            tin.setup(more);
            return tin.graph.canonical() + " " + tin.triangulation.canonical_samples();
        };
        CHECK(canonical({"--graph", "mst"}) == "--graph mst --norm l2 --duplicates error");
        CHECK(canonical({"--graph", "rng", "--norm", "lp:1", "--duplicates", "mean"}) ==
              "--graph rng --norm l1 --duplicates mean");
        CHECK(canonical({"--graph", "gabriel", "--norm", "l2"}) ==
              "--graph gabriel --norm l2 --duplicates error");
        CommandTin tin;
        tin.setup({"a.csv", "-o", "b.gpkg"});
        CHECK_FALSE(tin.graph.kind.has_value());
    }

    TEST_CASE("a graph takes no options of TINs") {
        const auto refusal = [](std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b.gpkg", "--graph", "rng"});
            return complaint<CommandTin>(more);
        };
        CHECK(refusal({"--norm", "linf", "--duplicates", "mean", "--nln", "near", "--co", "A=1", "-j",
                       "2"}) == "fine");
        for (const std::vector<std::string>& option : {std::vector<std::string>{"--criterion", "length"},
                                                       {"--scope", "max"},
                                                       {"--delaunay-order", "2"},
                                                       {"--budget", "5"},
                                                       {"--domain", "trimmed"},
                                                       {"--max-edge", "5"},
                                                       {"--breaklines", "b.gpkg"},
                                                       {"--boundary", "b.gpkg"},
                                                       {"--holes", "b.gpkg"},
                                                       {"--constraints", "conforming"},
                                                       {"--snap", "1"},
                                                       {"--conflicts", "c.gpkg"},
                                                       {"--geometry", "polygon"},
                                                       {"--ids"}}) {
            CAPTURE(option.front());
            CHECK(refusal(option) ==
                  "--graph writes lines between samples, and no TIN: " + option.front() + " does not apply");
        }
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b.gpkg", "--graph", "urquhart"}) ==
              "--graph takes mst, rng or gabriel, not \"urquhart\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b.gpkg", "--graph", "gabriel", "--norm", "l1"}) ==
              "--graph gabriel is defined by Euclidean disks: --norm l1 is for --graph mst and rng");
        CHECK(complaint<CommandTin>({"-o", "b.gpkg", "--graph", "mst"}) ==
              "no source is given: name a file with points, such as survey.csv");
        CHECK(complaint<CommandTin>({"a.csv", "--graph", "mst"}) ==
              "no output is given: name it with -o FILE");
    }

    TEST_CASE("data-dependent criteria have an order and no scope") {
        const auto canonical = [](std::vector<std::string> more) {
            CommandTin tin;
            more.insert(more.begin(), {"a.csv", "-o", "b.gpkg"});
            tin.setup(more);
            return tin.triangulation.canonical();
        };
        const std::string rest = " --domain convex --duplicates error";
        CHECK(canonical({"--criterion", "normal-angle"}) ==
              "--criterion normal-angle --delaunay-order 3" + rest);
        CHECK(canonical({"--criterion", "normal-jump", "--delaunay-order", "none", "--budget", "2"}) ==
              "--criterion normal-jump --delaunay-order none --budget 2" + rest);
        CHECK(canonical({"--criterion", "normal-jump", "--delaunay-order", "0"}) ==
              "--criterion normal-jump --delaunay-order 0" + rest);
        const auto refusal = [](std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b"});
            return complaint<CommandTin>(more);
        };
        CHECK(refusal({"--criterion", "normal-angle", "--scope", "max"}) ==
              "--scope does not apply to --criterion normal-angle, a sum over all edges; --delaunay-order "
              "limits its flips");
        for (const std::string criterion : {"slope", "delaunay"}) {
            CHECK(refusal({"--criterion", criterion, "--delaunay-order", "1"}) ==
                  "--delaunay-order is for flips: give --criterion normal-angle or normal-jump too");
        }
        CHECK(refusal({"--criterion", "normal-jump", "--delaunay-order", "-1"}) ==
              "--delaunay-order needs a whole number from 0 up, not \"-1\"");
        CHECK(
            complaint<CommandCheck>({"a.gpkg", "--criterion", "normal-jump"}) ==
            "--criterion normal-jump makes a TIN by a heuristic, of which there is nothing to prove; slope, "
            "height, angle, eccentricity and length can be proven");
    }

    TEST_CASE("info counts conflicts instead of failing on them") {
        CommandInfo info;
        info.setup({"a.csv"});
        CHECK(info.triangulation.duplicates.policy == DuplicatePolicy::Mean);
    }

    TEST_CASE("wrong command lines are refused with one line that says what to do") {
        CHECK(complaint<CommandTin>({}) == "no source is given: name a file with points, such as survey.csv");
        CHECK(complaint<CommandTin>({"a.csv"}) == "no output is given: name it with -o FILE");
        CHECK(complaint<CommandTin>({"a.csv", "-o"}) == "--output needs FILE; see \"tinwright tin --help\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "-o", "c"}) == "--output is given more than once");
        CHECK(complaint<CommandTin>({"a.csv", "--foo", "-o", "b"}) ==
              "unknown option \"--foo\"; see \"tinwright tin --help\"");
        CHECK(complaint<CommandTin>({"a.csv", "--f\too", "-o", "b"}) ==
              "unknown option \"--f\\too\"; see \"tinwright tin --help\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--domain", "round"}) ==
              "--domain takes convex, trimmed or concave:LENGTH, not \"round\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--domain", "concave:-1"}) ==
              "--domain concave:LENGTH needs a number above zero, not \"-1\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--criterion", "weight"}) ==
              "--criterion takes delaunay, slope, height, angle, eccentricity, length, normal-angle or "
              "normal-jump, not \"weight\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--duplicates", "any"}) ==
              "--duplicates takes error, first, last, min, max, mean or median, not \"any\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--duplicate-tolerance", "-1"}) ==
              "--duplicate-tolerance needs a number from 0 up, not \"-1\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--max-edge", "0"}) ==
              "--max-edge needs a number above zero, not \"0\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "-j", "-1"}) ==
              "--threads needs a whole number from 0 up, not \"-1\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--geometry", "mesh"}) ==
              "--geometry takes polygon, tin, edges or vertices, not \"mesh\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--lco", "FID"}) ==
              "--lco needs KEY=VALUE, not \"FID\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--oo", "FID"}) ==
              "--oo needs KEY=VALUE, not \"FID\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--tap"}) ==
              "unknown option \"--tap\"; see \"tinwright tin --help\"");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "-q", "-v"}) ==
              "--quiet and --verbose exclude each other");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "b", "--progress", "--no-progress"}) ==
              "--progress and --no-progress exclude each other");
    }

    TEST_CASE("contradictions about the raster are refused") {
        const auto grid = [](std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b.tif"});
            return complaint<CommandGrid>(more);
        };
        CHECK(grid({"--extent", "0", "0", "1"}) ==
              "--extent needs X0 Y0 X1 Y1; see \"tinwright grid --help\"");
        CHECK(grid({"--extent", "0", "0", "1", "x"}) == "--extent needs a number, not \"x\"");
        CHECK(grid({"--extent", "5", "0", "1", "1"}) ==
              "--extent takes XMIN YMIN XMAX YMAX with XMIN below XMAX and YMIN below YMAX, not 5 0 1 1");
        CHECK(grid({"--size", "0", "10"}) == "--size needs a whole number from 1 up, not \"0\"");
        CHECK(grid({"--resolution", "-1"}) == "--resolution needs a number above zero, not \"-1\"");
        CHECK(grid({"--resolution", "1", "0"}) == "--resolution needs a number above zero, not \"0\"");
        CHECK(grid({"--nodata", "none"}) == "--nodata needs a number, not \"none\"");
        CHECK(grid({"--tap"}) == "--tap needs --resolution: edges are put at multiples of it");
        CHECK(grid({"--like", "c.tif", "-tr", "1"}) ==
              "--like brings its own geometry: --extent, --resolution, --size and --tap cannot be added");
        CHECK(grid({"--preview", "b.tif"}) == "--preview and -o name the same file \"b.tif\"");
        CHECK(grid({"--nodata", "nan"}) == "fine");
    }

    TEST_CASE("methods and products are told by name, and their options belong to them") {
        const auto grid = [](std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b.tif"});
            return complaint<CommandGrid>(more);
        };
        CHECK(grid({"--method", "spline"}) ==
              "--method takes linear, nearest, natural-neighbor, natural-neighbor:laplace, "
              "natural-neighbor:c1, clough-tocher, clough-tocher:limit, smooth or smooth:c1, not \"spline\"");
        CHECK(grid({"--gradients", "ring"}) ==
              "--gradients is for the methods natural-neighbor:c1 and clough-tocher, not for linear");
        CHECK(grid({"--method", "clough-tocher", "--gradients", "ring"}) == "fine");
        CHECK(grid({"--smooth-guard", "none"}) ==
              "--smooth-guard is for the methods smooth and smooth:c1, not for linear");
        CHECK(grid({"--method", "smooth", "--smooth-kernels", "1.5,,1"}) ==
              "--smooth-kernels takes kernels EXPONENT[xSTRETCH[*HANDICAP]] with commas between, as "
              "1.5,1x4*1.04,2.5, not \"\"");
        CHECK(grid({"--method", "smooth", "--smooth-kernels", "1.5,1x4*1.04", "--smooth-guard", "none"}) ==
              "fine");
        CHECK(grid({"--product", "slope,height"}) ==
              "--product takes elevation, slope, aspect, gradient, hillshade, nearest-distance or face-id, "
              "with commas between several, not \"height\"");
        CHECK(grid({"--product", "slope,aspect", "--product", "slope"}) == "--product names slope twice");
        CHECK(grid({"--slope-unit", "percent"}) == "--slope-unit is for --product slope");
        CHECK(grid({"--product", "slope", "--slope-unit", "rise"}) ==
              "--slope-unit takes degree, percent or ratio, not \"rise\"");
        CHECK(grid({"--z-factor", "2"}) ==
              "--z-factor is for --product slope, gradient, aspect and hillshade");
        CHECK(grid({"--product", "slope", "--azimuth", "0"}) == "--azimuth is for --product hillshade");
        CHECK(grid({"--product", "hillshade", "--altitude", "91"}) ==
              "--altitude takes degrees above 0 and up to 90, not 91");
        CHECK(grid({"--product", "slope", "--preview", "c.png"}) ==
              "--preview shades elevations: let --product begin with elevation");
    }

    TEST_CASE("how a surface is read is written back canonically: what is usual goes without saying") {
        const auto canonical = [](std::vector<std::string> more) {
            more.insert(more.begin(), {"a.csv", "-o", "b.tif"});
            CommandGrid grid;
            grid.setup(more);
            return grid.interpolation.canonical() + grid.products.canonical();
        };
        CHECK(canonical({}) == "--method linear");
        CHECK(canonical({"--method", "clough-tocher", "--gradients", "octant"}) == "--method clough-tocher");
        CHECK(canonical({"--method", "clough-tocher", "--gradients", "ring"}) ==
              "--method clough-tocher --gradients ring");
        CHECK(canonical({"--method", "smooth", "--smooth-guard", ".250", "--smooth-neighbors", "24"}) ==
              "--method smooth");
        CHECK(
            canonical({"--method", "smooth", "--smooth-kernels", "01.50x1,1x4,2.5x1*1.10,3", "--smooth-guard",
                       "none", "--smooth-neighbors", "30"}) ==
            "--method smooth --smooth-kernels 1.5,1x4,2.5x1*1.1,3 --smooth-neighbors 30 --smooth-guard none");
        CHECK(canonical({"--product", "slope,hillshade", "--slope-unit", "degree", "--z-factor", "0.30",
                         "--azimuth", "315.0", "--altitude", "30."}) ==
              "--method linear --product slope,hillshade --z-factor 0.3 --altitude 30");
    }

    TEST_CASE("a name with {product} stands for a file each") {
        CommandGrid command;
        command.setup({"a.csv", "-o", "out_{product}.tif", "--product", "elevation,gradient"});
        CHECK(command.products.targets(command.output.path) ==
              std::vector<std::string>{"out_elevation.tif", "out_gradient_x.tif", "out_gradient_y.tif"});
        CHECK(command.products.canonical() == " --product elevation,gradient");
        CHECK(command.products.targets("one.tif") == std::vector<std::string>{"one.tif"});
    }

    TEST_CASE("standard output has one user") {
        CHECK(complaint<CommandTin>({"a.csv", "-o", "/vsistdout/", "--json"}) ==
              "--json and the output both want standard output: write the output to a file");
        CHECK(complaint<CommandCheck>({"a.gpkg", "-o", "/vsistdout/x.csv", "--json"}) ==
              "--json and the output both want standard output: write the output to a file");
        CHECK(complaint<CommandTin>({"a.csv", "-o", "/vsistdout/"}) == "fine");
    }

    TEST_CASE("a source is never the output, by whatever name") {
        const std::vector<io::Source> sources{io::parse_source("a.csv")};
        CHECK_THROWS_WITH_AS(
            refuse_to_overwrite_sources("a.csv", sources),
            "the output \"a.csv\" is also read: choose another name, a source is never overwritten",
            UsageError);
        CHECK_NOTHROW(refuse_to_overwrite_sources("b.csv", sources));
    }

    TEST_CASE("lines have roles, in any number, and defaults") {
        CommandTin tin;
        tin.setup({"a.csv", "--holes", "h.gpkg", "--breaklines", "b.gpkg,layer=ditch,z=drape", "--boundary",
                   "o.gpkg", "--breaklines", "c.shp,across=smooth", "--oo", "A=1", "-o", "t.gpkg"});
        REQUIRE(tin.lines.sources.size() == 4);
        CHECK(tin.lines.sources[0].source.path == "b.gpkg");
        CHECK(tin.lines.sources[0].source.z == "drape");
        CHECK(tin.lines.sources[0].source.open_options == std::vector<std::string>{"A=1"});
        CHECK(tin.lines.sources[1].source.across == "smooth");
        CHECK(tin.lines.sources[1].role == LineRole::Breakline);
        CHECK(tin.lines.sources[2].role == LineRole::Boundary);
        CHECK(tin.lines.sources[3].role == LineRole::Hole);
        CHECK_FALSE(tin.lines.conforming.has_value());
        CHECK(tin.lines.noding.snap == 0);
        CHECK(tin.lines.noding.crossing_z == CrossingPolicy::Error);
        CHECK(tin.lines.noding.crossing_tolerance == 0);
        CHECK(tin.lines.line_tolerance == 0);
        CHECK(tin.lines.canonical() == " --constraints constrained --crossing-z error");
        CommandTin plain;
        plain.setup({"a.csv", "-o", "t.gpkg"});
        CHECK(plain.lines.canonical().empty());
        CHECK(plain.lines.first_given().empty());
    }

    TEST_CASE("options of lines are read and written back canonically") {
        CommandGrid grid;
        grid.setup({"a.csv",      "--breaklines",
                    "b.gpkg",     "--max-steiner",
                    "500",        "--constraints",
                    "conforming", "--conforming-method",
                    "blocking",   "--snap",
                    "0.10",       "--crossing-z",
                    "mean",       "--crossing-tolerance",
                    "5e-2",       "--line-tolerance",
                    "2",          "--conflicts",
                    "c.gpkg",     "-o",
                    "d.tif"});
        TriangulateOptions options;
        grid.lines.apply_to(options);
        REQUIRE(options.conforming.has_value());
        CHECK(options.conforming->method == ConformingMethod::Blocking);
        CHECK(options.conforming->max_steiner == 500);
        CHECK(options.noding.snap == 0.1);
        CHECK(options.noding.crossing_z == CrossingPolicy::Mean);
        CHECK(options.noding.crossing_tolerance == 0.05);
        CHECK(options.line_tolerance == 2);
        CHECK(grid.lines.conflicts == "c.gpkg");
        CHECK(grid.lines.canonical() ==
              " --constraints conforming --conforming-method blocking --max-steiner 500 --snap 0.1 "
              "--crossing-z mean --crossing-tolerance 0.05");
    }

    TEST_CASE("breaklines may do without samples") {
        CHECK(complaint<CommandTin>({"--breaklines", "b.gpkg", "-o", "t.gpkg"}) == "fine");
        CHECK(complaint<CommandTin>({"--boundary", "b.gpkg", "-o", "t.gpkg"}) ==
              "no source is given: name a file with points, such as survey.csv");
    }

    TEST_CASE("options of lines that cannot be are named with what is wrong") {
        const auto of_lines = [](std::vector<std::string> arguments) {
            arguments.insert(arguments.end(), {"a.csv", "--breaklines", "b.gpkg", "-o", "t.gpkg"});
            return complaint<CommandTin>(arguments);
        };
        CHECK(of_lines({"--constraints", "loose"}) ==
              "--constraints takes constrained or conforming, not \"loose\"");
        CHECK(of_lines({"--conforming-method", "split"}) ==
              "--conforming-method is for a conforming TIN: give --constraints conforming too");
        CHECK(of_lines({"--constraints", "constrained", "--max-steiner", "5"}) ==
              "--max-steiner is for a conforming TIN: give --constraints conforming too");
        CHECK(of_lines({"--constraints", "conforming", "--conforming-method", "best"}) ==
              "--conforming-method takes split or blocking, not \"best\"");
        CHECK(of_lines({"--constraints", "conforming", "--max-steiner", "0"}) ==
              "--max-steiner needs a whole number from 1 up, not \"0\"");
        CHECK(of_lines({"--crossing-z", "median"}) ==
              "--crossing-z takes error, mean, first, min or max, not \"median\"");
        for (const std::string option : {"--snap", "--crossing-tolerance", "--line-tolerance"}) {
            CHECK(of_lines({option, "-1"}) == option + " needs a number from 0 up, not \"-1\"");
            CHECK(of_lines({option, "near"}) == option + " needs a number, not \"near\"");
            CHECK(complaint<CommandTin>({"a.csv", "-o", "t.gpkg", option, "1"}) ==
                  option + " is for lines: give --breaklines, --boundary or --holes too");
        }
        CHECK(complaint<CommandTin>({"a.csv", "-o", "t.gpkg", "--constraints", "conforming"}) ==
              "--constraints is for lines: give --breaklines, --boundary or --holes too");
        CHECK(of_lines({"--conflicts", "t.gpkg"}) == "--conflicts and -o name the same file \"t.gpkg\"");
        CHECK(complaint<CommandGrid>({"a.csv", "--holes", "h.gpkg", "-o", "d.tif", "--preview", "p.png",
                                      "--conflicts", "p.png"}) ==
              "--conflicts and --preview name the same file \"p.png\"");
        CHECK(of_lines({"--boundary", ",layer=a"}) ==
              R"(source ",layer=a": the path is missing; write PATH[,key=value...])");
    }

    TEST_CASE("sample takes places as sources and as coordinates, negative ones too") {
        CommandSample sample;
        sample.setup({"a.csv", "--at", "-1,2", "--at", "p.gpkg,layer=q", "--at=-.5,-1e3", "--step", "2.50"});
        REQUIRE(sample.sample.at.size() == 3);
        CHECK(std::get<Point2>(sample.sample.at[0]) == Point2{-1, 2});
        CHECK(std::get<io::Source>(sample.sample.at[1]).layer == "q");
        CHECK(std::get<Point2>(sample.sample.at[2]) == Point2{-0.5, -1000});
        CHECK(sample.sample.step == 2.5);
        CHECK(sample.sample.slope_unit == SlopeUnit::Degree);
        CHECK(sample.triangulation.domain.kind == DomainRule::Kind::Trimmed);
        CHECK(sample.output.path.empty());
        CHECK(sample.sources.sources.size() == 1);
    }

    TEST_CASE("sample says what is wrong with its command line") {
        const std::vector<std::string> base{"a.csv", "--at", "1,2"};
        const auto with = [&](std::vector<std::string> more) {
            more.insert(more.begin(), base.begin(), base.end());
            return complaint<CommandSample>(more);
        };
        CHECK(complaint<CommandSample>({"a.csv"}) ==
              "where to read the surface is not said: --at FILE names points or lines, --at X,Y a position");
        CHECK(complaint<CommandSample>({"--at", "1,2"}) ==
              "no source is given: name a file with points, such as survey.csv");
        CHECK(complaint<CommandSample>({"a.csv", "--at", "nan,2"}) ==
              "--at needs two finite numbers X,Y, not \"nan,2\"");
        CHECK(with({"--step", "0"}) == "--step needs a number above zero, not \"0\"");
        CHECK(with({"--slope-unit", "grad"}) == "--slope-unit takes degree, percent or ratio, not \"grad\"");
        CHECK(with({"--plot", "p.pdf"}) == "--plot writes .svg and .png, not \"p.pdf\"");
        CHECK(with({"--plot", "p.svg", "-o", "p.svg"}) == "--plot and -o name the same file \"p.svg\"");
        CHECK(with({"--json"}) ==
              "--json and the output both want standard output: write the output to a file");
        CHECK(with({"--of", "GPKG"}) ==
              "only CSV goes to standard output, not GPKG: name a file with -o FILE");
        CHECK(with({"-o", "-"}) == "fine");
        CHECK(with({"-o", "x.csv", "--json"}) == "fine");
    }

    TEST_CASE("explain takes its place last, or by --at") {
        for (const std::vector<std::string>& arguments : {std::vector<std::string>{"a.csv", "-3.5,4"},
                                                          {"-3.5,4", "a.csv"},
                                                          {"a.csv", "--at", "-3.5,4"},
                                                          {"--at=-3.5,4", "a.csv", "--json"}}) {
            CAPTURE(arguments.front());
            CommandExplain explain;
            explain.setup(arguments);
            CHECK(explain.at == Point2{-3.5, 4});
            REQUIRE(explain.sources.sources.size() == 1);
            CHECK(explain.sources.sources[0].path == "a.csv");
        }
        CommandExplain explain;
        explain.setup({"a.csv", "b.csv", "1, 2"});
        CHECK(explain.at == Point2{1, 2});
        CHECK(explain.sources.sources.size() == 2);
        CHECK(complaint<CommandExplain>({"a.csv"}) == "no place is given: name it as X,Y after the sources");
        CHECK(complaint<CommandExplain>({"a.csv", "--at", "here"}) ==
              "a place is two numbers X,Y, not \"here\"");
        CHECK(complaint<CommandExplain>({"1,2"}) ==
              "no source is given: name a file with points, such as survey.csv");
        CHECK(complaint<CommandExplain>({"a.csv", "--at", "1,2", "--at", "2,3"}) ==
              "one place is explained at a time: give X,Y once");
        CHECK(complaint<CommandExplain>({"a.csv", "inf,2"}) ==
              "--at needs two finite numbers X,Y, not \"inf,2\"");
    }
}
