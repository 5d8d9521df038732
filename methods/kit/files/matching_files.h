// The files that a path with a `*` stands for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dustbench::files {

/// True if the path's last part has a `*`.
[[nodiscard]] DUSTBENCH_API bool isPattern(const std::filesystem::path& path);

/// What a path stands for now: the files that its pattern matches, sorted by name, where numbers count as numbers (8
/// before 10); without a `*` itself, if it is a file. May be empty.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> foundFiles(const std::filesystem::path& path);

/// The same, noted as inputs, as is the pattern. Throws InputError if there is none.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> matchingFiles(const std::filesystem::path& pattern);

/// Of files whose names differ in one number: a clause that names the first two between which the number takes another
/// step than between the first two of all, as where a file is missing; empty if the steps are even, or cannot be told.
[[nodiscard]] DUSTBENCH_API std::string unevenStep(const std::vector<std::filesystem::path>& files);

}  // namespace dustbench::files
