#ifndef TINWRIGHT_TOOLS_CONSOLE_HPP
#define TINWRIGHT_TOOLS_CONSOLE_HPP

#include <set>
#include <string>

#include "tinwright/geometry/error.hpp"

#include "options_talk.hpp"
#include "progress.hpp"

namespace tinwright::tools {

/// What a running command says: talk on standard error, results on standard output.
class Console {
  public:
    /// `command`: the subcommand's name, which starts warnings and errors.
    Console(std::string command, const TalkOptions& options);

    [[nodiscard]] ProgressLine& progress() { return progress_; }

    /// "tinwright grid: warning: text", also when quiet.
    void warn(const std::string& text);
    /// The same, if it has not been said already.
    void warn_once(const std::string& text);
    /// Lines of the report, each with its newline; nothing when quiet.
    void say(const std::string& lines);

  private:
    std::string command_;
    TalkOptions options_;
    ProgressLine progress_;
    std::set<std::string> said_once_;
};

/// The reader of standard output has gone away: no fault worth a message.
class BrokenPipe : public Error {
  public:
    BrokenPipe() : Error("standard output was closed by its reader") {}
};

/// Writes to standard output, whole. Throws BrokenPipe, or IoError when it cannot be written otherwise.
void print_result(const std::string& text);

/// "tinwright grid: error: text" on standard error; `command` may be empty.
void print_error(const std::string& command, const std::string& text);

}  // namespace tinwright::tools

#endif
