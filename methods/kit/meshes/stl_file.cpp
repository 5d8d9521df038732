#include "methods/kit/meshes/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_map>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/meshes/mesh_text.h"

namespace dustbench::meshes {
namespace {

using StlWords = std::vector<std::string_view>;

constexpr std::size_t headerBytes = 84, facetBytes = 50;

/// Merges corners at the same point into one vertex.
class Joined {
 public:
    void add(const glm::vec3& point) {
        const glm::vec3 key = point + 0.0f;  // -0 becomes 0
        const auto [place, isNew] = places_.emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
        if (isNew) mesh_.positions.push_back(point);
        mesh_.corners.push_back(place->second);
        if (mesh_.corners.size() % 3 == 0) mesh_.ends.push_back(mesh_.corners.size());
    }
    [[nodiscard]] std::size_t triangles() const { return mesh_.size(); }
    [[nodiscard]] Polygons take() { return std::move(mesh_); }

 private:
    struct Hash {
        std::size_t operator()(const glm::vec3& p) const {
            std::uint64_t hash = 0;
            for (int k = 0; k < 3; ++k) hash = (hash ^ std::bit_cast<std::uint32_t>(p[k])) * 0x9E3779B97F4A7C15ull;
            return static_cast<std::size_t>(hash ^ hash >> 32);
        }
    };
    Polygons mesh_;
    std::unordered_map<glm::vec3, std::uint32_t, Hash> places_;
};

std::uint32_t wordAt(std::string_view text, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t{static_cast<unsigned char>(text[at + k])} << (8 * k);
    return value;
}

std::uintmax_t binaryBytes(std::string_view text) {
    return headerBytes + facetBytes * std::uintmax_t{wordAt(text, headerBytes - 4)};
}

Polygons readBinary(std::string_view text, const std::filesystem::path& file) {
    Joined joined;
    bool hasAttributes = false;
    for (std::size_t at = headerBytes; at < text.size(); at += facetBytes) {
        hasAttributes = hasAttributes || text[at + facetBytes - 2] != 0 || text[at + facetBytes - 1] != 0;
        for (std::size_t corner = 1; corner <= 3; ++corner) {
            glm::vec3 point;
            for (std::size_t k = 0; k < 3; ++k)
                point[static_cast<int>(k)] = std::bit_cast<float>(wordAt(text, at + 12 * corner + 4 * k));
            if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
                throw InputError(fmt::format("{}: triangle {} has a corner that is not a finite point", file.string(),
                                             joined.triangles() + 1));
            joined.add(point);
        }
    }
    Polygons mesh = joined.take();
    if (hasAttributes) mesh.ignored.emplace_back("attributes of triangles, such as colours");
    return mesh;
}

/// Keywords may also be in capitals.
bool isKeyword(std::string_view word, std::string_view keyword) {
    return std::ranges::equal(word, keyword, [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

class AsciiReader {
 public:
    AsciiReader(std::string_view text, const std::filesystem::path& file) : lines_(text, file) {}

    Polygons read() {
        expect("solid");
        for (bool more = true; more;) {
            const StlWords named = namesOf(words_);
            while (next() && isKeyword(words_[0], "facet")) readFacet();
            if (!isKeyword(words_[0], "endsolid") || (words_.size() > 1 && namesOf(words_) != named))
                lines_.fail("expected 'facet', or 'endsolid' with the solid's name");
            more = lines_.nextWords(words_);
            if (more && !isKeyword(words_[0], "solid")) lines_.fail("text after 'endsolid'");
        }
        lines_.requireLineEnd();
        return joined_.take();
    }

 private:
    static StlWords namesOf(const StlWords& words) { return {words.begin() + 1, words.end()}; }

    bool next() {
        if (!lines_.nextWords(words_)) lines_.fail("the file ends within its solid");
        return true;
    }
    void expect(std::string_view first, std::string_view second = {}, std::size_t numbers = 0) {
        next();
        const std::size_t keys = second.empty() ? 1 : 2;
        if (!isKeyword(words_[0], first) || (keys == 2 && (words_.size() < 2 || !isKeyword(words_[1], second))))
            lines_.fail(
                fmt::format("got {}, expected '{}{}{}'", inQuotes(words_[0]), first, keys == 2 ? " " : "", second));
        if (first != "solid" && words_.size() != keys + numbers)
            lines_.fail(fmt::format("got {} words, expected {}", words_.size(), keys + numbers));
    }
    void readFacet() {
        if (words_.size() != 5 || !isKeyword(words_[1], "normal")) lines_.fail("expected 'facet normal X Y Z'");
        for (std::size_t k = 2; k < 5; ++k) (void)lines_.number(words_[k]);
        if (static_cast<std::int64_t>(joined_.triangles()) >= files::limits::meshElements)
            lines_.fail(fmt::format("too many triangles, allowed: {}", files::limits::meshElements));
        expect("outer", "loop");
        for (int corner = 0; corner < 3; ++corner) {
            expect("vertex", {}, 3);
            joined_.add(lines_.vector(words_, 1));
        }
        expect("endloop");
        expect("endfacet");
    }

    Lines lines_;
    StlWords words_;
    Joined joined_;
};

}  // namespace

Polygons readStl(std::string_view text, const std::filesystem::path& file) {
    const bool isBinary = text.size() >= headerBytes && binaryBytes(text) == text.size();
    const StlWords first = wordsOf(text.substr(0, text.find('\n')));
    if (!isBinary && (first.empty() || !isKeyword(first[0], "solid"))) {
        if (text.size() < headerBytes)
            throw InputError(fmt::format("{}: not an STL file: it has {} bytes, and does not start with 'solid'",
                                         file.string(), text.size()));
        throw InputError(fmt::format("{}: a binary STL file of {} triangles has {} bytes, got {}", file.string(),
                                     wordAt(text, headerBytes - 4), binaryBytes(text), text.size()));
    }
    Polygons mesh = isBinary ? readBinary(text, file) : AsciiReader(text, file).read();
    if (mesh.size() == 0) throw InputError(file.string() + ": the mesh has no triangles");
    return mesh;
}

}  // namespace dustbench::meshes
