#include "bench/export/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "methods/kit/files/machine_error.h"

namespace dustbench::exports {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view ending = ".dustbench-unfinished";

/// One file, or the entries of one folder.
void putEntryOnDisk(const fs::path& path) {
    const int handle = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (handle < 0) files::failWriting(path, errno);
    const int error = fsync(handle) == 0 ? 0 : errno;
    close(handle);
    if (error != 0 && error != EINVAL && error != EROFS) files::failWriting(path, error);  // EINVAL: not on a disk
}

}  // namespace

void putOnDisk(const fs::path& path) {
    if (fs::is_directory(path))
        for (const auto& entry : fs::recursive_directory_iterator(path))
            if (!entry.is_symlink() && (entry.is_regular_file() || entry.is_directory())) putEntryOnDisk(entry.path());
    putEntryOnDisk(path);
}

void putNameOnDisk(const fs::path& path) {
    putEntryOnDisk(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

InputError cannotWrite(const fs::path& path, std::string_view reason) {
    return InputError(fmt::format("output '{}' cannot be written: {}", path.string(), reason));
}

WholeFile::WholeFile(fs::path place)
    : place_(std::move(place)),
      temporaryPath_(place_.parent_path() / fmt::format(".{}{}", place_.filename().string(), ending)) {}

WholeFile::~WholeFile() {
    std::error_code error;
    fs::remove_all(temporaryPath_, error);
}

void WholeFile::publish() {
    putOnDisk(temporaryPath_);
    std::error_code error;
    fs::rename(temporaryPath_, place_, error);
    if (error) files::failWriting(place_, error.value());
    putNameOnDisk(place_);
}

void writeWhole(const fs::path& file, std::string_view content) {
    WholeFile whole(file);
    {
        errno = 0;
        std::ofstream stream(whole.temporaryPath(), std::ios::binary | std::ios::trunc);
        stream.write(content.data(), static_cast<std::streamsize>(content.size()));
        stream.close();
        if (!stream) files::failWriting(file, errno);
    }
    whole.publish();
}

void removeUnfinished(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename();
        if (name.starts_with('.') && name.ends_with(ending)) fs::remove_all(entry.path(), error);
    }
}

}  // namespace dustbench::exports
