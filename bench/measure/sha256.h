// SHA-256 digests, as printed by `sha256sum`; they identify inputs and runs by content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "methods/kit/files/limits.h"

struct evp_md_ctx_st;  // OpenSSL's

namespace dustbench::measure {

/// A digest of bytes that arrive in parts.
class Sha256 {
 public:
    Sha256();
    void add(std::string_view bytes);
    /// 64 hexadecimal digits. Nothing can be added afterwards.
    [[nodiscard]] std::string text();

 private:
    std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// Digest of a file's content, read block by block; empty if it cannot be read or is longer.
[[nodiscard]] std::string sha256OfFile(const std::filesystem::path& file,
                                       std::uintmax_t maximumBytes = files::limits::geometryBytes);

}  // namespace dustbench::measure
