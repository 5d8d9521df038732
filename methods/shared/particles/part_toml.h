// Particle systems as TOML: `[size]` and `[[force]]` tables, each with `part = "name"` and that part's parameters.
//
// Source: Thesis, 3.1.4 (systems are saved and loaded).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "methods/shared/particles/part_list.h"

namespace dustbench::particles {

/// Throw InputError with file, line, what was got and what is allowed.
[[nodiscard]] std::unique_ptr<PartList> partsFromFile(const std::filesystem::path& file);
/// `name` stands for the file in messages.
[[nodiscard]] std::unique_ptr<PartList> partsFromText(std::string_view text, std::string name);

/// Every part with all its parameters; reading it gives the same parts.
[[nodiscard]] std::string partsToToml(const PartList& parts);

}  // namespace dustbench::particles
