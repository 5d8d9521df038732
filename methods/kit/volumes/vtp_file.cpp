#include "methods/kit/volumes/vtp_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "methods/contract/errors.h"
#include "methods/kit/files/printable.h"
#include "methods/kit/files/whole_text.h"
#include "methods/kit/volumes/vti_numbers.h"
#include "methods/kit/volumes/xml_scan.h"

namespace dustbench::volumes {
namespace {

/// A whole number minimum..maximum; `initial` if the attribute is missing.
std::int64_t wholeNumberOf(const Tag& tag, std::string_view attribute, std::int64_t minimum, std::int64_t maximum,
                           std::int64_t initial) {
    if (!tag.has(attribute)) return initial;
    const std::string_view text = trimmed(tag[attribute]);
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    if (error != std::errc() || end != text.data() + text.size() || count < minimum || count > maximum)
        throw VolumeFault{
            fmt::format("its {} is '{}', allowed: {}..{}", attribute, text.substr(0, 40), minimum, maximum)};
    return count;
}

constexpr std::string_view ghostArray = "vtkGhostType";

bool isCells(std::string_view name) {
    return name == "Verts" || name == "Lines" || name == "Strips" || name == "Polys" || name == "CellData";
}

struct StoredArray {
    std::string name;
    int components = 1;
    StoredNumbers stored;
    std::optional<std::size_t> offset;
};

/// Walks through the elements. An element may contain only what the whitelist allows.
class VtpParser {
 public:
    explicit VtpParser(std::string_view text) : text_(text), scan_(text) {}

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
            if (tag->kind == Tag::Kind::whole)
                close(tag->name);
            else if (tag->name == "AppendedData")
                return finish(endOfAppended());
        }
        if (!path_.empty()) throw VolumeFault{"it ends within its XML"};
        finish({});
    }

    [[nodiscard]] PointTable table(const WantsColumn& wants) const {
        PointTable table;
        table.points = points_;
        for (const StoredArray& array : pointArrays_) {
            if (array.name == ghostArray && array.components == 1) continue;
            PointColumn& column = table.columns.emplace_back(PointColumn{array.name, array.components, {}});
            column.isByte = array.stored.type->name == "UInt8";
            if (wants(column.name)) column.values = numbersOf(array);
        }
        leaveOutGhosts(table);
        for (const StoredArray& array : fieldArrays_)
            if (array.name == "TimeValue" && array.stored.count == 1) table.timeSeconds = numbersOf(array).front();
        for (const StoredArray& array : fieldArrays_)
            if (array.name != "TimeValue") table.ignored.push_back(files::namedPart("field data", array.name));
        table.ignored.insert(table.ignored.end(), unread_.begin(), unread_.end());
        return table;
    }

 private:
    [[nodiscard]] std::string_view inside() const { return path_.empty() ? std::string_view() : path_.back(); }
    [[nodiscard]] static bool isArray(std::string_view name) { return name == "DataArray" || name == "Array"; }

    [[nodiscard]] bool mayHold(std::string_view parent, std::string_view child) const {
        if (isArray(parent)) return child == "InformationKey";
        if (parent.empty()) return child == "VTKFile" && !seenRoot_;
        if (parent == "VTKFile") return child == "PolyData" ? !seenData_ : child == "AppendedData" && seenData_;
        if (parent == "PolyData") return child == "FieldData" || (child == "Piece" && !seenPiece_);
        if (parent == "Piece") return child == "PointData" || child == "Points" || isCells(child);
        if (parent == "FieldData" || parent == "PointData" || parent == "Points" || isCells(parent))
            return isArray(child);
        return parent == "InformationKey" && child == "Value";
    }

