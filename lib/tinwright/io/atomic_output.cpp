#include "tinwright/io/atomic_output.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fcntl.h>
#include <gdal_priv.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "tinwright/geometry/error.hpp"
#include "tinwright/io/gdal_session.hpp"

namespace tinwright::io {

namespace fs = std::filesystem;

namespace {

// Outputs alive, for discard_unfinished_outputs: temporary folders, and /vsi targets.
struct Unfinished {
    std::mutex mutex;
    std::set<std::string> folders;
    std::set<std::string> virtual_files;
};

Unfinished& unfinished() {
    static Unfinished all;
    return all;
}

bool is_virtual(const std::string& path) { return path.starts_with("/vsi"); }

std::string reason(int error) { return std::strerror(error); }

std::string reason(const std::error_code& error) { return error.message(); }

fs::path folder_of(const fs::path& file) {
    const fs::path folder = file.parent_path();
    return folder.empty() ? fs::path(".") : folder;
}

std::string stem_of(const std::string& path) { return fs::path(path).stem().string(); }

// Whether `name` is `stem` with any extension: what drivers name side-car files.
bool has_stem(const std::string& name, const std::string& stem) {
    return name.size() > stem.size() && name.starts_with(stem) && name[stem.size()] == '.';
}

// SQLite's helpers of a database that was not closed cleanly.
std::vector<std::string> journals_of(const std::string& file) {
    return {file + "-wal", file + "-shm", file + "-journal"};
}

// The files of an existing dataset that lie beside it under its own name; a VRT's sources are not among them.
std::vector<std::string> files_of_dataset(const std::string& file) {
    register_drivers();
    const GdalMessages messages;
    std::vector<std::string> files;
    const std::string folder = CPLGetPath(file.c_str());
    if (GDALDataset* dataset = GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_RASTER)) {
        const CPLStringList list(dataset->GetFileList());
        GDALClose(dataset);
        for (int i = 0; i < list.size(); ++i) {
            const char* const name = list[i];
            if (folder == CPLGetPath(name) && has_stem(CPLGetFilename(name), stem_of(file))) {
                files.emplace_back(name);
            }
        }
    }
    for (const std::string& journal : journals_of(file)) {
        files.push_back(journal);
    }
    return files;
}

// Asks the kernel for every write error it still holds back: quotas and network disks report late.
void sync_file(const fs::path& file, const std::string& target) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    int error = descriptor < 0 ? errno : 0;
    if (descriptor >= 0) {
        error = ::fsync(descriptor) != 0 && errno != EINVAL && errno != EROFS ? errno : 0;
        ::close(descriptor);
    }
    if (error != 0) {
        throw IoError("cannot finish writing " + io::quoted(target) + ": " + reason(error));
    }
}

std::vector<std::string> virtual_siblings(const std::string& target) {
    std::vector<std::string> names;
    const std::string folder = CPLGetPath(target.c_str());
    const CPLStringList list(VSIReadDir(folder.c_str()));
    for (int i = 0; i < list.size(); ++i) {
        if (has_stem(list[i], CPLGetBasename(target.c_str()))) {
            names.emplace_back(CPLFormFilename(folder.c_str(), list[i], nullptr));
        }
    }
    return names;
}

// The real file under /vsigzip/ and the like, whose file systems cannot delete.
std::string inner_path(const std::string& path) {
    for (const char* const prefix : {"/vsigzip/", "/vsizip/"}) {
        if (path.starts_with(prefix)) {
            const std::string inner = path.substr(std::strlen(prefix));
            const std::size_t end = prefix[4] == 'z' ? inner.find(".zip") : std::string::npos;
            return end == std::string::npos ? inner : inner.substr(0, end + 4);
        }
    }
    return {};
}

void delete_virtual(const std::string& path) {
    if (VSIUnlink(path.c_str()) != 0) {
        const std::string inner = inner_path(path);
        if (!inner.empty()) {
            VSIUnlink(inner.c_str());
        }
    }
}

std::string in_gigabytes(double bytes) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), bytes < 1e8 ? "%.3f GB" : "%.1f GB", bytes * 1e-9);
    return text.data();
}

}  // namespace

AtomicOutput::AtomicOutput(std::string target, bool overwrite)
    : target_(std::move(target)), overwrite_(overwrite) {
    if (target_.empty()) {
        throw UsageError("the output has no name; give one with -o FILE");
    }
    if (target_ == "-" || target_.starts_with("/vsistdout") || target_ == "/dev/stdout") {
        throw UsageError("cannot write " + io::quoted(target_) +
                         ": outputs are files that appear only when complete; name a file");
    }
    if (is_virtual(target_)) {
        prepare_virtual();
    } else {
        prepare_local();
    }
}

void AtomicOutput::prepare_local() {
    std::error_code error;
    fs::path destination = target_;
    if (fs::is_symlink(destination, error)) {
        // The link stays; what it points to is replaced.
        destination = fs::weakly_canonical(destination, error);
        if (error) {
            throw IoError("cannot write " + io::quoted(target_) + ": " + reason(error));
        }
    }
    destination_ = destination.string();
    const fs::path folder = folder_of(destination);
    const fs::file_status status = fs::status(destination, error);
    if (fs::is_directory(status)) {
        throw IoError("cannot write " + io::quoted(target_) + ": it is a folder; name a file");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw IoError("cannot write " + io::quoted(target_) + ": it is not a regular file");
    }
    if (fs::exists(status) && !overwrite_) {
        throw IoError(io::quoted(target_) + " exists; use --overwrite to replace it");
    }
    if (fs::exists(status) && ::faccessat(AT_FDCWD, destination.c_str(), W_OK, AT_EACCESS) != 0) {
        throw IoError("cannot replace " + io::quoted(target_) + ": " + reason(errno));
    }
    if (!fs::is_directory(folder, error)) {
        throw IoError("cannot write " + io::quoted(target_) + ": there is no folder " +
                      io::quoted(folder.string()));
    }
    std::string pattern = (folder / ".tinwright-XXXXXX").string();
    const std::lock_guard lock(unfinished().mutex);
    if (::mkdtemp(pattern.data()) == nullptr) {
        throw IoError("cannot write in folder " + io::quoted(folder.string()) + ": " + reason(errno));
    }
    folder_ = pattern;
    unfinished().folders.insert(folder_);
    path_ = (fs::path(folder_) / destination.filename()).string();
}

