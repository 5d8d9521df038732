#include "methods/kit/meshes/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "methods/kit/files/limits.h"

namespace dustbench::meshes {
namespace {

using HeaderWords = std::vector<std::string_view>;
using Kind = PlyType::Kind;

constexpr std::array<PlyType, 16> types{{{Kind::signedInteger, 1, "char"},
                                         {Kind::signedInteger, 1, "int8"},
                                         {Kind::unsignedInteger, 1, "uchar"},
                                         {Kind::unsignedInteger, 1, "uint8"},
                                         {Kind::signedInteger, 2, "short"},
                                         {Kind::signedInteger, 2, "int16"},
                                         {Kind::unsignedInteger, 2, "ushort"},
                                         {Kind::unsignedInteger, 2, "uint16"},
                                         {Kind::signedInteger, 4, "int"},
                                         {Kind::signedInteger, 4, "int32"},
                                         {Kind::unsignedInteger, 4, "uint"},
                                         {Kind::unsignedInteger, 4, "uint32"},
                                         {Kind::floating, 4, "float"},
                                         {Kind::floating, 4, "float32"},
                                         {Kind::floating, 8, "double"},
                                         {Kind::floating, 8, "float64"}}};

PlyType typeOf(const Lines& lines, std::string_view name, bool isCount) {
    const auto found = std::ranges::find(types, name, &PlyType::name);
    if (found == types.end() || (isCount && !found->isInteger()))
        lines.fail(fmt::format("unknown type {}, expected one like {}", inQuotes(name),
                               isCount ? "uchar or int" : "float, uchar or int"));
    return *found;
}

PlyFormat formatOf(const Lines& lines, const HeaderWords& words) {
    if (words.size() != 3 || words[2] != "1.0") lines.fail("expected a format line such as 'format ascii 1.0'");
    if (words[1] == "ascii") return PlyFormat::ascii;
    if (words[1] == "binary_little_endian") return PlyFormat::littleEndian;
    if (words[1] == "binary_big_endian") return PlyFormat::bigEndian;
    lines.fail(fmt::format("unknown format {}, expected ascii, binary_little_endian or binary_big_endian",
                           inQuotes(words[1])));
}

void addElement(const Lines& lines, const HeaderWords& words, PlyHeader& header) {
    const auto count = words.size() == 3 ? parse<std::int64_t>(words[2]) : std::nullopt;
    if (!count || *count < 0 || *count > files::limits::meshElements)
        lines.fail(
            fmt::format("expected 'element NAME COUNT' with a number of elements 0..{}", files::limits::meshElements));
    if (std::ranges::find(header.elements, words[1], &PlyElement::name) != header.elements.end())
        lines.fail(fmt::format("element {} occurs twice", inQuotes(words[1])));
    header.elements.push_back({std::string(words[1]), *count, {}});
}

PlyProperty propertyOf(const Lines& lines, const HeaderWords& words) {
    if (words.size() == 3) return {std::string(words[2]), typeOf(lines, words[1], false)};
    if (words.size() == 5 && words[1] == "list")
        return {std::string(words[4]), typeOf(lines, words[3], false), true, typeOf(lines, words[2], true)};
    lines.fail("expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
}

void addProperty(const Lines& lines, const HeaderWords& words, PlyHeader& header) {
    if (header.elements.empty()) lines.fail("a property before the first element");
    PlyElement& element = header.elements.back();
    PlyProperty property = propertyOf(lines, words);
    if (element.find(property.name) >= 0)
        lines.fail(fmt::format("property {} occurs twice in {}", inQuotes(property.name), inQuotes(element.name)));
    element.properties.push_back(std::move(property));
}

/// The body of a file whose elements are empty cannot be distinguished from a damaged header.
void requireProperties(const Lines& lines, const PlyHeader& header) {
    for (const PlyElement& element : header.elements)
        if (element.properties.empty() && element.count > 0)
            lines.fail(fmt::format("element {} has no properties", inQuotes(element.name)));
}

}  // namespace

int PlyElement::find(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &PlyProperty::name);
    return found == properties.end() ? -1 : static_cast<int>(found - properties.begin());
}

PlyHeader readPlyHeader(Lines& lines) {
    PlyHeader header;
    std::optional<PlyFormat> format;
    std::string_view line;
    if (!lines.next(line) || wordsOf(line) != HeaderWords{"ply"}) lines.fail("expected 'ply' in the first line");
    while (lines.next(line)) {
        const HeaderWords words = wordsOf(line);
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words == HeaderWords{"end_header"}) {
            if (!format) lines.fail("the header has no format line");
            requireProperties(lines, header);
            header.format = *format;
            return header;
        }
        if (words[0] == "format" && !format)
            format = formatOf(lines, words);
        else if (words[0] == "element")
            addElement(lines, words, header);
        else if (words[0] == "property")
            addProperty(lines, words, header);
        else
            lines.fail(fmt::format("got {}, expected a line of a PLY header", inQuotes(line)));
    }
    lines.fail("the header has no end");
}

}  // namespace dustbench::meshes
