// Reads and writes particle systems as TOML: `[size]` and `[[force]]` tables with `part = "name"` and its parameters.
//
// Source: Thesis, 3.1.4 (systems are saved and loaded).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/particles/part_list.h"

namespace dustbench::particles {

/// Throws InputError with file, line, the value received and the values allowed.
[[nodiscard]] std::unique_ptr<PartList> partsFromFile(const std::filesystem::path& file);
/// `name` is the file name used in messages.
[[nodiscard]] std::unique_ptr<PartList> partsFromText(std::string_view text, std::string name);

/// Every part with all its parameters; reading the text gives the same parts.
[[nodiscard]] std::string partsToToml(const PartList& parts);

/// A part's parameters as the keys of its table: a vector's components form one key, whose default is a list.
[[nodiscard]] DUSTBENCH_API std::vector<Parameter> tableKeys(const ParameterSet& declared);
/// A value in file syntax: `"fixed"`, `true`, `0.5`.
[[nodiscard]] DUSTBENCH_API std::string valueToToml(const Parameter& parameter, const std::string& canonical);

}  // namespace dustbench::particles
