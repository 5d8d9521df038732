// Finds files delivered with the program relative to the program, so that both can be moved together.
#pragma once

#include <filesystem>
#include <string_view>

namespace dustbench::files {

/// `<tree>/<inTree>` for a program in <tree>/build/<preset>/, `<prefix>/<installed>` for one in <prefix>/bin/. Throws
/// InputError with both paths if neither is a folder.
[[nodiscard]] DUSTBENCH_API std::filesystem::path shippedFolder(std::string_view inTree, std::string_view installed);

/// The same for a program in another place.
[[nodiscard]] DUSTBENCH_API std::filesystem::path shippedFolder(const std::filesystem::path& program,
                                                                std::string_view inTree, std::string_view installed);

}  // namespace dustbench::files
