#include "tinwright/io/atomic_output.hpp"

#include <filesystem>
#include <set>
#include <string>

#include <cpl_vsi.h>
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"
#include "tinwright/io/write_tin.hpp"

#include "io/tin_examples.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

using namespace tinwright;
using namespace tinwright::io;
using tinwright_tests::message_of;
using tinwright_tests::read_bytes;
using tinwright_tests::TemporaryFolder;
using tinwright_tests::write_bytes;

namespace {

using Names = std::set<std::string>;

template <class Exception>
std::string refusal(const std::string& target, bool overwrite = false) {
    return message_of<Exception>([&] { const AtomicOutput output(target, overwrite); });
}

}  // namespace

TEST_SUITE("io/atomic_output") {
    TEST_CASE("files appear together at the commit, side-car files too") {
        const TemporaryFolder folder;
        {
            AtomicOutput output(folder.file("a.shp"), false);
            CHECK(std::filesystem::path(output.path()).filename() == "a.shp");
            write_bytes(output.path(), "main");
            write_bytes(std::filesystem::path(output.path()).replace_extension(".dbf"), "side-car");
            CHECK(folder.names().size() == 1);  // the temporary folder
            CHECK(folder.names().begin()->starts_with(".tinwright-"));
            output.commit();
        }
        CHECK(folder.names() == Names{"a.shp", "a.dbf"});
        CHECK(read_bytes(folder.file("a.shp")) == "main");
    }

    TEST_CASE("without a commit nothing is left and an older file stays") {
        const TemporaryFolder folder;
        write_bytes(folder.file("a.tif"), "older");
        {
            const AtomicOutput output(folder.file("a.tif"), true);
            write_bytes(output.path(), "newer");
        }
        CHECK(folder.names() == Names{"a.tif"});
        CHECK(read_bytes(folder.file("a.tif")) == "older");
    }

    TEST_CASE("an existing target needs overwrite") {
        const TemporaryFolder folder;
        write_bytes(folder.file("a.tif"), "older");
        CHECK(refusal<IoError>(folder.file("a.tif")) ==
              io::quoted(folder.file("a.tif")) + " exists; use --overwrite to replace it");
        AtomicOutput output(folder.file("a.tif"), true);
        write_bytes(output.path(), "newer");
        output.commit();
        CHECK(read_bytes(folder.file("a.tif")) == "newer");
        CHECK(folder.names() == Names{"a.tif"});
    }

    TEST_CASE("a side-car file that is somebody's is not overwritten unasked") {
        const TemporaryFolder folder;
        write_bytes(folder.file("a.dbf"), "somebody's");
        {
            AtomicOutput output(folder.file("a.shp"), false);
            write_bytes(output.path(), "main");
            write_bytes(std::filesystem::path(output.path()).replace_extension(".dbf"), "ours");
            CHECK_THROWS_AS(output.commit(), IoError);
        }
        CHECK(folder.names() == Names{"a.dbf"});
        CHECK(read_bytes(folder.file("a.dbf")) == "somebody's");
    }

    TEST_CASE("overwriting removes the side-car files of the older dataset and no other file") {
        const TemporaryFolder folder;
        const Tin tin = tinwright_tests::example_tin(1, 10);
        WriteTinOptions options;
        write_tin(tin, Crs::parse("EPSG:3067"), folder.file("a.shp"), options);
        CHECK(folder.names() == Names{"a.shp", "a.shx", "a.dbf", "a.prj"});
        write_bytes(folder.file("a.txt"), "notes");
        options.overwrite = true;
        write_tin(tin, Crs(), folder.file("a.shp"), options);
        CHECK(folder.names() == Names{"a.shp", "a.shx", "a.dbf", "a.txt"});
    }

    TEST_CASE("overwriting a GeoPackage removes its journals") {
        const TemporaryFolder folder;
        const Tin tin = tinwright_tests::example_tin(1, 10);
        write_tin(tin, Crs(), folder.file("a.gpkg"), {});
        write_bytes(folder.file("a.gpkg-journal"), "");
        WriteTinOptions options;
        options.overwrite = true;
        write_tin(tin, Crs(), folder.file("a.gpkg"), options);
        CHECK(folder.names() == Names{"a.gpkg"});
    }

    TEST_CASE("targets that cannot be files are refused in one line") {
        const TemporaryFolder folder;
        CHECK(refusal<IoError>(folder.path()) ==
              "cannot write \"" + folder.path() + "\": it is a folder; name a file");
        CHECK(refusal<IoError>(folder.file("no/a.tif")) == "cannot write \"" + folder.file("no/a.tif") +
                                                               "\": there is no folder \"" +
                                                               folder.file("no") + "\"");
        CHECK(refusal<IoError>("/dev/null", true) == "cannot write \"/dev/null\": it is not a regular file");
        CHECK(refusal<UsageError>("") == "the output has no name; give one with -o FILE");
        CHECK(refusal<UsageError>("/vsistdout/") ==
              "cannot write \"/vsistdout/\": outputs are files that appear only when complete; name a file");
        CHECK(refusal<UsageError>("-").starts_with("cannot write \"-\""));
        // Nobody, root included, makes folders in /proc.
        CHECK(refusal<IoError>("/proc/a.tif").starts_with("cannot write in folder \"/proc\": "));
    }

    TEST_CASE("a folder without permission and a protected file are refused") {
        const TemporaryFolder folder;
        write_bytes(folder.file("a.tif"), "protected");
        ::chmod(folder.file("a.tif").c_str(), 0444);
        ::chmod(folder.path().c_str(), 0555);
        const uid_t user = ::geteuid();
        if (user == 0) {
            REQUIRE(::seteuid(65534) == 0);  // root may write everywhere
        }
        const std::string protected_file = refusal<IoError>(folder.file("a.tif"), true);
        const std::string protected_folder = refusal<IoError>(folder.file("b.tif"));
        if (user == 0) {
            REQUIRE(::seteuid(0) == 0);
        }
        ::chmod(folder.path().c_str(), 0755);
        CHECK(protected_file == "cannot replace \"" + folder.file("a.tif") + "\": Permission denied");
        CHECK(protected_folder == "cannot write in folder \"" + folder.path() + "\": Permission denied");
    }

    TEST_CASE("a symbolic link stays and its file is replaced") {
        const TemporaryFolder folder;
        std::filesystem::create_directory(folder.file("real"));
        write_bytes(folder.file("real/a.tif"), "older");
        std::filesystem::create_symlink("real/a.tif", folder.file("link.tif"));
        AtomicOutput output(folder.file("link.tif"), true);
        write_bytes(output.path(), "newer");
        output.commit();
        CHECK(std::filesystem::is_symlink(folder.file("link.tif")));
        CHECK(read_bytes(folder.file("real/a.tif")) == "newer");
    }

    TEST_CASE("when the last file cannot be moved, the side-car files are taken back") {
        const TemporaryFolder folder;
        {
            AtomicOutput output(folder.file("a.shp"), true);
            write_bytes(output.path(), "main");
            write_bytes(std::filesystem::path(output.path()).replace_extension(".dbf"), "side-car");
            std::filesystem::create_directories(folder.file("a.shp/in the way"));
            CHECK_THROWS_AS(output.commit(), IoError);
        }
        CHECK(folder.names() == Names{"a.shp"});
    }

    TEST_CASE("a commit without a file is an error") {
        const TemporaryFolder folder;
        {
            AtomicOutput output(folder.file("a.tif"), false);
            CHECK_THROWS_WITH_AS(
                output.commit(),
                ("cannot write \"" + folder.file("a.tif") + "\": nothing was written").c_str(), IoError);
        }
        CHECK(folder.names().empty());
    }

    TEST_CASE("a virtual target is written directly and deleted on failure with its side-car files") {
        const auto write = [](const std::string& path) {
            VSILFILE* const file = VSIFOpenL(path.c_str(), "wb");
            VSIFWriteL("x", 1, 1, file);
            VSIFCloseL(file);
        };
        const auto exists = [](const char* path) {
            VSIStatBufL status;
            return VSIStatL(path, &status) == 0;
        };
        write("/vsimem/atomic/a.txt");
        {
            const AtomicOutput output("/vsimem/atomic/a.shp", false);
            CHECK(output.path() == "/vsimem/atomic/a.shp");
            write(output.path());
            write("/vsimem/atomic/a.dbf");
        }
        CHECK_FALSE(exists("/vsimem/atomic/a.shp"));
        CHECK_FALSE(exists("/vsimem/atomic/a.dbf"));
        CHECK(exists("/vsimem/atomic/a.txt"));
        {
            AtomicOutput output("/vsimem/atomic/a.shp", false);
            write(output.path());
            output.commit();
        }
        CHECK(exists("/vsimem/atomic/a.shp"));
        CHECK(refusal<IoError>("/vsimem/atomic/a.shp") ==
              "\"/vsimem/atomic/a.shp\" exists; use --overwrite to replace it");
        CHECK(refusal<IoError>("/vsimem/atomic/a.shp", true).empty());
        CHECK_FALSE(exists("/vsimem/atomic/a.shp"));
        VSIRmdirRecursive("/vsimem/atomic");
    }

    TEST_CASE("unfinished outputs can be discarded from elsewhere") {
        const TemporaryFolder folder;
        const AtomicOutput one(folder.file("a.tif"), false);
        const AtomicOutput two(folder.file("b.tif"), false);
        write_bytes(one.path(), "half");
        CHECK(folder.names().size() == 2);
        discard_unfinished_outputs();
        CHECK(folder.names().empty());
    }

    TEST_CASE("too little space is told before the work, with both figures") {
        const TemporaryFolder folder;
        CHECK_NOTHROW(require_free_space(folder.file("a.tif"), 1));
        CHECK_NOTHROW(require_free_space("/vsimem/a.tif", 1e30));
        try {
            require_free_space(folder.file("a.tif"), 1e21);
            FAIL("not thrown");
        } catch (const IoError& error) {
            const std::string message = error.what();
            CHECK(message.starts_with("not enough space for \"" + folder.file("a.tif") +
                                      "\": 1000000000000.0 GB needed, "));
            CHECK(message.ends_with(" GB free; choose another folder or a smaller output"));
        }
    }
}
