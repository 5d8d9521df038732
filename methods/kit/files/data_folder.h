// Finds data: scenes, drives, particle systems, suites, papers.
//
// Data have names, which are looked up in several folders of the same layout. The first folder that contains a name
// wins, so a user's folder can add names and replace existing ones.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::files {

/// The data delivered with the program. Throws InputError if they are missing.
[[nodiscard]] DUSTBENCH_API std::filesystem::path dataFolder();

/// The folders that $DUSTBENCH_DATA names, separated by colons. Throws InputError if one is missing or contains no
/// data.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> namedDataFolders();

/// In search order: namedDataFolders(), then dataFolder(). Throws InputError if there is none.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> dataFolders();

/// Replaces the folders of $DUSTBENCH_DATA for this process and those that it starts. `option` names the source in
/// messages. Throws InputError as namedDataFolders does.
DUSTBENCH_API void useDataFolders(std::string_view option, const std::vector<std::string>& folders);

/// `<folder>/<relative>` in the first of dataFolders() that contains it; empty if none does.
[[nodiscard]] DUSTBENCH_API std::filesystem::path dataPath(const std::filesystem::path& relative);

/// Names of the files `<folder>/*<extension>` in all dataFolders(), sorted, each once. `.vdb|.vti` are two extensions.
[[nodiscard]] DUSTBENCH_API std::vector<std::string> listData(std::string_view folder, std::string_view extension);

/// Names of the folders `<folder>/*/` in all dataFolders(), sorted, each once.
[[nodiscard]] DUSTBENCH_API std::vector<std::string> listDataFolders(std::string_view folder);

/// True if the text is a path rather than a name of data: it contains a '/' or ends in the extension.
[[nodiscard]] DUSTBENCH_API bool isDataFile(std::string_view nameOrFile, std::string_view extension);

/// Resolves a path in the file `from`, which is relative to that file's folder; returns a name unchanged.
[[nodiscard]] DUSTBENCH_API std::string fromFile(const std::filesystem::path& from, const std::string& nameOrFile,
                                                 std::string_view extension);

/// The file that the data file `from` names by a path: relative to `from`, so that both can be moved together, or
/// else `<folder>/<named>` in the data. Notes it as an input. Throws InputError with the places that were tried and
/// the nearest name.
[[nodiscard]] DUSTBENCH_API std::filesystem::path fileNamedBy(const std::filesystem::path& from,
                                                              std::string_view folder, const std::string& named);

/// The file of a name in `<folder>`, or the path itself if one is given. Throws InputError with the nearest name or
/// file; `kind` is the noun for messages: `scene`, `drive`.
[[nodiscard]] DUSTBENCH_API std::filesystem::path findData(std::string_view kind, std::string_view folder,
                                                           std::string_view nameOrFile, std::string_view extension);

/// For messages: ` (did you mean 'plain.toml'?)`, or empty if no neighbour of `missing` has a similar name.
[[nodiscard]] DUSTBENCH_API std::string didYouMean(const std::filesystem::path& missing);

}  // namespace dustbench::files
