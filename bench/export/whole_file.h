// A file that is there whole or not at all: written under a hidden name beside its place, then renamed.
#pragma once

#include <filesystem>
#include <string_view>

#include "methods/contract/errors.h"

namespace dustbench::bench {

/// Owns: what lies under the hidden name, a file or a folder; it goes with the object unless it was published.
class WholeFile {
 public:
    explicit WholeFile(std::filesystem::path place);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    /// The hidden name to write to.
    [[nodiscard]] const std::filesystem::path& beside() const { return beside_; }
    [[nodiscard]] const std::filesystem::path& place() const { return place_; }
    /// Puts it into its place. Throws InputError where that cannot be done.
    void publish();

 private:
    std::filesystem::path place_;
    std::filesystem::path beside_;
};

/// Throws InputError where it cannot be written.
void writeWhole(const std::filesystem::path& file, std::string_view content);

[[nodiscard]] InputError cannotWrite(const std::filesystem::path& path, std::string_view reason);

/// Removes what a killed program left of its WholeFiles in the folder.
void removeUnfinished(const std::filesystem::path& folder);

}  // namespace dustbench::bench
