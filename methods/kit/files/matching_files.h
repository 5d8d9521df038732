// The files that a path with a `*` stands for.
#pragma once

#include <filesystem>
#include <vector>

namespace dustbench::files {

/// True if the path's last part has a `*`.
[[nodiscard]] DUSTBENCH_API bool isPattern(const std::filesystem::path& path);

/// What a path stands for now: the files that its pattern matches, sorted by name, where numbers count as numbers (8
/// before 10); without a `*` itself, if it is a file. May be empty.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> foundFiles(const std::filesystem::path& path);

/// The same, noted as inputs, as is the pattern. Throws InputError if there is none.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> matchingFiles(const std::filesystem::path& pattern);

}  // namespace dustbench::files
