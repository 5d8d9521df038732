// SHA-256 digests, as printed by `sha256sum`; they identify inputs and runs by content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "methods/kit/files/limits.h"

namespace dustbench::bench {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Digest of a file's content, read block by block; empty if it cannot be read or is longer.
[[nodiscard]] std::string sha256OfFile(const std::filesystem::path& file,
                                       std::uintmax_t maximumBytes = files::limits::geometryBytes);

}  // namespace dustbench::bench
