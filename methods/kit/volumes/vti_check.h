// Checks a file of VTK's image data before VTK reads it, which trusts it: elements that belong together, extents that
// can be allocated, arrays that hold something.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace dustbench::volumes {

/// Cells of a volume.
inline constexpr std::int64_t maximumCells = 256'000'000;

/// Empty if the file can be handed to VTK, else the reason as one clause. What the arrays hold is not looked at.
[[nodiscard]] DUSTBENCH_API std::string vtiFault(const std::filesystem::path& file);

}  // namespace dustbench::volumes
