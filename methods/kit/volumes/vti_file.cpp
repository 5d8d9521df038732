#include "methods/kit/volumes/vti_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/xml_scan.h"

namespace dustbench::volumes {
namespace {

/// For positions and distances.
constexpr double maximumNumber = 1e9;

/// All words of the text as numbers; empty if one is not a number.
template <typename Number>
std::vector<Number> numbersIn(std::string_view text) {
    std::vector<Number> list;
    for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
        Number value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const auto length = static_cast<std::size_t>(end - text.data());
        if (error != std::errc() || (length < text.size() && !trimmed(text.substr(length, 1)).empty())) return {};
        list.push_back(value);
        text.remove_prefix(length);
    }
    return list;
}

std::int64_t countOf(const Tag& tag, std::string_view attribute, std::int64_t maximum) {
    if (!tag.has(attribute)) return 1;
    const auto count = numbersIn<std::int64_t>(tag[attribute]);
    if (count.size() != 1 || count[0] < 1 || count[0] > maximum)
        throw VolumeFault{
            fmt::format("{} of an array is '{}', allowed: 1..{}", attribute, tag[attribute].substr(0, 40), maximum)};
    return count[0];
}

using Extent = std::array<std::int64_t, 6>;

/// Six integers; the second of each pair must not be less than the first.
Extent extentOf(const Tag& tag, std::string_view attribute) {
    const auto list = numbersIn<std::int64_t>(tag[attribute]);
    Extent extent{};
    if (list.size() != extent.size()) throw VolumeFault{fmt::format("its {} is not six integers", attribute)};
    std::ranges::copy(list, extent.begin());
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (extent[2 * axis] > extent[2 * axis + 1] || extent[2 * axis] < -1'000'000'000 ||
            extent[2 * axis + 1] > 1'000'000'000)
            throw VolumeFault{fmt::format("its {} ends before it begins", attribute)};
    return extent;
}

glm::dvec3 vectorOf(const Tag& tag, std::string_view attribute, const glm::dvec3& initial) {
    if (!tag.has(attribute)) return initial;
    const auto list = numbersIn<double>(tag[attribute]);
    const bool areSound = std::ranges::all_of(list, [](double number) { return std::abs(number) <= maximumNumber; });
    if (list.size() != 3 || !areSound)
        throw VolumeFault{fmt::format("its {} is not three numbers up to {}", attribute, maximumNumber)};
    return {list[0], list[1], list[2]};
}

/// True for the unit matrix, up to rounding.
bool isUpright(const std::vector<double>& direction) {
    if (direction.size() != 9) return false;
    for (std::size_t i = 0; i < 9; ++i)
        if (!(std::abs(direction[i] - (i % 4 == 0 ? 1 : 0)) <= 1e-5)) return false;
    return true;
}

glm::ivec3 cellsOf(const Extent& extent, std::size_t fileBytes) {
    glm::ivec3 cells{};
    double count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t along = extent[2 * axis + 1] - extent[2 * axis];
        if (along < 1) throw VolumeFault{"it is flat, expected cells in three directions"};
        count *= static_cast<double>(along);
        cells[static_cast<int>(axis)] = static_cast<int>(along);
    }
    if (count > static_cast<double>(files::limits::volumeCells))
        throw VolumeFault{
            fmt::format("it has {:.0f} cells, allowed: {} (limit of volumes)", count, files::limits::volumeCells)};
    // VTK's compressors do not pack 8,192 bytes into one.
    if (count * sizeof(float) > 8192.0 * static_cast<double>(fileBytes))
        throw VolumeFault{fmt::format("it has {:.0f} cells, which do not fit into its {} bytes", count, fileBytes)};
    return cells;
}

}  // namespace

/// Walks through the elements. An element may contain only what the whitelist allows.
class VtiParser {
 public:
    VtiParser(VtiFile& file, std::string_view text) : file_(file), text_(text), scan_(text) {}

    void run() {
        std::optional<Tag> tag;
        for (;;) {
            takeText(trimmed(scan_.next(tag)));
            if (!tag) break;
            if (tag->kind == Tag::Kind::close) {
                close(tag->name);
                continue;
            }
            open(*tag);
            if (tag->kind == Tag::Kind::whole) {
                close(tag->name);
            } else if (tag->name == "AppendedData") {
                return finish(endOfAppended());
            }
        }
        if (!path_.empty()) throw VolumeFault{"it ends within its XML"};
        finish({});
    }

 private:
    [[nodiscard]] std::string_view inside() const { return path_.empty() ? std::string_view() : path_.back(); }
    [[nodiscard]] static bool isArray(std::string_view name) { return name == "DataArray" || name == "Array"; }

    [[nodiscard]] bool mayHold(std::string_view parent, std::string_view child) const {
        if (isArray(parent)) return child == "InformationKey";
        if (parent.empty()) return child == "VTKFile" && !seenRoot_;
        if (parent == "VTKFile") return child == "ImageData" ? !extent_ : child == "AppendedData" && extent_;
        if (parent == "ImageData") return child == "FieldData" || (child == "Piece" && !seenPiece_);
        if (parent == "Piece") return child == "PointData" || (child == "CellData" && !seenCells_);
        if (parent == "FieldData" || parent == "PointData" || parent == "CellData") return isArray(child);
        return parent == "InformationKey" && child == "Value";
    }

