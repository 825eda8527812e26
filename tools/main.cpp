#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

#include "command_registry.hpp"
#include "console.hpp"
#include "interrupt.hpp"

namespace {

using namespace tinwright;
using namespace tinwright::tools;

// The only place that knows exit statuses.
constexpr int kDone = 0;
constexpr int kFailed = 1;  // the data or the file system failed us; `check`: violations found
constexpr int kWrongCommandLine = 2;

int print_and_finish(const std::string& text) {
    print_result(text);
    return kDone;
}

int run_command(const CommandEntry& entry, const std::vector<std::string>& arguments) {
    const std::unique_ptr<Command> command = entry.make();
    try {
        command->setup(arguments);
    } catch (const HelpRequest& help) {
        return print_and_finish(help.text);
    }
    const io::GdalMessages messages;  // nothing that GDAL says goes past us to the terminal
    return command->run() == Outcome::Done ? kDone : kFailed;
}

int dispatch(const std::vector<std::string>& arguments, std::string& command) {
    if (arguments.empty()) {
        throw UsageError("no command is given; see \"tinwright --help\"");
    }
    const std::string& first = arguments.front();
    const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    if (first == "--help" || first == "-h") {
        return print_and_finish(overview());
    }
    if (first == "--version") {
        return print_and_finish("tinwright " TINWRIGHT_VERSION "\n");
    }
    if (first == "help") {
        if (rest.size() > 1) {
            throw UsageError("help takes one command");
        }
        return print_and_finish(rest.empty() ? manual_page("") : manual_page(rest.front()));
    }
    const CommandEntry* const entry = find_command(first);
    if (entry == nullptr) {
        throw UsageError(std::string(first.starts_with('-') ? "unknown option " : "unknown command ") +
                         io::quoted(first) + "; see \"tinwright --help\"");
    }
    command = entry->name;
    return run_command(*entry, rest);
}

}  // namespace

int main(int argc, char** argv) {
    std::string command;
    try {
        watch_for_interrupts();
        return dispatch({argv + 1, argv + argc}, command);
    } catch (const UsageError& error) {
        print_error(command, error.what());
        return kWrongCommandLine;
    } catch (const BrokenPipe&) {
        return kFailed;  // the reader has seen enough
    } catch (const Error& error) {
        print_error(command, error.what());
    } catch (const std::bad_alloc&) {
        print_error(command, "out of memory; see MEMORY USAGE in \"tinwright help" +
                                 (command.empty() ? command : " " + command) + "\"");
    } catch (const std::exception& error) {
        print_error(command, std::string("unexpected failure: ") + error.what());
    }
    return kFailed;
}
