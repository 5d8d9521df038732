// Where the project's own data lie: scenes, drives, particle systems, suites, papers.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::files {

/// $DUSTBENCH_DATA where set, else the data/ folder of the source tree that the program was built from.
[[nodiscard]] DUSTBENCH_API std::filesystem::path dataFolder();

/// `data/<folder>/<id><extension>`, or `id` itself where it names a file (has a '/' or the extension).
/// Throws InputError with the nearest name; `kind` is the word for messages: `scene`, `drive`.
[[nodiscard]] DUSTBENCH_API std::filesystem::path findData(std::string_view kind, std::string_view folder,
                                                           std::string_view id, std::string_view extension);

/// Names, without extension, of the files in `data/<folder>`, sorted.
[[nodiscard]] DUSTBENCH_API std::vector<std::string> listData(std::string_view folder, std::string_view extension);

}  // namespace dustbench::files
