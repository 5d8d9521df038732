// Finds the files that match a path with a `*`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dustbench::files {

/// True if the last part of the path contains a `*`.
[[nodiscard]] DUSTBENCH_API bool isPattern(const std::filesystem::path& path);

/// The files that match a pattern at this moment, sorted by name, with numbers in numerical order (8 before 10). A path
/// without a `*` yields itself if it is a file. May be empty.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> foundFiles(const std::filesystem::path& path);

/// The same; notes the files and the pattern as inputs. Throws InputError if there are none.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> matchingFiles(const std::filesystem::path& pattern);

/// For files whose names differ in one number: a clause that names the first two files between which the step differs
/// from the first step, as when a file is missing. Empty if the steps are even or cannot be determined.
[[nodiscard]] DUSTBENCH_API std::string unevenStep(const std::vector<std::filesystem::path>& files);

}  // namespace dustbench::files