    void open(const Tag& tag) {
        if (!mayHold(inside(), tag.name))
            throw VolumeFault{seenRoot_ ? fmt::format("it has an unexpected element '{}'", tag.name.substr(0, 40))
                                        : "it is not image data"};
        if (tag.name == "VTKFile") openRoot(tag);
        if (tag.name == "ImageData") openImage(tag);
        if (tag.name == "Piece") openPiece(tag);
        if (tag.name == "CellData") seenCells_ = true;
        if (isArray(tag.name)) openArray(tag);
        if (tag.name == "AppendedData")
            appendedForm_ = choice(tag, "encoding", {"base64", "raw"}) == 0 ? StoredNumbers::Form::base64
                                                                            : StoredNumbers::Form::raw;
        path_.push_back(tag.name);
    }

    void openRoot(const Tag& tag) {
        seenRoot_ = true;
        if (tag["type"] != "ImageData")
            throw VolumeFault{fmt::format("it is not image data but '{}'", tag["type"].substr(0, 40))};
        const std::string_view version = tag["version"];
        if (!version.empty() && !version.starts_with("0.") && !version.starts_with("1.") && !version.starts_with("2."))
            throw VolumeFault{fmt::format("its version is '{}', allowed: 0.1 to 2.x", version.substr(0, 40))};
        file_.form_.isBigEndian = choice(tag, "byte_order", {"LittleEndian", "BigEndian"}) == 1;
        file_.form_.wordBytes = choice(tag, "header_type", {"UInt32", "UInt64"}) == 1 ? 8 : 4;
        if (tag.has("compressor") && !tag["compressor"].empty())
            file_.form_.compressor = choice(tag, "compressor", {"vtkZLibDataCompressor", "vtkLZ4DataCompressor"}) == 0
                                         ? Compressor::zlib
                                         : Compressor::lz4;
    }

    void openImage(const Tag& tag) {
        extent_ = extentOf(tag, "WholeExtent");
        file_.cells_ = cellsOf(*extent_, text_.size());
        if (tag.has("Direction") && !isUpright(numbersIn<double>(tag["Direction"])))
            throw VolumeFault{"its grid is turned, expected one along the axes"};
        file_.spacing_ = vectorOf(tag, "Spacing", glm::dvec3(1));
        file_.origin_ = vectorOf(tag, "Origin", glm::dvec3(0));
        for (int axis = 0; axis < 3; ++axis)
            file_.origin_[axis] +=
                static_cast<double>((*extent_)[2 * static_cast<std::size_t>(axis)]) * file_.spacing_[axis];
    }

    void openPiece(const Tag& tag) {
        seenPiece_ = true;
        if (extentOf(tag, "Extent") != *extent_) throw VolumeFault{"its piece does not cover its whole extent"};
    }

    /// Skips arrays of text, such as units, and of bits.
    void openArray(const Tag& tag) {
        array_.emplace();
        array_->name = tag.text("Name");
        array_->components = static_cast<int>(countOf(tag, "NumberOfComponents", maximumComponents));
        array_->stored.type = findNumberType(tag["type"]);
        const bool isPassedOver = tag["type"] == "String" || tag["type"] == "Bit";
        if (!array_->stored.type && !isPassedOver)
            throw VolumeFault{
                fmt::format("an array has the type '{}', expected one such as Float32", tag["type"].substr(0, 40))};
        array_->stored.count = static_cast<std::size_t>(array_->components) * tuplesOf(tag);
        const std::size_t form = choice(tag, "format", {"ascii", "binary", "appended"});
        array_->stored.form = form == 0 ? StoredNumbers::Form::ascii : StoredNumbers::Form::base64;
        array_->stored.endsThere = form != 2;
        offset_.reset();
        if (form != 2) return;
        const auto offset = numbersIn<std::int64_t>(tag["offset"]);
        if (offset.size() != 1 || offset[0] < 0) throw VolumeFault{"an appended array has no offset"};
        offset_ = static_cast<std::size_t>(offset[0]);
    }

    [[nodiscard]] std::size_t tuplesOf(const Tag& tag) const {
        const auto said = static_cast<std::size_t>(countOf(tag, "NumberOfTuples", files::limits::volumeCells));
        if (inside() == "FieldData") return said;
        glm::ivec3 along = file_.cells_;
        if (inside() == "PointData") along += 1;
        std::size_t tuples = 1;
        for (int axis = 0; axis < 3; ++axis) tuples *= static_cast<std::size_t>(along[axis]);
        if (tag.has("NumberOfTuples") && said != tuples)
            throw VolumeFault{fmt::format("NumberOfTuples of an array is {}, expected {} by its extent", said, tuples)};
        return tuples;
    }

    void takeText(std::string_view text) {
        if (text.empty() || inside() == "Value") return;
        if (!isArray(inside()) || offset_ || !array_->stored.text.empty())
            throw VolumeFault{"it has text outside of its arrays"};
        array_->stored.text = text;
    }

