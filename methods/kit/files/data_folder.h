// Where data lie: scenes, drives, particle systems, suites, papers.
//
// Data have names, which are looked up in several folders of one layout. The first folder that has a name wins, so that
// a user's folder adds names and replaces those that it repeats.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::files {

/// The data delivered with the program. Throws InputError where they are missing.
[[nodiscard]] DUSTBENCH_API std::filesystem::path dataFolder();

/// The folders that $DUSTBENCH_DATA names, separated by colons. Throws InputError where one is missing or holds no
/// data.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> namedDataFolders();

/// In the order of the search: namedDataFolders(), then dataFolder(). Throws InputError where there is none at all.
[[nodiscard]] DUSTBENCH_API std::vector<std::filesystem::path> dataFolders();

/// For this process and those that it starts: instead of what $DUSTBENCH_DATA names. `option` is the word for messages.
/// Throws InputError as namedDataFolders does.
DUSTBENCH_API void useDataFolders(std::string_view option, const std::vector<std::string>& folders);

/// `<folder>/<relative>` in the first of dataFolders() that has it; empty where none has.
[[nodiscard]] DUSTBENCH_API std::filesystem::path dataPath(const std::filesystem::path& relative);

/// Names of the files `<folder>/*<extension>` in all dataFolders(), sorted, each once. `.vdb|.vti` are two extensions.
[[nodiscard]] DUSTBENCH_API std::vector<std::string> listData(std::string_view folder, std::string_view extension);

/// Names of the folders `<folder>/*/` in all dataFolders(), sorted, each once.
[[nodiscard]] DUSTBENCH_API std::vector<std::string> listDataFolders(std::string_view folder);

/// True for a file's path, which a name of data is not: it has a '/' or the extension.
[[nodiscard]] DUSTBENCH_API bool isDataFile(std::string_view nameOrFile, std::string_view extension);

/// A path within the file `from`, which is relative to that file's folder; a name stays as it is.
[[nodiscard]] DUSTBENCH_API std::string fromFile(const std::filesystem::path& from, const std::string& nameOrFile,
                                                 std::string_view extension);

/// The file that the data file `from` names by a path: relative to `from`, so that both can be moved together, else as
/// `<folder>/<named>` among the data. Notes it as an input. Throws InputError with the places that were tried and the
/// nearest name.
[[nodiscard]] DUSTBENCH_API std::filesystem::path fileNamedBy(const std::filesystem::path& from,
                                                              std::string_view folder, const std::string& named);

/// The file that a name of `<folder>` stands for, or a path itself. Throws InputError with the nearest name or file;
/// `kind` is the word for messages: `scene`, `drive`.
[[nodiscard]] DUSTBENCH_API std::filesystem::path findData(std::string_view kind, std::string_view folder,
                                                           std::string_view nameOrFile, std::string_view extension);

/// For messages: ` (did you mean 'plain.toml'?)`, or empty where nothing beside `missing` is named like it.
[[nodiscard]] DUSTBENCH_API std::string nearestBeside(const std::filesystem::path& missing);

}  // namespace dustbench::files
