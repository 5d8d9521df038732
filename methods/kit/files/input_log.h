// Notes which files are read as data, those that other files name included, and what of them is ignored: the inputs of
// a run.
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

    /// So far, as absolute paths, each once, sorted.
    [[nodiscard]] std::vector<std::filesystem::path> files() const;
    /// Likewise what was looked for: another set of files may be there tomorrow.
    [[nodiscard]] std::vector<std::filesystem::path> searches() const;
    /// What of each file nothing uses, in the file's order: `array 'material' at cells`.
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
/// A pattern whose files were taken, or a file that was not there and was taken from elsewhere.
DUSTBENCH_API void noteSearch(const std::filesystem::path& path);

/// Parts of a file that the reader passes over, though they may matter to who wrote them: names as they stand in it.
DUSTBENCH_API void noteIgnored(const std::filesystem::path& file, const std::vector<std::string>& parts);

}  // namespace dustbench::files
