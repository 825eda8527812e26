#include "console.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include <unistd.h>

namespace tinwright::tools {

namespace {

std::ostream* progress_stream(const TalkOptions& options) {
    const bool shown =
        options.progress || (isatty(STDERR_FILENO) == 1 && !options.quiet && !options.no_progress);
    return shown ? &std::cerr : nullptr;
}

std::string speaker(const std::string& command) {
    return command.empty() ? "tinwright: " : "tinwright " + command + ": ";
}

}  // namespace

Console::Console(std::string command, const TalkOptions& options)
    : command_(std::move(command)), options_(options), progress_(progress_stream(options)) {}

void Console::warn(const std::string& text) {
    progress_.break_line();
    std::cerr << speaker(command_) << "warning: " << text << "\n";
}

void Console::warn_once(const std::string& text) {
    if (said_once_.insert(text).second) {
        warn(text);
    }
}

void Console::say(const std::string& lines) {
    if (!options_.quiet) {
        progress_.break_line();
        std::cerr << lines;
    }
}

void print_result(const std::string& text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        if (errno == EPIPE) {
            throw BrokenPipe();
        }
        throw IoError("cannot write to standard output: " + std::string(std::strerror(errno)));
    }
}

void print_error(const std::string& command, const std::string& text) {
    std::cerr << speaker(command) << "error: " << text << "\n";
}

}  // namespace tinwright::tools
