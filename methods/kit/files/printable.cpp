#include "methods/kit/files/printable.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>

namespace dustbench::files {
namespace {

constexpr std::string_view cutMark = " […]";

struct Letter {
    std::uint32_t code = 0;
    std::size_t bytes = 0;  ///< 0: not UTF-8
};

/// The first letter of a text that is not empty.
Letter decode(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char first = byte(0);
    if (first < 0x80) return {first, 1};
    const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = first & (0xff >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return {};
        code = code << 6 | (byte(i) & 0x3f);
    }
    constexpr std::uint32_t smallest[]{0, 0, 0x80, 0x800, 0x10000};
    const bool isSurrogate = code >= 0xd800 && code < 0xe000;
    return code < smallest[bytes] || isSurrogate || code > 0x10ffff ? Letter{} : Letter{code, bytes};
}

bool isHarmless(std::uint32_t code) {
    const bool isControl = code < 0x20 || (code >= 0x7f && code < 0xa0);
    const bool turns = code == 0x061c || code == 0x200e || code == 0x200f || (code >= 0x2028 && code <= 0x202e) ||
                       (code >= 0x2066 && code <= 0x2069) || code == 0xfeff;
    return !isControl && !turns;
}

/// How the letter appears on the terminal.
std::string shown(std::string_view letter, std::uint32_t code) {
    if (code == '\n' || code == '\t' || code == '\r') return " ";
    if (code != 0 && isHarmless(code)) return std::string(letter);
    std::string escaped;
    for (const char byte : letter)
        fmt::format_to(std::back_inserter(escaped), "\\x{:02x}", static_cast<unsigned char>(byte));
    return escaped;
}

}  // namespace

std::string printable(std::string_view text, std::size_t maximumBytes) {
    std::string line;
    std::size_t fits = 0;  // bytes of the line that leave space for the ellipsis
    while (!text.empty()) {
        const Letter letter = decode(text);
        const std::string_view bytes = text.substr(0, letter.bytes == 0 ? 1 : letter.bytes);
        line += shown(bytes, letter.bytes == 0 ? 0 : letter.code);
        text.remove_prefix(bytes.size());
        if (line.size() + cutMark.size() <= maximumBytes) fits = line.size();
        if (line.size() > maximumBytes) return line.substr(0, fits).append(cutMark);
    }
    return line;
}

bool isUtf8(std::string_view text) {
    while (!text.empty()) {
        const Letter letter = decode(text);
        if (letter.bytes == 0) return false;
        text.remove_prefix(letter.bytes);
    }
    return true;
}

std::string namedPart(std::string_view kind, std::string_view name) {
    constexpr std::size_t maximumName = 60;
    return fmt::format("{} '{}'", kind, printable(name, maximumName));
}

}  // namespace dustbench::files
