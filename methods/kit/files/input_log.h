// Notes which files are read as data, those that other files name included: the inputs of a run.
//
// Code that reads a data file (TOML, CSV, meshes, voxels, pictures) calls `noteInput`, which costs a branch if there is
// no log. Threads: `noteInput` is safe from any.
#pragma once

#include <filesystem>
#include <set>
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

 private:
    friend DUSTBENCH_API void noteInput(const std::filesystem::path& file);
    std::set<std::filesystem::path> files_;
};

DUSTBENCH_API void noteInput(const std::filesystem::path& file);

}  // namespace dustbench::files
