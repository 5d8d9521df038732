// The files that a path with a `*` stands for.
#pragma once

#include <filesystem>
#include <vector>

namespace dustbench::files {

/// True if the path's last part has a `*`.
[[nodiscard]] DUSTBENCH_API bool isPattern(const std::filesystem::path& path);

/// Sorted by name; a path without a `*` stands for itself. Notes them as inputs. Throws InputError if there is none.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> matchingFiles(const std::filesystem::path& pattern);

}  // namespace dustbench::files
