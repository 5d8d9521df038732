// Atomic file writing: a file is written under a hidden name in the same folder, synchronised to disk, then renamed. A
// file under its final name is therefore complete, even after a loss of power.
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/contract/errors.h"

namespace dustbench::exports {

/// Owns: the file or folder under the hidden name. The destructor removes it unless it was published.
class WholeFile {
 public:
    explicit WholeFile(std::filesystem::path place);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// The hidden name to write to.
    [[nodiscard]] const std::filesystem::path& temporaryPath() const { return temporaryPath_; }
    [[nodiscard]] const std::filesystem::path& place() const { return place_; }
    /// Moves it to its final place. Throws as files::failWriting.
    void publish();

 private:
    std::filesystem::path place_;
    std::filesystem::path temporaryPath_;
};

/// Waits until a file, or a folder with all that is in it, is on disk (fsync). Throws as files::failWriting.
void putOnDisk(const std::filesystem::path& path);
/// The same for only the name, after it was created or changed.
void putNameOnDisk(const std::filesystem::path& path);

/// Throws as files::failWriting if it cannot be written.
void writeWhole(const std::filesystem::path& file, std::string_view content);

/// For failures without an error number; with one, see files::failWriting.
[[nodiscard]] InputError cannotWrite(const std::filesystem::path& path, std::string_view reason);

/// Removes unfinished WholeFiles left in the folder by an interrupted program.
void removeUnfinished(const std::filesystem::path& folder);

}  // namespace dustbench::exports
