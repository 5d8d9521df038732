// SHA-256, to identify inputs and runs by their content: the digest that `sha256sum` prints.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dustbench::bench {

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Digest of a file's content; empty if it cannot be read.
[[nodiscard]] std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace dustbench::bench
