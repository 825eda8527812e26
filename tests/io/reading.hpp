#ifndef TINWRIGHT_TESTS_IO_READING_HPP
#define TINWRIGHT_TESTS_IO_READING_HPP

#include <string>
#include <vector>

#include <cpl_vsi.h>

#include "tinwright/io/read_samples.hpp"

#include "support/messages.hpp"

/// What the tests of the readers share: files in memory, and one-line calls.
namespace tinwright_tests {

/// A file of GDAL's memory file system, gone with the object.
class MemoryFile {
  public:
    MemoryFile(const std::string& name, const std::string& content) : path_("/vsimem/" + name) {
        VSILFILE* const file = VSIFOpenL(path_.c_str(), "wb");
        VSIFWriteL(content.data(), 1, content.size(), file);
        VSIFCloseL(file);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { VSIUnlink(path_.c_str()); }

    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_;
};

inline tinwright::io::Samples read(const std::string& source,
                                   const tinwright::io::ReadOptions& options = {}) {
    const tinwright::io::Source parsed = tinwright::io::parse_source(source);
    return tinwright::io::read_samples({&parsed, 1}, options);
}

inline tinwright::io::Samples read_all(const std::vector<std::string>& sources,
                                       const tinwright::io::ReadOptions& options = {}) {
    std::vector<tinwright::io::Source> parsed;
    for (const std::string& source : sources) {
        parsed.push_back(tinwright::io::parse_source(source));
    }
    return tinwright::io::read_samples(parsed, options);
}

/// Samples of a text file in memory; `keys` as in ",z=4".
inline tinwright::io::Samples read_text(const std::string& content, const std::string& keys = "",
                                        const tinwright::io::ReadOptions& options = {}) {
    const MemoryFile file("t.txt", content);
    return read(file.path() + keys, options);
}

}  // namespace tinwright_tests

#endif
