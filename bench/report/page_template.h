// Fills the templates of pages, and keeps pages of others from being written over.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace dustbench::bench {

/// `text` as the content of an element.
[[nodiscard]] std::string escaped(std::string_view text);

/// Replaces each `{{name}}`. Inserted text is not expanded. Throws std::out_of_range for a name without a part.
[[nodiscard]] std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& parts);

/// Throws InputError if `folder` has such a file that was not written by this program.
void requireOwnPage(const std::filesystem::path& folder, std::string_view name = "index.html");

}  // namespace dustbench::bench
