#include "methods/kit/meshes/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/meshes/mesh_text.h"
#include "methods/kit/meshes/ply_header.h"

namespace dustbench::meshes {
namespace {

using PlyWords = std::vector<std::string_view>;

/// True if the type can represent the value; floating-point types accept all values.
bool holds(const PlyType& type, double value) {
    if (!type.isInteger()) return true;
    const int bits = static_cast<int>(8 * type.bytes);
    const bool isSigned = type.kind == PlyType::Kind::signedInteger;
    const double end = std::ldexp(1.0, isSigned ? bits - 1 : bits);
    return value == std::floor(value) && value < end && value >= (isSigned ? -end : 0);
}

/// The values of consecutive elements in a text body: one line each.
class TextBody {
 public:
    explicit TextBody(Lines& lines) : lines_(lines) {}

    void begin(const PlyElement& element) {
        element_ = &element;
        if (!lines_.nextWords(words_)) fail(fmt::format("the file ends within its {} elements", element.name));
        at_ = 0;
    }
    [[nodiscard]] double value(const PlyType& type) {
        if (at_ >= words_.size()) fail(fmt::format("too few numbers for one {}", element_->name));
        const std::string_view word = words_[at_++];
        const auto value = parse<double>(word);
        if (!value || !holds(type, *value))
            fail(fmt::format("got {}, expected a number of type {}", inQuotes(word), type.name));
        return *value;
    }
    void end() const {
        if (at_ < words_.size()) fail(fmt::format("too many numbers for one {}", element_->name));
    }
    void finish() {
        if (lines_.nextWords(words_)) fail("text after the last element");
        lines_.requireLineEnd();
    }
    [[noreturn]] void fail(const std::string& what) const { lines_.fail(what); }

 private:
    Lines& lines_;
    const PlyElement* element_ = nullptr;
    PlyWords words_;
    std::size_t at_ = 0;
};

/// The same for a binary body.
class BinaryBody {
 public:
    BinaryBody(std::string_view bytes, bool bigEndian, const std::filesystem::path& file)
        : rest_(bytes), swaps_(bigEndian == (std::endian::native == std::endian::little)), file_(file) {}

    void begin(const PlyElement& element) { element_ = &element; }
    [[nodiscard]] double value(const PlyType& type) {
        if (rest_.size() < type.bytes) fail(fmt::format("the file ends within its {} elements", element_->name));
        std::array<char, 8> bytes{};
        for (std::size_t i = 0; i < type.bytes && i < bytes.size(); ++i)
            bytes[i] = rest_[swaps_ ? type.bytes - 1 - i : i];
        rest_.remove_prefix(type.bytes);
        return numberOf(type, bytes);
    }
    void end() const {}
    void finish() const {
        if (!rest_.empty()) fail(fmt::format("{} bytes follow the last element", rest_.size()));
    }
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: {}", file_.string(), what));
    }

 private:
    template <typename Number>
    static double as(const std::array<char, 8>& bytes) {
        Number number;
        std::memcpy(&number, bytes.data(), sizeof number);
        return static_cast<double>(number);
    }
    static double numberOf(const PlyType& type, const std::array<char, 8>& bytes) {
        if (!type.isInteger()) return type.bytes == 4 ? as<float>(bytes) : as<double>(bytes);
        const bool isSigned = type.kind == PlyType::Kind::signedInteger;
        if (type.bytes == 1) return isSigned ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
        if (type.bytes == 2) return isSigned ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
        return isSigned ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
    }

    std::string_view rest_;
    bool swaps_;
    const std::filesystem::path& file_;
    const PlyElement* element_ = nullptr;
};

/// Indices of three properties in an element; -1: none.
using Triple = std::array<int, 3>;

Triple tripleOf(const PlyElement& element, const std::array<std::string_view, 3>& names) {
    const Triple triple{element.find(names[0]), element.find(names[1]), element.find(names[2])};
    return *std::ranges::min_element(triple) < 0 ? Triple{-1, -1, -1} : triple;
}

/// Indices of the values of interest in an element, with their types checked.
struct Columns {
    Triple position{-1, -1, -1}, normal{-1, -1, -1}, colour{-1, -1, -1};
    int corners = -1;
};

class Places {
 public:
    explicit Places(const std::filesystem::path& file) : file_(file) {}

