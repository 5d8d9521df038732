#include "methods/kit/volumes/xml_scan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

namespace dustbench::volumes {
namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The code point as UTF-8; empty if XML does not allow it.
std::string encodedUtf8(std::uint32_t code) {
    if (code == 0 || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return "";
    if (code < 0x80) return {static_cast<char>(code)};
    const auto byte = [&](std::uint32_t mark, int shift) { return static_cast<char>(mark | (code >> shift & 0x3f)); };
    if (code < 0x800) return {byte(0xc0, 6), byte(0x80, 0)};
    if (code < 0x10000) return {byte(0xe0, 12), byte(0x80, 6), byte(0x80, 0)};
    return {byte(0xf0, 18), byte(0x80, 12), byte(0x80, 6), byte(0x80, 0)};
}

/// The character of the reference between `&` and `;`.
std::string decodedReference(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, char>, 5> named{
        {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};
    for (const auto& [each, character] : named)
        if (name == each) return {character};
    std::string character;
    if (name.starts_with('#')) {
        const bool isHexadecimal = name.starts_with("#x");
        const std::string_view digits = name.substr(isHexadecimal ? 2 : 1);
        std::uint32_t code = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), code, isHexadecimal ? 16 : 10);
        if (error == std::errc() && end == digits.data() + digits.size()) character = encodedUtf8(code);
    }
    if (character.empty()) throw VolumeFault{fmt::format("it has the reference '&{};', unknown to XML", name)};
    return character;
}

}  // namespace

std::string Tag::text(std::string_view attribute) const {
    std::string decoded;
    std::string_view rest = (*this)[attribute];
    for (std::size_t at = 0; (at = rest.find('&')) != std::string_view::npos;) {
        decoded += rest.substr(0, at);
        rest.remove_prefix(at + 1);
        constexpr std::size_t longest = 10;
        const std::size_t end = std::min(rest.substr(0, longest).find(';'), rest.size());
        decoded += decodedReference(rest.substr(0, std::min(end, longest)));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return decoded += rest;
}

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::size_t choice(const Tag& tag, std::string_view attribute, std::initializer_list<std::string_view> words) {
    const auto* const found = tag.has(attribute) ? std::ranges::find(words, tag[attribute]) : words.begin();
    if (found == words.end())
        throw VolumeFault{fmt::format("its {} is '{}', allowed: {}", attribute, tag[attribute].substr(0, 40),
                                      fmt::join(words, ", "))};
    return static_cast<std::size_t>(found - words.begin());
}

std::string_view XmlScan::next(std::optional<Tag>& tag) {
    tag.reset();
    const std::size_t start = std::min(rest_.find('<'), rest_.size());
    const std::string_view before = rest_.substr(0, start);
    rest_.remove_prefix(start);
    while (rest_.starts_with("<!--") || rest_.starts_with("<?")) {
        skipPast(rest_[1] == '?' ? "?>" : "-->");
        if (!trimmed(before).empty()) throw VolumeFault{"it has a comment within its data"};
        skipBlanks();
    }
    if (rest_.empty()) return before;
    if (rest_.starts_with("<!")) throw VolumeFault{"it has a document type or CDATA, which VTK's files do not have"};
    if (!rest_.starts_with("<")) throw VolumeFault{"it has text outside of its arrays"};
    tag = readTag();
    return before;
}

bool XmlScan::take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
}

void XmlScan::skipPast(std::string_view end) {
    const std::size_t at = rest_.find(end);
    if (at == std::string_view::npos) throw VolumeFault{"it ends within its XML"};
    rest_.remove_prefix(at + end.size());
}

void XmlScan::skipBlanks() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size()));
}

std::string_view XmlScan::readName() {
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n=/>\"'<"), rest_.size());
    const std::string_view name = rest_.substr(0, end);
    rest_.remove_prefix(end);
    if (name.empty()) throw VolumeFault{"its XML is damaged"};
    return name;
}

Tag XmlScan::readTag() {
    Tag tag;
    rest_.remove_prefix(1);
    if (take("/")) tag.kind = Tag::Kind::close;
    tag.name = readName();
    for (skipBlanks(); !take(">"); skipBlanks()) {
        if (take("/>")) {
            if (tag.kind == Tag::Kind::close) throw VolumeFault{"its XML is damaged"};
            tag.kind = Tag::Kind::whole;
            break;
        }
        readAttribute(tag);
    }
    return tag;
}

void XmlScan::readAttribute(Tag& tag) {
    const std::string_view name = readName();
    skipBlanks();
    if (tag.kind == Tag::Kind::close || !take("=")) throw VolumeFault{"its XML is damaged"};
    skipBlanks();
    const char quote = rest_.empty() ? ' ' : rest_.front();
    const std::size_t end = quote == '"' || quote == '\'' ? rest_.find(quote, 1) : std::string_view::npos;
    if (end == std::string_view::npos || !tag.attributes.emplace(name, rest_.substr(1, end - 1)).second)
        throw VolumeFault{"its XML is damaged"};
    rest_.remove_prefix(end + 1);
}

}  // namespace dustbench::volumes
