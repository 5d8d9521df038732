// Atomic file writing: the file is written under a hidden name in the same folder, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/contract/errors.h"

namespace dustbench::bench {

/// Owns: the file or folder under the hidden name; it is removed with the object unless it was published.
class WholeFile {
 public:
    explicit WholeFile(std::filesystem::path place);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// The hidden name to write to.
    [[nodiscard]] const std::filesystem::path& beside() const { return beside_; }
    [[nodiscard]] const std::filesystem::path& place() const { return place_; }
    /// Moves it to its final place. Throws as files::failWriting.
    void publish();

 private:
    std::filesystem::path place_;
    std::filesystem::path beside_;
};

/// Throws as files::failWriting if it cannot be written.
void writeWhole(const std::filesystem::path& file, std::string_view content);

/// Where no error number is known: files::failWriting.
[[nodiscard]] InputError cannotWrite(const std::filesystem::path& path, std::string_view reason);

/// Removes unfinished WholeFiles left in the folder by an interrupted program.
void removeUnfinished(const std::filesystem::path& folder);

}  // namespace dustbench::bench
