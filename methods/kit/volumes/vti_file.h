// Reads VTK's image data (`.vti`): a grid of cells with arrays of numbers.
//
// Opening a file reads the structure as a whole and checks it against a whitelist; the values of an array are read on
// request. Arrays that do not exactly match their extent, and everything unknown, are errors.
// Source: Kitware2021, "XML file formats". Departs: one piece, which is the whole extent; an axis-aligned grid of three
// dimensions; compressed by zlib or LZ4 or not at all.
// Units and frame: the file's own. Owns: the file's text. Errors: every member throws InputError with the file.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/kit/volumes/vti_numbers.h"

namespace dustbench::volumes {

struct VtiArray {
    std::string name;
    int components = 1;
    StoredNumbers stored;
};

class DUSTBENCH_API VtiFile {
 public:
    explicit VtiFile(const std::filesystem::path& file);
    /// `text` is the file's content; `file` is for messages.
    VtiFile(std::string text, std::filesystem::path file);
    VtiFile(const VtiFile&) = delete;
    VtiFile& operator=(const VtiFile&) = delete;

    [[nodiscard]] const glm::ivec3& cells() const { return cells_; }
    /// Minimum corner of the first cell.
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] const glm::dvec3& spacing() const { return spacing_; }

    /// Arrays at the cells; x runs fastest, z slowest.
    [[nodiscard]] const std::vector<VtiArray>& cellArrays() const { return cellArrays_; }
    /// Arrays at the points, likewise; there is one more point than cells in each direction.
    [[nodiscard]] const std::vector<VtiArray>& pointArrays() const { return pointArrays_; }
    /// Null if there is no array of that name.
    [[nodiscard]] const VtiArray* cellArray(std::string_view name) const;
    /// The values of one of the arrays, cell by cell.
    [[nodiscard]] std::vector<float> numbersOf(const VtiArray& array) const;
    /// The same, piece by piece. Also throws what `take` throws.
    void streamNumbers(const VtiArray& array, const std::function<void(std::span<const float>)>& take) const;
    /// Field data, which apply to the whole file, such as a time.
    [[nodiscard]] const std::vector<VtiArray>& fieldArrays() const { return fieldArrays_; }
    /// Arrays of text and of bits, which are not read: `array 'names'`.
    [[nodiscard]] const std::vector<std::string>& unreadArrays() const { return unreadArrays_; }
    /// The value of a field array with exactly one value.
    [[nodiscard]] std::optional<double> fieldNumber(std::string_view name) const;

 private:
    friend class VtiParser;

    std::filesystem::path file_;
    std::string text_;
    BinaryForm form_;
    glm::ivec3 cells_{0};
    glm::dvec3 origin_{0}, spacing_{1};
    std::vector<VtiArray> cellArrays_, pointArrays_, fieldArrays_;
    std::vector<std::string> unreadArrays_;
};

}  // namespace dustbench::volumes
