// Fills the templates of pages, and prevents overwriting pages of other programs.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace dustbench::bench {

/// `text` as the content of an element.
[[nodiscard]] std::string escaped(std::string_view text);

/// Replaces each `{{name}}`. Inserted text is not expanded. Throws std::out_of_range for an unknown name.
[[nodiscard]] std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& parts);

/// Throws InputError if `folder` contains such a file that was not written by this program.
void requireOwnPage(const std::filesystem::path& folder, std::string_view name = "index.html");

}  // namespace dustbench::bench
