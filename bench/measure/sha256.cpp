#include "bench/measure/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "methods/kit/files/machine_error.h"
#include "methods/kit/files/whole_text.h"

namespace dustbench::measure {
namespace {

void require(int succeeded) {
    if (!succeeded) throw std::runtime_error("SHA-256 cannot be computed: OpenSSL failed");
}

}  // namespace

Sha256::Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    require(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr));
}

void Sha256::add(std::string_view bytes) {
    require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()));
}

std::string Sha256::text() {
    std::array<unsigned char, 32> digest{};
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr));
    std::string text;
    for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
    return text;
}

std::string sha256(std::string_view bytes) {
    Sha256 digest;
    digest.add(bytes);
    return digest.text();
}

std::string sha256OfFile(const std::filesystem::path& file, std::uintmax_t maximumBytes) {
    if (!files::refusalOf(file, maximumBytes).empty()) return "";
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::vector<char> block(std::size_t{1} << 20);
    Sha256 digest;
    std::uintmax_t bytes = 0;
    do {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        const auto got = static_cast<std::size_t>(stream.gcount());
        bytes += got;
        digest.add({block.data(), got});
    } while (stream && bytes <= maximumBytes);
    if (!stream.eof() && files::isShortage(errno))
        throw files::MachineError(fmt::format("{} cannot be read: {}", file.string(), std::strerror(errno)));
    return stream.eof() && bytes <= maximumBytes ? digest.text() : "";
}

}  // namespace dustbench::measure
