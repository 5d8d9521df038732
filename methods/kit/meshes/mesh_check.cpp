#include "methods/kit/meshes/mesh_check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/errors.h"

namespace dustbench::meshes {
namespace {

/// No real mesh has this many elements; a larger count means a broken header.
constexpr std::int64_t maximumElements = 100'000'000;

std::string wholeFile(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> list;
    constexpr std::string_view blank = " \t\r\f\v";
    for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
        list.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(blank, end);
    }
    return list;
}

template <typename Number>
std::optional<Number> parse(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Iterates over a text's lines and counts them for messages.
class Lines {
 public:
    Lines(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

    [[nodiscard]] bool next(std::string_view& line) {
        if (at_ >= text_.size()) return false;
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        line = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        return true;
    }
    [[nodiscard]] std::size_t offset() const { return std::min(at_, text_.size()); }
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(file_.string() + ":" + std::to_string(std::max<std::size_t>(number_, 1)) + ": " + what);
    }
    void requireNumber(std::string_view word) const {
        const auto value = parse<double>(word);
        if (!value || !std::isfinite(*value)) fail("got '" + std::string(word.substr(0, 40)) + "', expected a number");
    }

 private:
    std::string_view text_;
    const std::filesystem::path& file_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

/// Checks one corner of a face: `7`, `7/2`, `7//3` or `7/2/3`, counted from 1, or from the end if negative.
void checkCorner(const Lines& lines, std::string_view corner, const std::array<std::int64_t, 3>& given) {
    static constexpr std::array kinds{"vertex", "texture coordinate", "normal"};
    std::size_t part = 0;
    for (std::string_view rest = corner;; ++part) {
        const std::size_t slash = rest.find('/');
        const std::string_view text = rest.substr(0, slash);
        if (part > 2) lines.fail("got '" + std::string(corner.substr(0, 40)) + "', expected vertex/texture/normal");
        if (!text.empty() || part == 0) {
            const auto index = parse<std::int64_t>(text);
            if (!index || *index == 0 || *index > given[part] || *index < -given[part])
                lines.fail("a face names " + std::string(kinds[part]) + " '" + std::string(text.substr(0, 40)) +
                           "', expected 1.." + std::to_string(given[part]));
        }
        if (slash == std::string_view::npos) return;
        rest.remove_prefix(slash + 1);
    }
}

struct PlyProperty {
    std::size_t countBytes = 0;  ///< size of a list's count; 0: not a list
    std::size_t valueBytes = 0;
};

struct PlyElement {
    std::string name;
    std::int64_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    std::string format;
    std::vector<PlyElement> elements;
};

std::size_t bytesOf(const Lines& lines, std::string_view type, bool isCount) {
    static const std::map<std::string_view, std::size_t> sizes{
        {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
        {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
        {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
    const auto found = sizes.find(type);
    if (found == sizes.end() || (isCount && (type.starts_with("float") || type.starts_with("double"))))
        lines.fail("unknown type '" + std::string(type.substr(0, 40)) + "', expected one like " +
                   (isCount ? "uchar or int" : "float, uchar or int"));
    return found->second;
}

PlyHeader readHeader(Lines& lines) {
    PlyHeader header;
    std::string_view line;
    if (!lines.next(line) || words(line) != std::vector<std::string_view>{"ply"})
        lines.fail("expected 'ply' in the first line");
    while (lines.next(line)) {
        const auto word = words(line);
        if (word.empty() || word[0] == "comment" || word[0] == "obj_info") continue;
        if (word[0] == "end_header") {
            if (header.format.empty()) lines.fail("the header has no format line");
            return header;
        }
        if (word[0] == "format" && word.size() == 3) {
            header.format = word[1];
            if (header.format != "ascii" && header.format != "binary_little_endian" &&
                header.format != "binary_big_endian")
                lines.fail("unknown format '" + header.format.substr(0, 40) + "'");
        } else if (word[0] == "element" && word.size() == 3) {
            const auto count = parse<std::int64_t>(word[2]);
            if (!count || *count < 0 || *count > maximumElements) lines.fail("expected a number of elements");
            header.elements.push_back({std::string(word[1]), *count, {}});
        } else if (word[0] == "property" && word.size() == 3 && !header.elements.empty()) {
            header.elements.back().properties.push_back({0, bytesOf(lines, word[1], false)});
        } else if (word[0] == "property" && word.size() == 5 && word[1] == "list" && !header.elements.empty()) {
            header.elements.back().properties.push_back(
                {bytesOf(lines, word[2], true), bytesOf(lines, word[3], false)});
        } else {
            lines.fail("got '" + std::string(line.substr(0, 40)) + "', expected a line of a PLY header");
        }
    }
    lines.fail("the header has no end");
}

void checkAsciiElement(Lines& lines, const PlyElement& element) {
    std::string_view line;
    std::vector<std::string_view> word;
    do {
        if (!lines.next(line)) lines.fail("the file ends within its " + element.name + " elements");
        word = words(line);
    } while (word.empty());
    std::size_t at = 0;
    for (const PlyProperty& property : element.properties) {
        std::int64_t values = 1;
        if (property.countBytes > 0) {
            const auto count = at < word.size() ? parse<std::int64_t>(word[at]) : std::nullopt;
            if (!count || *count < 0) lines.fail("expected the length of a list");
            values = *count;
            ++at;
        }
        if (values > static_cast<std::int64_t>(word.size() - at)) lines.fail("too few numbers for one " + element.name);
        for (; values > 0; --values) lines.requireNumber(word[at++]);
    }
}

std::int64_t readCount(const char* data, std::size_t bytes, bool bigEndian) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i)
        value = value << 8 | static_cast<unsigned char>(data[bigEndian ? i : bytes - 1 - i]);
    return static_cast<std::int64_t>(value);
}

void checkBinaryElement(std::string_view body, std::size_t& at, const PlyElement& element, bool bigEndian,
                        const std::filesystem::path& file) {
    const auto need = [&](std::uint64_t bytes) {
        if (bytes > body.size() - at)
            throw InputError(file.string() + ": the file ends within its " + element.name + " elements");
    };
    for (const PlyProperty& property : element.properties) {
        std::int64_t values = 1;
        if (property.countBytes > 0) {
            need(property.countBytes);
            values = readCount(body.data() + at, property.countBytes, bigEndian);
            at += property.countBytes;
        }
        need(static_cast<std::uint64_t>(values) * property.valueBytes);
        at += static_cast<std::size_t>(values) * property.valueBytes;
    }
}

}  // namespace

void checkObj(const std::filesystem::path& file) {
    const std::string text = wholeFile(file);
    Lines lines(text, file);
    std::array<std::int64_t, 3> given{};  // vertices, texture coordinates, normals
    for (std::string_view line; lines.next(line);) {
        const auto word = words(line);
        if (word.empty()) continue;
        static constexpr std::array<std::string_view, 3> keys{"v", "vt", "vn"};
        const auto key = std::ranges::find(keys, word[0]);
        if (key != keys.end()) {
            if (word.size() < (word[0] == "vt" ? 2u : 4u))
                lines.fail("too few numbers after '" + std::string(word[0]) + "'");
            for (std::size_t i = 1; i < word.size(); ++i) lines.requireNumber(word[i]);
            ++given[static_cast<std::size_t>(key - keys.begin())];
        } else if (word[0] == "f") {
            if (word.size() < 4) lines.fail("a face has fewer than three corners");
            for (std::size_t i = 1; i < word.size(); ++i) checkCorner(lines, word[i], given);
        }
    }
    if (given[0] == 0) throw InputError(file.string() + ": the mesh has no vertices ('v x y z')");
}

void checkPly(const std::filesystem::path& file) {
    const std::string text = wholeFile(file);
    Lines lines(text, file);
    const PlyHeader header = readHeader(lines);
    std::size_t at = lines.offset();
    for (const PlyElement& element : header.elements)
        for (std::int64_t i = 0; i < element.count; ++i) {
            if (header.format == "ascii")
                checkAsciiElement(lines, element);
            else
                checkBinaryElement(text, at, element, header.format == "binary_big_endian", file);
        }
}

}  // namespace dustbench::meshes
