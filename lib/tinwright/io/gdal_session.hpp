#ifndef TINWRIGHT_IO_GDAL_SESSION_HPP
#define TINWRIGHT_IO_GDAL_SESSION_HPP

#include <string>
#include <vector>

namespace tinwright::io {

/// Registers GDAL's drivers, once a process. Cheap when called again; called by every reader and writer.
void register_drivers();

/// While alive, GDAL's messages are kept instead of printed, and the last error is folded into our own
/// one-line messages. Messages of this thread go to its youngest object, those of threads without one (GDAL's
/// workers) to the youngest of all. Destroy in reverse order of construction, on the constructing thread.
class GdalMessages {
  public:
    GdalMessages();
    ~GdalMessages();
    GdalMessages(const GdalMessages&) = delete;
    GdalMessages& operator=(const GdalMessages&) = delete;

    /// The last error's text on one line, without a trailing full stop; empty when there was none.
    [[nodiscard]] std::string last_error() const;
    /// The same of the last warning.
    [[nodiscard]] std::string last_warning() const;
    /// "; GDAL says: <last error>" or nothing: ready to be appended to a message.
    [[nodiscard]] std::string suffix() const;

  private:
    friend struct GdalMessageHandler;
    struct State;
    State* state_;
};

/// `text` on one line for an error message, in double quotes: control characters, quotes, backslashes and
/// invalid UTF-8 escaped, long texts shortened in the middle.
std::string quoted(const std::string& text);
/// The names quoted, separated by commas; of a long list the first twenty.
std::string quoted_list(const std::vector<std::string>& names);

}  // namespace tinwright::io

#endif
