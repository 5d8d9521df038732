#include "methods/kit/meshes/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "methods/contract/errors.h"
#include "methods/kit/files/limits.h"
#include "methods/kit/meshes/mesh_text.h"

namespace dustbench::meshes {
namespace {

namespace limits = files::limits;
using ObjWords = std::vector<std::string_view>;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Keywords that do not affect polygons.
constexpr std::array<std::string_view, 16> passedOver{
    "g", "o", "s",     "mg",  "usemtl",    "mtllib",     "usemap",   "maplib",
    "l", "p", "bevel", "lod", "trace_obj", "shadow_obj", "c_interp", "d_interp"};

/// Joins lines: one that ends with a backslash continues on the next, except for comments. Line numbers are preserved.
std::string withoutContinuations(std::string_view text) {
    std::string joined;
    joined.reserve(text.size());
    std::size_t owed = 0;
    bool startsLine = true, isComment = false;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        const bool hasEnd = end < text.size();
        text.remove_prefix(hasEnd ? end + 1 : end);
        if (startsLine) isComment = line.starts_with('#');
        if (line.ends_with('\r')) line.remove_suffix(1);
        startsLine = isComment || !hasEnd || !line.ends_with('\\');
        joined.append(line.substr(0, startsLine ? line.size() : line.size() - 1));
        owed += hasEnd ? 1 : 0;
        if (hasEnd) joined.append(startsLine ? owed : 1, startsLine ? '\n' : ' ');
        if (startsLine) owed = 0;
    }
    return joined;
}

/// A corner of a face: `7`, `7/2`, `7//3` or `7/2/3`.
struct Corner {
    std::array<std::uint32_t, 3> index{none, none, none};  ///< vertex, texture coordinate, normal, from 0
    [[nodiscard]] bool hasFormOf(const Corner& other) const {
        return (index[1] == none) == (other.index[1] == none) && (index[2] == none) == (other.index[2] == none);
    }
};

class ObjReader {
 public:
    ObjReader(std::string_view text, const std::filesystem::path& file) : lines_(text, file), file_(file) {}

    Polygons read() {
        for (std::string_view line; lines_.next(line);) readLine(wordsOf(line));
        lines_.requireLineEnd();
        if (vertices_.empty()) throw InputError(file_.string() + ": the mesh has no vertices ('v x y z')");
        if (ends_.empty()) throw InputError(file_.string() + ": the mesh has no faces ('f 1 2 3')");
        requireDeclared('v', vertices_.size());
        requireDeclared('f', ends_.size());
        if (!normalsEverywhere_ && !normals_.empty()) ignored_.insert("normals (vn), because some corners have none");
        Polygons mesh = normalsEverywhere_ ? withNormals() : withoutNormals();
        mesh.ignored.assign(ignored_.begin(), ignored_.end());
        return mesh;
    }

 private:
    void readLine(ObjWords words) {
        if (words.empty()) return;
        const std::string_view key = words[0];
        if (!key.starts_with('#'))
            words.erase(std::ranges::find_if(words, [](auto word) { return word.starts_with('#'); }), words.end());
        if (key == "v") return readVertex(words);
        if (key == "vn") return readNormal(words);
        if (key == "vt") return readTexture(words);
        if (key == "f") return readFace(words);
        if (key == "#" && words.size() > 1 && words[1] == "counts:") return readCounts(words);
        if (key == "mtllib" || key == "usemtl") ignored_.insert("materials (mtllib, usemtl)");
        if (key == "l" || key == "p") ignored_.insert("lines and points (l, p)");
        if (key == "s" && words.size() > 1 && words[1] != "off" && words[1] != "0")
            ignored_.insert("smoothing groups (s)");
        if (key.starts_with('#') || std::ranges::find(passedOver, key) != passedOver.end()) return;
        lines_.fail(fmt::format("got {}, expected v, vt, vn, f or another polygon keyword", inQuotes(key)));
    }

    void requireNumbers(const ObjWords& words, std::size_t minimum, std::size_t maximum) const {
        if (words.size() - 1 < minimum || words.size() - 1 > maximum)
            lines_.fail(fmt::format("got {} numbers after '{}', expected {}..{}", words.size() - 1, words[0], minimum,
                                    maximum));
        for (std::size_t i = 1; i < words.size(); ++i) (void)lines_.number(words[i]);
    }

    void requireRoom(std::size_t count) const {
        if (static_cast<std::int64_t>(count) >= limits::meshElements)
            lines_.fail(fmt::format("the mesh has too many elements, allowed: {} of each kind", limits::meshElements));
    }