    [[nodiscard]] Columns ofVertex(const PlyElement& element) const {
        Columns columns;
        columns.position = tripleOf(element, {"x", "y", "z"});
        if (columns.position[0] < 0) fail("its vertices have no x, y and z");
        columns.normal = tripleOf(element, {"nx", "ny", "nz"});
        columns.colour = colourOf(element);
        for (const Triple& triple : {columns.position, columns.normal}) requireSingle(element, triple);
        return columns;
    }
    [[nodiscard]] Columns ofFace(const PlyElement& element) const {
        Columns columns;
        columns.corners = std::max(element.find("vertex_indices"), element.find("vertex_index"));
        if (columns.corners < 0) fail("its faces have no list vertex_indices");
        const PlyProperty& list = element.properties[static_cast<std::size_t>(columns.corners)];
        if (!list.isList || !list.type.isInteger())
            fail(fmt::format("property {} is not a list of integers, expected 'property list uchar int {}'",
                             inQuotes(list.name), list.name.substr(0, 40)));
        columns.colour = colourOf(element);
        return columns;
    }

 private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: {}", file_.string(), what));
    }
    void requireSingle(const PlyElement& element, const Triple& triple) const {
        for (const int place : triple)
            if (place >= 0 && element.properties[static_cast<std::size_t>(place)].isList)
                fail(fmt::format("property '{}' is a list, expected one number",
                                 element.properties[static_cast<std::size_t>(place)].name));
    }
    [[nodiscard]] Triple colourOf(const PlyElement& element) const {
        Triple colour = tripleOf(element, {"red", "green", "blue"});
        if (colour[0] < 0) colour = tripleOf(element, {"diffuse_red", "diffuse_green", "diffuse_blue"});
        requireSingle(element, colour);
        for (const int place : colour) {
            if (place < 0) continue;
            const PlyProperty& property = element.properties[static_cast<std::size_t>(place)];
            if (property.type.bytes != 1 || property.type.kind != PlyType::Kind::unsignedInteger)
                fail(fmt::format("property '{}' of its {} elements is {}, expected uchar", property.name, element.name,
                                 property.type.name));
        }
        return colour;
    }

    const std::filesystem::path& file_;
};

template <typename Body>
class PlyReader {
 public:
    PlyReader(const PlyHeader& header, Body& body, const std::filesystem::path& file)
        : header_(header), body_(body), file_(file) {}

    Polygons read() {
        for (const PlyElement& element : header_.elements) {
            if (element.count == 0) continue;
            const bool isVertex = element.name == "vertex", isFace = element.name == "face";
            if (isVertex) columns_ = Places(file_).ofVertex(element);
            if (isFace) columns_ = Places(file_).ofFace(element);
            noteIgnored(element, isVertex || isFace);
            for (std::int64_t i = 0; i < element.count; ++i) {
                readValues(element, isFace);
                if (isVertex) addVertex();
                if (isFace) addFace();
            }
            columns_ = {};
        }
        body_.finish();
        requireWhole();
        return std::move(mesh_);
    }

