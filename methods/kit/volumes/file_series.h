// Finds the files of a series with their times: one file, several that match a `*` in the name, or those that an index
// (`.pvd`, `.series`) names.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace dustbench::volumes {

struct SeriesEntry {
    std::filesystem::path file;
    std::optional<double> timeSeconds;  ///< as given in the index
};

/// True for a path that matches several files, or for an index that names them.
[[nodiscard]] DUSTBENCH_API bool isIndex(const std::filesystem::path& path);

/// In the order of the index, or sorted by name. Notes the index as an input, but not the files. `kind` is the noun for
/// messages: `dust`. Throws InputError with the file in one line.
[[nodiscard]] DUSTBENCH_API std::vector<SeriesEntry> seriesEntries(const std::filesystem::path& path,
                                                                   std::string_view kind);

}  // namespace dustbench::volumes
