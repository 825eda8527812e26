#include <doctest/doctest.h>

#include "tinwright/geometry/error.hpp"

#include "command_grid.hpp"
#include "command_hydro.hpp"
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

std::string of_tin(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"a.csv", "-o", "b.gpkg"});
    return complaint<CommandTin>(arguments);
}

LineOptions lines_with(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"a.csv", "-o", "b.gpkg"});
    CommandTin tin;
    tin.setup(arguments);
    return tin.lines;
}

}  // namespace

TEST_SUITE("tools/setup_water") {
    TEST_CASE("water joins the lines, each source with its role") {
        const LineOptions lines =
            lines_with({"--rivers", "r.gpkg,z=drape", "--lakes", "l.gpkg,z=level", "--banks", "b.shp",
                        "--lakes", "m.gpkg", "--breaklines", "c.gpkg", "--oo", "A=1"});
        REQUIRE(lines.sources.size() == 5);
        CHECK(lines.sources[0].role == LineRole::Breakline);
        CHECK(lines.sources[1].role == LineRole::Lake);
        CHECK(lines.sources[1].source.z == "level");
        CHECK(lines.sources[2].source.path == "m.gpkg");
        CHECK(lines.sources[3].role == LineRole::Bank);
        CHECK(lines.sources[4].role == LineRole::River);
        CHECK(lines.sources[4].source.z == "drape");
        CHECK(lines.sources[4].source.open_options == std::vector<std::string>{"A=1"});
        CHECK(lines.has_water());
    }

    TEST_CASE("water knows its defaults, and says them") {
        const LineOptions lines = lines_with({"--lakes", "l.gpkg", "--rivers", "r.gpkg"});
        const WaterOptions options = lines.water_options();
        CHECK(options.lake_level.kind == LevelRule::Kind::Percentile);
        CHECK(options.lake_level.percent == 5);
        CHECK_FALSE(options.shore_width.has_value());
        CHECK_FALSE(options.shore_clearance.has_value());
        CHECK(options.flow == FlowRule::Digitized);
        CHECK(options.river_fit == RiverFit::Isotonic);
        CHECK(options.meeting_levels == CrossingPolicy::Error);
        CHECK_FALSE(options.keeps_faults);
        CHECK(lines.water.canonical() == " --lake-level percentile:5 --flow digitized --river-fit isotonic");
        CHECK(lines_with({}).water.canonical().empty());
    }

    TEST_CASE("every number of water is taken, and told in one fixed order") {
        const LineOptions lines = lines_with({"--level-tolerance",
                                              "0.01",
                                              "--station-spacing",
                                              "5",
                                              "--max-lift",
                                              "0",
                                              "--max-drop",
                                              "1.50",
                                              "--river-width",
                                              "0",
                                              "--river-fit",
                                              "min",
                                              "--flow",
                                              "auto",
                                              "--shore-clearance",
                                              "0.1",
                                              "--shore-width",
                                              "+12",
                                              "--lake-level",
                                              "percentile:12.5",
                                              "--rivers",
                                              "r.gpkg",
                                              "--lakes",
                                              "l.gpkg",
                                              "--crossing-z",
                                              "min"});
        CHECK(lines.water.canonical() ==
              " --lake-level percentile:12.5 --shore-clearance 0.1 --shore-width 12 --flow auto --river-fit "
              "min "
              "--river-width 0 --max-drop 1.5 --max-lift 0 --station-spacing 5 --level-tolerance 0.01");
        CHECK(lines.canonical().find(" --crossing-z min --lake-level") != std::string::npos);
        const WaterOptions options = lines.water_options();
        CHECK(options.shore_width == 12.0);
        CHECK(options.max_lift == 0.0);
        CHECK(options.meeting_levels == CrossingPolicy::Min);
    }

    TEST_CASE("the level of a lake is a rule that exists") {
        const auto of_level = [](const std::string& rule) {
            return of_tin({"--lakes", "l.gpkg", "--lake-level", rule});
        };
        for (const char* rule : {"min", "mean", "percentile:0", "percentile:100", "percentile:2.5"}) {
            CAPTURE(rule);
            CHECK(of_level(rule) == "fine");
        }
        CHECK(of_level("max") == "--lake-level takes min, percentile:P or mean, not \"max\"");
        for (const std::string rule : {"percentile:101", "percentile:-1", "percentile:", "percentile:nan"}) {
            CHECK(of_level(rule) ==
                  "--lake-level needs a percentile from 0 to 100, as percentile:5, not \"" + rule + "\"");
        }
    }

    TEST_CASE("numbers of water keep to their ranges") {
        const auto of_river = [](const char* option, const char* value) {
            return of_tin({"--rivers", "r.gpkg", option, value});
        };
        CHECK(of_river("--shore-width", "0") == "--shore-width needs a number above zero, not \"0\"");
        CHECK(of_river("--station-spacing", "-5") ==
              "--station-spacing needs a number above zero, not \"-5\"");
        CHECK(of_river("--burn", "0") == "--burn needs a number above zero, not \"0\"");
        CHECK(of_river("--river-width", "-1") == "--river-width needs a number from 0 up, not \"-1\"");
        CHECK(of_river("--max-drop", "-1") == "--max-drop needs a number from 0 up, not \"-1\"");
        CHECK(of_river("--max-lift", "inf") == "--max-lift needs a number, not \"inf\"");
        CHECK(of_river("--level-tolerance", "-0.1") ==
              "--level-tolerance needs a number from 0 up, not \"-0.1\"");
        CHECK(of_river("--flow", "uphill") == "--flow takes digitized or auto, not \"uphill\"");
        CHECK(of_river("--river-fit", "max") == "--river-fit takes isotonic or min, not \"max\"");
        CHECK(of_tin({"--lakes", "l.gpkg", "--shore-clearance", "-1"}) ==
              "--shore-clearance needs a number from 0 up, not \"-1\"");
    }

    TEST_CASE("options of water need the water that they are for") {
        CHECK(of_tin({"--lake-level", "min"}) == "--lake-level is for lakes: give --lakes too");
        CHECK(of_tin({"--rivers", "r.gpkg", "--lake-level", "min"}) ==
              "--lake-level is for lakes: give --lakes too");
        CHECK(of_tin({"--rivers", "r.gpkg", "--shore-clearance", "1"}) ==
              "--shore-clearance is for lakes: give --lakes too");
        CHECK(of_tin({"--lakes", "l.gpkg", "--river-width", "1"}) ==
              "--river-width is for rivers: give --rivers too");
        CHECK(of_tin({"--lakes", "l.gpkg", "--flow", "auto"}) ==
              "--flow is for running water: give --rivers or --banks too");
        CHECK(of_tin({"--banks", "b.gpkg", "--flow", "auto", "--max-drop", "1"}) == "fine");
        CHECK(of_tin({"--shore-width", "1"}) ==
              "--shore-width is for water: give --lakes, --rivers or --banks too");
        CHECK(of_tin({"--burn", "1"}) == "--burn is for rivers: give --rivers too");
    }

    TEST_CASE("enforcement and flattening are never both done by accident") {
        const std::string of_lakes =
            "--burn digs rivers in and --lakes makes water flat, and the two are kept apart: run one job "
            "with "
            "the lakes and banks, another with --burn";
        CHECK(of_tin({"--rivers", "r.gpkg", "--lakes", "l.gpkg", "--burn", "1"}) == of_lakes);
        CHECK(of_tin({"--rivers", "r.gpkg", "--banks", "b.gpkg", "--burn", "1"})
                  .starts_with("--burn digs rivers in and --banks makes water flat"));
        CHECK(complaint<CommandHydro>({"check", "--rivers", "r.gpkg", "--lakes", "l.gpkg", "--burn", "1"}) ==
              of_lakes);
    }

    TEST_CASE("burning only digs unless it is told how to fit") {
        CHECK(lines_with({"--rivers", "r.gpkg", "--burn", "2"}).water.canonical() ==
              " --flow digitized --river-fit min --burn 2");
        CHECK(lines_with({"--rivers", "r.gpkg", "--burn", "2", "--river-fit", "isotonic"})
                  .water_options()
                  .river_fit == RiverFit::Isotonic);
    }

    TEST_CASE("graphs have no water") {
        CHECK(of_tin({"--graph", "mst", "--lakes", "l.gpkg"}) ==
              "--graph writes lines between samples, and no TIN: --lakes does not apply");
    }

    TEST_CASE("cells on rivers are theirs unless the surface is asked for") {
        const auto grid_with = [](std::vector<std::string> arguments) {
            arguments.insert(arguments.begin(), {"a.csv", "-o", "b.tif"});
            CommandGrid grid;
            grid.setup(arguments);
            return grid.are_river_cells;
        };
        CHECK(grid_with({"--rivers", "r.gpkg"}));
        CHECK(grid_with({"--rivers", "r.gpkg", "--river-cells", "line"}));
        CHECK_FALSE(grid_with({"--rivers", "r.gpkg", "--river-cells", "surface"}));
        CHECK(complaint<CommandGrid>({"a.csv", "-o", "b.tif", "--river-cells", "bank"}) ==
              "--river-cells takes line or surface, not \"bank\"");
    }

    TEST_CASE("hydro is told what to do first") {
        CHECK(complaint<CommandHydro>({}) ==
              "hydro needs \"check\" or \"repair\" first; see \"tinwright hydro --help\"");
        CHECK(complaint<CommandHydro>({"a.gpkg", "check"}) ==
              "hydro needs \"check\" or \"repair\" first, not \"a.gpkg\"; see \"tinwright hydro --help\"");
        CHECK(complaint<CommandHydro>({"check", "a.gpkg"}) == "fine");
        CHECK(complaint<CommandHydro>({"check", "a.gpkg", "--lakse", "b.gpkg"}) ==
              "unknown option \"--lakse\"; see \"tinwright hydro check --help\"");
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"-h"}, {"check", "--help"}, {"repair", "--help"}}) {
            CommandHydro hydro;
            CHECK_THROWS_AS(hydro.setup(arguments), HelpRequest);
        }
    }

    TEST_CASE("hydro needs water, and a folder to write it into") {
        CHECK(complaint<CommandHydro>({"check"}) ==
              "no water is given: name it with --lakes, --rivers or --banks");
        CHECK(complaint<CommandHydro>({"repair", "--rivers", "r.gpkg"}) ==
              "hydro repair needs a folder for the repaired lines: name it with -o FOLDER");
        CHECK(complaint<CommandHydro>({"repair", "--rivers", "r.gpkg", "-o", "clean"}) == "fine");
        CHECK(complaint<CommandHydro>({"check", "--rivers", "r.gpkg", "--lake-level", "min"}) ==
              "--lake-level is for lakes: give --lakes too");
        // a positional source may turn out to be lakes
        CHECK(complaint<CommandHydro>({"check", "l.gpkg", "--lake-level", "min"}) == "fine");
    }

    TEST_CASE("a raster is checked within a tolerance") {
        CommandHydro hydro;
        hydro.setup({"check", "--rivers", "r.gpkg", "--raster", "dem.tif,band=2", "--raster-tolerance", "0"});
        REQUIRE(hydro.raster.has_value());
        CHECK(hydro.raster->path == "dem.tif");
        CHECK(hydro.raster->band == 2);
        CHECK(hydro.raster_tolerance == 0);
        CHECK(complaint<CommandHydro>({"check", "--rivers", "r.gpkg", "--raster-tolerance", "1"}) ==
              "--raster-tolerance is for --raster: name the raster too");
        CHECK(complaint<CommandHydro>(
                  {"check", "--rivers", "r.gpkg", "--raster", "d.tif", "--raster-tolerance", "-1"}) ==
              "--raster-tolerance needs a number from 0 up, not \"-1\"");
        CHECK(complaint<CommandHydro>({"repair", "--rivers", "r.gpkg", "-o", "c", "--raster", "d.tif"})
                  .starts_with("unknown option \"--raster\""));
    }
}