    void close(std::string_view name) {
        if (inside() != name) throw VolumeFault{"its XML is damaged"};
        path_.pop_back();
        if (!isArray(name)) return;
        if (!offset_ && array_->stored.text.empty()) throw VolumeFault{"an array is empty"};
        keep();
        array_.reset();
    }

    void keep() {
        if (!array_->stored.type) return file_.unreadArrays_.push_back(files::namedPart("array", array_->name));
        std::vector<VtiArray>& arrays = inside() == "CellData"    ? file_.cellArrays_
                                        : inside() == "PointData" ? file_.pointArrays_
                                                                  : file_.fieldArrays_;
        if (std::ranges::find(arrays, array_->name, &VtiArray::name) != arrays.end())
            throw VolumeFault{fmt::format("it has two arrays '{}'", array_->name.substr(0, 40))};
        if (offset_) appended_.push_back({&arrays, arrays.size(), *offset_});
        arrays.push_back(std::move(*array_));
    }

    /// The text between '_' and the end of its element, after which only the root ends.
    [[nodiscard]] std::string_view endOfAppended() {
        const std::string_view rest = scan_.rest();
        const std::size_t start = rest.find('_'), end = rest.rfind("</AppendedData");
        if (end == std::string_view::npos || start >= end || !trimmed(rest.substr(0, start)).empty())
            throw VolumeFault{"its appended data are missing or truncated"};
        XmlScan tail(rest.substr(end));
        std::optional<Tag> tag;
        do {
            if (!trimmed(tail.next(tag)).empty() || (tag && tag->kind != Tag::Kind::close))
                throw VolumeFault{"its XML is damaged"};
            if (tag) close(tag->name);
        } while (tag);
        if (!path_.empty()) throw VolumeFault{"it ends within its XML"};
        return rest.substr(start + 1, end - start - 1);
    }

    void finish(std::string_view appended) {
        if (!seenPiece_) throw VolumeFault{"it has no image with a piece"};
        if (file_.cellArrays_.empty() && file_.pointArrays_.empty())
            throw VolumeFault{"it has no arrays of cells or points"};
        for (const Appended& each : appended_) {
            StoredNumbers& stored = (*each.arrays)[each.index].stored;
            if (each.offset >= appended.size()) throw VolumeFault{"its appended data are missing or truncated"};
            stored.form = appendedForm_;
            stored.text = appended.substr(each.offset);
        }
    }

    struct Appended {
        std::vector<VtiArray>* arrays;
        std::size_t index, offset;
    };

    VtiFile& file_;
    std::string_view text_;
    XmlScan scan_;
    std::vector<std::string_view> path_;
    std::optional<Extent> extent_;
    std::optional<VtiArray> array_;      ///< the open one
    std::optional<std::size_t> offset_;  ///< of the open array
    std::vector<Appended> appended_;
    StoredNumbers::Form appendedForm_ = StoredNumbers::Form::base64;
    bool seenRoot_ = false, seenPiece_ = false, seenCells_ = false;
};

namespace {

InputError refusedVti(const std::filesystem::path& file, const VolumeFault& fault) {
    return InputError(fmt::format("{}: not a complete VTK image data file (.vti): {}", file.string(),
                                  files::printable(fault.reason)));
}

}  // namespace

VtiFile::VtiFile(const std::filesystem::path& file)
    : VtiFile(files::wholeText(file, "a volume", files::limits::geometryBytes), file) {}

VtiFile::VtiFile(std::string text, std::filesystem::path file) : file_(std::move(file)), text_(std::move(text)) {
    try {
        VtiParser(*this, text_).run();
    } catch (const VolumeFault& fault) {
        throw refusedVti(file_, fault);
    }
}

const VtiArray* VtiFile::cellArray(std::string_view name) const {
    const auto found = std::ranges::find(cellArrays_, name, &VtiArray::name);
    return found == cellArrays_.end() ? nullptr : &*found;
}

std::vector<float> VtiFile::numbersOf(const VtiArray& array) const {
    try {
        return readNumbers<float>(array.stored, form_);
    } catch (const VolumeFault& fault) {
        throw refusedVti(file_, {fmt::format("'{}': {}", array.name, fault.reason)});
    }
}

void VtiFile::streamNumbers(const VtiArray& array, const std::function<void(std::span<const float>)>& take) const {
    try {
        volumes::streamNumbers(array.stored, form_, take);
    } catch (const VolumeFault& fault) {
        throw refusedVti(file_, {fmt::format("'{}': {}", array.name, fault.reason)});
    }
}

std::optional<double> VtiFile::fieldNumber(std::string_view name) const {
    const auto found = std::ranges::find(fieldArrays_, name, &VtiArray::name);
    if (found == fieldArrays_.end() || found->stored.count != 1) return std::nullopt;
    try {
        return readNumbers<double>(found->stored, form_).front();
    } catch (const VolumeFault& fault) {
        throw refusedVti(file_, {fmt::format("'{}': {}", name, fault.reason)});
    }
}

}  // namespace dustbench::volumes
