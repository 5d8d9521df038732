// Reads and writes particle systems as TOML: `[size]` and `[[force]]` tables with `part = "name"` and its parameters.
//
// A file contains one system, or several: one `[[system]]` table for each, with its `name` and its parts below it
// (`[system.size]`, `[[system.force]]`). The key `storage` of a system is described in particle_store.h. Source:
// Thesis, 3.1.4 (systems are saved and loaded; a manager of named systems).
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

struct NamedParts {
    std::string name;  ///< lower-case letters, digits and `_`; without `[[system]]` the stem of the file name
    std::unique_ptr<PartList> parts;
};

/// One or more systems with distinct names, in the order of the file. Throws InputError with file, line, the value
/// received and the values allowed. Paths of meshes and pictures are relative to the file.
[[nodiscard]] DUSTBENCH_API std::vector<NamedParts> systemsFromFile(const std::filesystem::path& file);
/// `name` is the file name used in messages; paths are relative to the working directory.
[[nodiscard]] DUSTBENCH_API std::vector<NamedParts> systemsFromText(std::string_view text, std::string name);

/// Throws as above, and if the file contains several systems, or events.
[[nodiscard]] std::unique_ptr<PartList> partsFromFile(const std::filesystem::path& file);
/// The same, events allowed. `name` is the file name used in messages.
[[nodiscard]] std::unique_ptr<PartList> partsFromText(std::string_view text, std::string name);

/// Every part with all its parameters; reading the text gives the same parts.
[[nodiscard]] std::string partsToToml(const PartList& parts);

struct NamedPartsView {
    std::string name;
    const PartList& parts;
};
/// Several systems as one file. A single one is written as above, without its name.
[[nodiscard]] DUSTBENCH_API std::string systemsToToml(std::span<const NamedPartsView> systems);

/// A part's parameters as the keys of its table: the components of a vector form one key, whose default is a list.
[[nodiscard]] DUSTBENCH_API std::vector<Parameter> tableKeys(const ParameterSet& declared);
/// A value in file syntax: `"fixed"`, `true`, `0.5`.
[[nodiscard]] DUSTBENCH_API std::string valueToToml(const Parameter& parameter, const std::string& canonical);

}  // namespace dustbench::particles