 private:
    /// One element: single values by property; the list of corners goes to `corners_`.
    void readValues(const PlyElement& element, bool isFace) {
        body_.begin(element);
        values_.assign(element.properties.size(), 0);
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (!property.isList)
                values_[p] = body_.value(property.type);
            else if (isFace && static_cast<int>(p) == columns_.corners)
                readCorners(property);
            else
                for (auto rest = listLength(property); rest > 0; --rest) (void)body_.value(property.type);
        }
        body_.end();
    }

    void noteIgnored(const PlyElement& element, bool isUsed) {
        if (!isUsed) return mesh_.ignored.push_back(files::namedPart("element", element.name));
        for (int place = 0; place < static_cast<int>(element.properties.size()); ++place) {
            const auto has = [place](const Triple& triple) { return std::ranges::find(triple, place) != triple.end(); };
            if (place == columns_.corners || has(columns_.position) || has(columns_.normal) || has(columns_.colour))
                continue;
            const std::string& name = element.properties[static_cast<std::size_t>(place)].name;
            mesh_.ignored.push_back(files::namedPart("property", name) + " of " + element.name);
        }
    }

    std::int64_t listLength(const PlyProperty& property) {
        const auto length = static_cast<std::int64_t>(body_.value(property.countType));
        if (length < 0) body_.fail(fmt::format("list '{}' has a length of {}", property.name.substr(0, 40), length));
        return length;
    }

    void readCorners(const PlyProperty& property) {
        const std::int64_t count = listLength(property);
        if (count < 3 || count > files::limits::polygonCorners)
            body_.fail(fmt::format("a face has {} corners, allowed: 3..{}", count, files::limits::polygonCorners));
        for (std::int64_t k = 0; k < count; ++k) {
            const double index = body_.value(property.type);
            if (index < 0) body_.fail(fmt::format("a face uses vertex {}, expected 0 or more", index));
            mesh_.corners.push_back(static_cast<std::uint32_t>(index));
        }
    }

    [[nodiscard]] glm::vec3 vectorOf(const Triple& places) {
        glm::vec3 vector;
        for (int k = 0; k < 3; ++k) {
            vector[k] = static_cast<float>(values_[static_cast<std::size_t>(places[static_cast<std::size_t>(k)])]);
            if (!std::isfinite(vector[k])) body_.fail("a vertex or its normal is not finite");
        }
        return vector;
    }
    [[nodiscard]] Colour8 colourOf() const {
        Colour8 colour{};
        for (std::size_t k = 0; k < 3; ++k)
            colour[k] = static_cast<std::uint8_t>(values_[static_cast<std::size_t>(columns_.colour[k])]);
        return colour;
    }

    void addVertex() {
        mesh_.positions.push_back(vectorOf(columns_.position));
        if (columns_.normal[0] >= 0) mesh_.normals.push_back(vectorOf(columns_.normal));
        if (columns_.colour[0] >= 0) mesh_.colours.push_back(colourOf());
    }
    void addFace() {
        mesh_.ends.push_back(mesh_.corners.size());
        if (columns_.colour[0] >= 0) mesh_.faceColours.push_back(colourOf());
    }

    void requireWhole() const {
        const auto fail = [&](const std::string& what) {
            throw InputError(fmt::format("{}: {}", file_.string(), what));
        };
        if (mesh_.positions.empty()) fail("the mesh has no vertices ('element vertex')");
        if (mesh_.ends.empty()) fail("the mesh has no faces ('element face')");
        for (std::size_t i = 0; i < mesh_.size(); ++i)
            for (const std::uint32_t corner : mesh_[i])
                if (corner >= mesh_.positions.size())
                    fail(fmt::format("face {} uses vertex {}, expected 0..{}", i, corner, mesh_.positions.size() - 1));
    }

    const PlyHeader& header_;
    Body& body_;
    const std::filesystem::path& file_;
    Columns columns_;
    std::vector<double> values_;
    Polygons mesh_;
};

}  // namespace

Polygons readPly(std::string_view text, const std::filesystem::path& file) {
    Lines lines(text, file);
    const PlyHeader header = readPlyHeader(lines);
    if (header.format == PlyFormat::ascii) {
        TextBody body(lines);
        return PlyReader(header, body, file).read();
    }
    BinaryBody body(text.substr(lines.offset()), header.format == PlyFormat::bigEndian, file);
    return PlyReader(header, body, file).read();
}

}  // namespace dustbench::meshes
