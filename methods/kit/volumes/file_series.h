// The files that a path stands for, with their times: one file, several by a `*` in its name, or those that an index
// names (`.pvd`, `.series`).
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace dustbench::volumes {

struct SeriesEntry {
    std::filesystem::path file;
    std::optional<double> timeSeconds;  ///< as the index says
};

/// True for a path that stands for several files, or whose files another one names.
[[nodiscard]] DUSTBENCH_API bool isIndex(const std::filesystem::path& path);

/// In the order of the index, or sorted by name. Notes an index as an input, the files not. `kind` is the word for
/// messages: `dust`. Throws InputError, one line with the file.
[[nodiscard]] DUSTBENCH_API std::vector<SeriesEntry> seriesEntries(const std::filesystem::path& path,
                                                                   std::string_view kind);

}  // namespace dustbench::volumes