    void open(const Tag& tag) {
        if (!mayHold(inside(), tag.name))
            throw VolumeFault{seenRoot_ ? fmt::format("it has an unexpected element '{}'", tag.name.substr(0, 40))
                                        : "it is not poly data"};
        if (tag.name == "VTKFile") openRoot(tag);
        if (tag.name == "PolyData") seenData_ = true;
        if (tag.name == "Piece") openPiece(tag);
        if (isArray(tag.name)) openArray(tag);
        if (tag.name == "AppendedData")
            appendedForm_ = choice(tag, "encoding", {"base64", "raw"}) == 0 ? StoredNumbers::Form::base64
                                                                            : StoredNumbers::Form::raw;
        path_.push_back(tag.name);
    }

    void openRoot(const Tag& tag) {
        seenRoot_ = true;
        if (tag["type"] != "PolyData")
            throw VolumeFault{fmt::format("it is not poly data but '{}'", tag["type"].substr(0, 40))};
        form_.isBigEndian = choice(tag, "byte_order", {"LittleEndian", "BigEndian"}) == 1;
        form_.wordBytes = choice(tag, "header_type", {"UInt32", "UInt64"}) == 1 ? 8 : 4;
        if (tag.has("compressor") && !tag["compressor"].empty())
            form_.compressor = choice(tag, "compressor", {"vtkZLibDataCompressor", "vtkLZ4DataCompressor"}) == 0
                                   ? Compressor::zlib
                                   : Compressor::lz4;
    }

    void openPiece(const Tag& tag) {
        seenPiece_ = true;
        points_ = static_cast<std::size_t>(wholeNumberOf(tag, "NumberOfPoints", 0, files::limits::dustParticles, 0));
        // VTK's compressors do not pack 8,192 bytes into one.
        if (static_cast<double>(points_) * 3 * sizeof(float) > 8192.0 * static_cast<double>(text_.size()))
            throw VolumeFault{
                fmt::format("it has {} points, which do not fit into its {} bytes", points_, text_.size())};
    }

    /// Ignores arrays of cells; skips arrays of text, such as units, and of bits.
    void openArray(const Tag& tag) {
        array_.emplace();
        array_->name = inside() == "Points" ? std::string(pointsColumn) : tag.text("Name");
        array_->components = static_cast<int>(wholeNumberOf(tag, "NumberOfComponents", 1, maximumComponents, 1));
        if (inside() == "Points" && array_->components != 3) throw VolumeFault{"its points do not have 3 coordinates"};
        array_->stored.type = findNumberType(tag["type"]);
        if (!array_->stored.type && tag["type"] != "String" && tag["type"] != "Bit")
            throw VolumeFault{
                fmt::format("an array has the type '{}', expected one such as Float32", tag["type"].substr(0, 40))};
        if (!isCells(inside())) {
            const bool isField = inside() == "FieldData";
            const std::int64_t expected = isField ? 1 : static_cast<std::int64_t>(points_);
            const std::int64_t said = wholeNumberOf(tag, "NumberOfTuples", 0, files::limits::dustParticles, expected);
            if (!isField && said != expected)
                throw VolumeFault{fmt::format("NumberOfTuples of an array is {}, expected {}", said, expected)};
            array_->stored.count = static_cast<std::size_t>(array_->components) * static_cast<std::size_t>(said);
        }
        const std::size_t form = choice(tag, "format", {"ascii", "binary", "appended"});
        array_->stored.form = form == 0 ? StoredNumbers::Form::ascii : StoredNumbers::Form::base64;
        array_->stored.endsThere = form != 2;
        if (form == 2) array_->offset = static_cast<std::size_t>(wholeNumberOf(tag, "offset", 0, INT64_C(1) << 40, 0));
    }

    void takeText(std::string_view text) {
        if (text.empty() || inside() == "Value") return;
        if (!isArray(inside()) || array_->offset || !array_->stored.text.empty())
            throw VolumeFault{"it has text outside of its arrays"};
        array_->stored.text = text;
    }

    void close(std::string_view name) {
        if (inside() != name) throw VolumeFault{"its XML is damaged"};
        path_.pop_back();
        if (!isArray(name)) return;
        keep();
        array_.reset();
    }