void AtomicOutput::prepare_virtual() {
    register_drivers();
    const GdalMessages messages;
    destination_ = target_;
    path_ = target_;
    VSIStatBufL status;
    if (VSIStatL(target_.c_str(), &status) == 0) {
        if (VSI_ISDIR(status.st_mode)) {
            throw IoError("cannot write " + io::quoted(target_) + ": it is a folder; name a file");
        }
        if (!overwrite_) {
            throw IoError(io::quoted(target_) + " exists; use --overwrite to replace it");
        }
        for (const std::string& file : files_of_dataset(target_)) {
            VSIUnlink(file.c_str());
        }
        delete_virtual(target_);
    }
    siblings_ = virtual_siblings(target_);
    const std::lock_guard lock(unfinished().mutex);
    unfinished().virtual_files.insert(path_);
}

AtomicOutput::~AtomicOutput() {
    if (!committed_) {
        discard();
    }
}

void AtomicOutput::discard() noexcept {
    try {
        std::error_code error;
        if (!folder_.empty()) {
            fs::remove_all(folder_, error);
        } else {
            const GdalMessages messages;
            for (const std::string& file : virtual_siblings(path_)) {
                if (std::find(siblings_.begin(), siblings_.end(), file) == siblings_.end()) {
                    VSIUnlink(file.c_str());
                }
            }
            delete_virtual(path_);
        }
        const std::lock_guard lock(unfinished().mutex);
        unfinished().folders.erase(folder_);
        unfinished().virtual_files.erase(path_);
    } catch (...) {  // nothing more can be done about a file that will not go away
        return;
    }
}

void AtomicOutput::commit() {
    if (folder_.empty()) {
        VSIStatBufL status;
        if (VSIStatL(path_.c_str(), &status) != 0) {
            throw IoError("cannot write " + io::quoted(target_) + ": nothing was written");
        }
        committed_ = true;
        const std::lock_guard lock(unfinished().mutex);
        unfinished().virtual_files.erase(path_);
        return;
    }

    const fs::path folder = folder_of(destination_);
    const fs::path main_name = fs::path(destination_).filename();
    std::vector<fs::path> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
        names.push_back(entry.path().filename());
    }
    // The target comes last: who sees it sees all of it.
    std::sort(names.begin(), names.end(), [&](const fs::path& a, const fs::path& b) {
        return std::pair(a == main_name, a.native()) < std::pair(b == main_name, b.native());
    });
    if (error || names.empty() || names.back() != main_name) {
        throw IoError("cannot write " + io::quoted(target_) + ": nothing was written");
    }
    for (const fs::path& name : names) {
        if (!overwrite_ && fs::exists(folder / name)) {
            throw IoError(io::quoted((folder / name).string()) + " exists; use --overwrite to replace it");
        }
        if (fs::is_regular_file(fs::path(folder_) / name)) {
            sync_file(fs::path(folder_) / name, target_);
        }
    }
    if (overwrite_ && fs::exists(destination_)) {
        for (const std::string& old : files_of_dataset(destination_)) {
            const fs::path name = fs::path(old).filename();
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                fs::remove(old, error);
            }
        }
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const fs::path place = folder / names[i];
        fs::rename(fs::path(folder_) / names[i], place, error);
        if (error) {
            std::error_code ignored;
            for (std::size_t moved = 0; moved < i; ++moved) {
                fs::remove_all(folder / names[moved], ignored);  // a side-car file alone helps nobody
            }
            throw IoError("cannot move the finished file to " + io::quoted(place.string()) + ": " +
                          reason(error));
        }
    }
    committed_ = true;
    fs::remove_all(folder_, error);
    const std::lock_guard lock(unfinished().mutex);
    unfinished().folders.erase(folder_);
}

void discard_unfinished_outputs() {
    const std::lock_guard lock(unfinished().mutex);
    for (const std::string& folder : unfinished().folders) {
        std::error_code error;
        // Another thread may still be writing: a file made while the folder is being emptied needs a
        // second pass.
        for (int pass = 0; pass < 3; ++pass) {
            fs::remove_all(folder, error);
            if (!fs::exists(folder, error)) {
                break;
            }
        }
    }
    for (const std::string& file : unfinished().virtual_files) {
        delete_virtual(file);
    }
}

void require_free_space(const std::string& target, double bytes) {
    if (is_virtual(target)) {
        return;
    }
    const fs::path folder = folder_of(target);
    struct statvfs state {};
    if (::statvfs(folder.c_str(), &state) != 0) {
        return;  // who cannot be asked will say so when written to
    }
    const double free = static_cast<double>(state.f_bavail) * static_cast<double>(state.f_frsize);
    if (bytes > free) {
        throw IoError("not enough space for " + io::quoted(target) + ": " + in_gigabytes(bytes) +
                      " needed, " + in_gigabytes(free) + " free; choose another folder or a smaller output");
    }
}

}  // namespace tinwright::io
