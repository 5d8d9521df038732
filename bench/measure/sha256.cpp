#include "bench/measure/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <stdexcept>

#include "methods/kit/files/whole_text.h"

namespace dustbench::bench {

std::string sha256(std::string_view bytes) {
    std::array<unsigned char, 32> digest{};
    if (!EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr))
        throw std::runtime_error("SHA-256 cannot be computed: the OpenSSL library refuses");
    std::string text;
    for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
    return text;
}

std::string sha256OfFile(const std::filesystem::path& file) {
    if (!files::refusalOf(file, files::limits::geometryBytes).empty()) return "";
    return sha256(files::wholeText(file, "a file", files::limits::geometryBytes));
}

}  // namespace dustbench::bench