    void keep() {
        if (inside() == "CellData") unread_.push_back(files::namedPart("array", array_->name) + " at cells");
        if (!array_->stored.type && !isCells(inside())) unread_.push_back(files::namedPart("array", array_->name));
        if (!array_->stored.type || isCells(inside())) return;
        std::vector<StoredArray>& arrays = inside() == "FieldData" ? fieldArrays_ : pointArrays_;
        if (std::ranges::find(arrays, array_->name, &StoredArray::name) != arrays.end())
            throw VolumeFault{fmt::format("it has two arrays '{}'", array_->name.substr(0, 40))};
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
        if (!seenPiece_) throw VolumeFault{"it has no poly data with a piece"};
        for (std::vector<StoredArray>* arrays : {&pointArrays_, &fieldArrays_})
            for (StoredArray& array : *arrays) {
                if (!array.offset || array.stored.count == 0) continue;
                if (*array.offset >= appended.size()) throw VolumeFault{"its appended data are missing or truncated"};
                array.stored.form = appendedForm_;
                array.stored.text = appended.substr(*array.offset);
            }
        if (std::ranges::find(pointArrays_, pointsColumn, &StoredArray::name) == pointArrays_.end() && points_ > 0)
            throw VolumeFault{"it has no points"};
    }

    /// Removes points that VTK marks as duplicate (1) or hidden (2): they belong to another piece or to none.
    void leaveOutGhosts(PointTable& table) const {
        const auto ghosts = std::ranges::find(pointArrays_, ghostArray, &StoredArray::name);
        if (ghosts == pointArrays_.end() || ghosts->components != 1) return;
        const std::vector<double> marks = numbersOf(*ghosts);
        const auto isLeftOut = [&marks](std::size_t point) {
            return marks[point] > 0 && marks[point] < 256 && (static_cast<unsigned>(marks[point]) & 3u) != 0;
        };
        for (PointColumn& column : table.columns) {
            if (column.values.empty()) continue;
            const auto components = static_cast<std::size_t>(column.components);
            std::size_t kept = 0;
            for (std::size_t point = 0; point < points_; ++point) {
                if (isLeftOut(point)) continue;
                for (std::size_t i = 0; i < components; ++i)
                    column.values[kept * components + i] = column.values[point * components + i];
                ++kept;
            }
            column.values.resize(kept * components);
        }
        table.points = 0;
        for (std::size_t point = 0; point < points_; ++point) table.points += isLeftOut(point) ? 0 : 1;
    }

    [[nodiscard]] std::vector<double> numbersOf(const StoredArray& array) const {
        if (array.stored.count == 0) return {};
        try {
            return readNumbers<double>(array.stored, form_);
        } catch (const VolumeFault& fault) {
            throw VolumeFault{fmt::format("'{}': {}", array.name.substr(0, 40), fault.reason)};
        }
    }

    std::string_view text_;
    XmlScan scan_;
    BinaryForm form_;
    std::vector<std::string_view> path_;
    std::size_t points_ = 0;
    std::optional<StoredArray> array_;  ///< the open one
    std::vector<StoredArray> pointArrays_, fieldArrays_;
    std::vector<std::string> unread_;  ///< arrays at cells and of text
    StoredNumbers::Form appendedForm_ = StoredNumbers::Form::base64;
    bool seenRoot_ = false, seenData_ = false, seenPiece_ = false;
};

}  // namespace

PointTable readVtp(const std::filesystem::path& file, const WantsColumn& wants) {
    const std::string text = files::wholeText(file, "particles", files::limits::geometryBytes);
    try {
        VtpParser parser(text);
        parser.run();
        return parser.table(wants);
    } catch (const VolumeFault& fault) {
        throw InputError(fmt::format("{}: not a complete VTK poly data file (.vtp): {}", file.string(),
                                     files::printable(fault.reason)));
    }
}

}  // namespace dustbench::volumes
