// What is delivered with the program, found from where the program lies, so that both can be moved together.
#pragma once

#include <filesystem>
#include <string_view>

namespace dustbench::files {

/// `<tree>/<inTree>` for a program at <tree>/build/<preset>/, `<prefix>/<installed>` for one at <prefix>/bin/.
/// Throws InputError with both places where neither is a folder.
[[nodiscard]] DUSTBENCH_API std::filesystem::path shippedFolder(std::string_view inTree, std::string_view installed);

/// The same for a program that lies elsewhere.
[[nodiscard]] DUSTBENCH_API std::filesystem::path shippedFolder(const std::filesystem::path& program,
                                                                std::string_view inTree, std::string_view installed);

}  // namespace dustbench::files
