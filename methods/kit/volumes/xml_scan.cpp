#include "methods/kit/volumes/xml_scan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace dustbench::volumes {
namespace {

constexpr std::string_view blanks = " \t\r\n";

}  // namespace

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
    if (rest_.starts_with("<!")) throw VolumeFault{"it has a document type or CDATA, which no file of VTK's has"};
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