    /// Weights and colours may follow the three coordinates; they are ignored.
    void readVertex(const ObjWords& words) {
        requireNumbers(words, 3, 7);
        requireRoom(vertices_.size());
        if (words.size() > 5) ignored_.insert("colours of vertices (v x y z r g b)");
        vertices_.push_back(lines_.vector(words, 1));
    }
    void readNormal(const ObjWords& words) {
        requireNumbers(words, 3, 3);
        requireRoom(normals_.size());
        normals_.push_back(lines_.vector(words, 1));
    }
    void readTexture(const ObjWords& words) {
        requireNumbers(words, 1, 3);
        ++textures_;
        ignored_.insert("texture coordinates (vt)");
    }

    void readFace(const ObjWords& words) {
        const std::size_t corners = words.size() - 1;
        if (corners < 3 || corners > static_cast<std::size_t>(limits::polygonCorners))
            lines_.fail(fmt::format("a face has {} corners, allowed: 3..{}", corners, limits::polygonCorners));
        requireRoom(ends_.size());
        const Corner first = corner(words[1]);
        for (std::size_t i = 1; i < words.size(); ++i) {
            const Corner next = corner(words[i]);
            if (!next.hasFormOf(first))
                lines_.fail(fmt::format("a face has corners {} and {}, expected one form for all", inQuotes(words[1]),
                                        inQuotes(words[i])));
            corners_.push_back(next);
        }
        normalsEverywhere_ = normalsEverywhere_ && first.index[2] != none;
        ends_.push_back(corners_.size());
    }

    Corner corner(std::string_view word) const {
        Corner corner;
        const std::array<std::size_t, 3> given{vertices_.size(), textures_, normals_.size()};
        std::string_view rest = word;
        for (std::size_t part = 0;; ++part) {
            const std::size_t slash = rest.find('/');
            const std::string_view text = rest.substr(0, slash);
            const bool skipped = part == 1 && text.empty() && slash != std::string_view::npos;  // 7//3
            if (part > 2) lines_.fail(fmt::format("got {}, expected vertex/texture/normal", inQuotes(word)));
            if (!skipped) corner.index[part] = indexOf(text, part, given[part]);
            if (slash == std::string_view::npos) return corner;
            rest.remove_prefix(slash + 1);
        }
    }

    /// Counts from 1, or backwards from the last one if negative.
    std::uint32_t indexOf(std::string_view text, std::size_t part, std::size_t given) const {
        static constexpr std::array kinds{"vertex", "texture coordinate", "normal"};
        const auto index = parse<std::int64_t>(text);
        const auto count = static_cast<std::int64_t>(given);
        if (!index || *index == 0 || *index > count || *index < -count)
            lines_.fail(fmt::format("a face refers to {} {}, expected 1..{}", kinds[part], inQuotes(text), count));
        return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : count + *index);
    }

    /// `# counts: v 642, f 1280`
    void readCounts(const ObjWords& words) {
        if (words.size() % 2 != 0) lines_.fail("expected '# counts: v 642, f 1280'");
        for (std::size_t i = 2; i < words.size(); i += 2) {
            std::string_view number = words[i + 1];
            if (number.ends_with(',')) number.remove_suffix(1);
            const auto count = parse<std::size_t>(number);
            if (!count || (words[i] != "v" && words[i] != "f")) lines_.fail("expected '# counts: v 642, f 1280'");
            declared_[words[i].front()] = *count;
        }
    }

    void requireDeclared(char kind, std::size_t count) const {
        const auto found = declared_.find(kind);
        if (found != declared_.end() && found->second != count)
            throw InputError(
                fmt::format("{}: has {} lines '{}', expected {} by its comment '# counts:'; it may be truncated",
                            file_.string(), count, kind, found->second));
    }

    Polygons withoutNormals() {
        Polygons mesh;
        mesh.positions = std::move(vertices_);
        mesh.corners.reserve(corners_.size());
        for (const Corner& corner : corners_) mesh.corners.push_back(corner.index[0]);
        mesh.ends = std::move(ends_);
        return mesh;
    }

    Polygons withNormals() {
        Polygons mesh;
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> pairs;
        for (const Corner& corner : corners_) {
            const auto [vertex, texture, normal] = corner.index;
            const auto [pair, isNew] =
                pairs.emplace(std::pair(vertex, normal), static_cast<std::uint32_t>(mesh.positions.size()));
            if (isNew) {
                mesh.positions.push_back(vertices_[vertex]);
                mesh.normals.push_back(normals_[normal]);
            }
            mesh.corners.push_back(pair->second);
        }
        mesh.ends = std::move(ends_);
        return mesh;
    }

    Lines lines_;
    const std::filesystem::path& file_;
    std::vector<glm::vec3> vertices_, normals_;
    std::size_t textures_ = 0;
    std::vector<Corner> corners_;
    std::vector<std::size_t> ends_;
    bool normalsEverywhere_ = true;
    std::map<char, std::size_t> declared_;
    std::set<std::string> ignored_;
};

}  // namespace

Polygons readObj(std::string_view text, const std::filesystem::path& file) {
    return ObjReader(withoutContinuations(text), file).read();
}

}  // namespace dustbench::meshes
