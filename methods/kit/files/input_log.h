// Records the inputs of a run: the files read as data, including those that other files name, and the parts of them
// that are ignored.
//
// Code that reads a data file (TOML, CSV, meshes, voxels, pictures) calls `noteInput`, which costs a branch if there is
// no log. Threads: `noteInput` and `noteSearch` are safe from any.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace dustbench::files {

/// Notes every file that is read while it lives. At most one at a time; throws std::logic_error for a second.
class DUSTBENCH_API InputLog {
 public:
    InputLog();
    ~InputLog();
    InputLog(const InputLog&) = delete;
    InputLog& operator=(const InputLog&) = delete;

    /// The files so far, as absolute paths, each once, sorted.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;
    /// The searches so far, likewise: they may find other files next time.
    [[nodiscard]] std::vector<std::filesystem::path> searches() const;
    /// The unused parts of each file, in the file's order: `array 'material' at cells`.
    [[nodiscard]] std::map<std::filesystem::path, std::vector<std::string>> ignored() const;

 private:
    friend DUSTBENCH_API void noteInput(const std::filesystem::path& file);
    friend DUSTBENCH_API void noteSearch(const std::filesystem::path& path);
    friend DUSTBENCH_API void noteIgnored(const std::filesystem::path& file, const std::vector<std::string>& parts);
    std::set<std::filesystem::path> files_, searches_;
    std::map<std::filesystem::path, std::vector<std::string>> ignored_;
};

/// Throws InputError for a name that is not UTF-8.
DUSTBENCH_API void noteInput(const std::filesystem::path& file);
/// Notes a pattern whose files were read, or a file that was missing here and found elsewhere.
DUSTBENCH_API void noteSearch(const std::filesystem::path& path);

/// Notes parts of a file that the reader skips but that may matter to the user, by their names in the file.
DUSTBENCH_API void noteIgnored(const std::filesystem::path& file, const std::vector<std::string>& parts);

}  // namespace dustbench::files
