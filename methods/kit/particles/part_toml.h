// Particle systems as TOML: `[size]` and `[[force]]` tables, each with `part = "name"` and that part's parameters.
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

/// Throw InputError with file, line, what was got and what is allowed.
[[nodiscard]] std::unique_ptr<PartList> partsFromFile(const std::filesystem::path& file);
/// `name` stands for the file in messages.
[[nodiscard]] std::unique_ptr<PartList> partsFromText(std::string_view text, std::string name);

/// Every part with all its parameters; reading it gives the same parts.
[[nodiscard]] std::string partsToToml(const PartList& parts);

/// A part's parameters as the keys of its table: the components of a vector are one, whose default is a list.
[[nodiscard]] DUSTBENCH_API std::vector<Parameter> tableKeys(const ParameterSet& declared);
/// A value as a file says it: `"fixed"`, `true`, `0.5`.
[[nodiscard]] DUSTBENCH_API std::string valueToToml(const Parameter& parameter, const std::string& canonical);

}  // namespace dustbench::particles
