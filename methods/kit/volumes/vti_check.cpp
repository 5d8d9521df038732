#include "methods/kit/volumes/vti_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "methods/kit/files/whole_text.h"

namespace dustbench::volumes {
namespace {

using Attributes = std::map<std::string, std::string_view, std::less<>>;

constexpr std::string_view blanks = " \t\r\n";
constexpr std::int64_t maximumComponents = 64;

/// A reason to refuse the file; caught by vtiFault.
struct Fault {
    std::string reason;
};

struct Tag {
    std::string name;
    Attributes attributes;
    enum class Kind { open, close, whole } kind = Kind::open;

    [[nodiscard]] std::string_view operator[](std::string_view attribute) const {
        const auto found = attributes.find(attribute);
        return found == attributes.end() ? std::string_view() : found->second;
    }
};

bool isBlank(std::string_view text) {
    return text.find_first_not_of(blanks) == std::string_view::npos;
}

/// Reads tag by tag, and the text between them.
class XmlScan {
 public:
    explicit XmlScan(std::string_view text) : rest_(text) {}

    /// The text before the next tag; at the end of the file there is no tag.
    std::string_view next(std::optional<Tag>& tag) {
        const std::size_t start = std::min(rest_.find('<'), rest_.size());
        const std::string_view before = rest_.substr(0, start);
        rest_.remove_prefix(start);
        tag.reset();
        if (rest_.empty()) return before;
        if (rest_.starts_with("<!--")) {
            skipPast("-->");
            return next(tag);
        }
        if (rest_.starts_with("<?")) {
            skipPast("?>");
            return next(tag);
        }
        if (rest_.starts_with("<!")) throw Fault{"it has a document type or CDATA, which no file of VTK's has"};
        tag = readTag();
        return before;
    }
    [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
    void skipPast(std::string_view end) {
        const std::size_t at = rest_.find(end);
        if (at == std::string_view::npos) throw Fault{"it ends within its XML"};
        rest_.remove_prefix(at + end.size());
    }
    void skipBlanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size())); }
    std::string_view readName() {
        const std::size_t end = std::min(rest_.find_first_of(" \t\r\n=/>\"'<"), rest_.size());
        const std::string_view name = rest_.substr(0, end);
        rest_.remove_prefix(end);
        if (name.empty()) throw Fault{"its XML is damaged"};
        return name;
    }
    [[nodiscard]] bool take(std::string_view token) {
        if (!rest_.starts_with(token)) return false;
        rest_.remove_prefix(token.size());
        return true;
    }
    Tag readTag() {
        rest_.remove_prefix(1);
        Tag tag;
        if (take("/")) tag.kind = Tag::Kind::close;
        tag.name = readName();
        for (skipBlanks(); !take(">"); skipBlanks()) {
            if (take("/>")) {
                tag.kind = Tag::Kind::whole;
                break;
            }
            readAttribute(tag);
        }
        return tag;
    }
    void readAttribute(Tag& tag) {
        const std::string name(readName());
        skipBlanks();
        if (!take("=")) throw Fault{"its XML is damaged"};
        skipBlanks();
        const char quote = rest_.empty() ? ' ' : rest_.front();
        const std::size_t end = quote == '"' || quote == '\'' ? rest_.find(quote, 1) : std::string_view::npos;
        if (end == std::string_view::npos || !tag.attributes.emplace(name, rest_.substr(1, end - 1)).second)
            throw Fault{"its XML is damaged"};
        rest_.remove_prefix(end + 1);
    }

    std::string_view rest_;
};

std::vector<std::int64_t> integersOf(std::string_view text) {
    std::vector<std::int64_t> list;
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
        if (text.empty()) return list;
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc()) return {};
        list.push_back(value);
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
}

/// Six integers, of which the second of each pair is not below the first.
std::array<std::int64_t, 6> extentOf(const Tag& tag, std::string_view attribute) {
    const std::vector<std::int64_t> list = integersOf(tag[attribute]);
    std::array<std::int64_t, 6> extent{};
    if (list.size() != 6) throw Fault{fmt::format("its {} is not six integers", attribute)};
    std::ranges::copy(list, extent.begin());
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (extent[2 * axis] > extent[2 * axis + 1] ||
            std::max(-extent[2 * axis], extent[2 * axis + 1]) > 1'000'000'000)
            throw Fault{fmt::format("its {} ends before it begins", attribute)};
    return extent;
}

/// VTK allocates all arrays before it reads one. No compression of VTK's puts 8,192 bytes into one.
void requireFewEnough(const std::array<std::int64_t, 6>& extent, std::size_t fileBytes) {
    double cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
        cells *= static_cast<double>(std::max<std::int64_t>(extent[2 * axis + 1] - extent[2 * axis], 1));
    if (cells > static_cast<double>(maximumCells))
        throw Fault{fmt::format("it has {:.0f} cells, allowed: {} (limit of volumes)", cells, maximumCells)};
    if (cells * sizeof(float) > 8192.0 * static_cast<double>(fileBytes))
        throw Fault{fmt::format("it has {:.0f} cells, which do not fit into its {} bytes", cells, fileBytes)};
}

class VtiCheck {
 public:
    explicit VtiCheck(std::string_view text) : scan_(text), bytes_(text.size()) {}

    void run() {
        std::optional<Tag> tag;
        for (std::string_view before = scan_.next(tag); tag; before = scan_.next(tag)) {
            if (inArray_ && isArray(open_.back()) && !isBlank(before)) hasText_ = true;
            if (tag->kind == Tag::Kind::close) {
                closeElement(tag->name);
            } else {
                if (open_.empty() && seenRoot_) throw Fault{"it goes on after its end"};
                openElement(*tag);
                if (tag->kind == Tag::Kind::open) open_.push_back(tag->name);
                if (tag->name == "AppendedData" && tag->kind == Tag::Kind::open) return finish(scan_.rest());
            }
        }
        if (!open_.empty()) throw Fault{"it ends within its XML"};
        finish({});
    }

 private:
    static bool isArray(std::string_view name) { return name == "DataArray" || name == "Array"; }

    void openElement(const Tag& tag) {
        if (!seenRoot_ && (tag.name != "VTKFile" || tag["type"] != "ImageData")) throw Fault{"it is no image data"};
        seenRoot_ = true;
        // VTK notes ranges of arrays as keys within them.
        if (inArray_ && tag.name != "InformationKey" && tag.name != "Value")
            throw Fault{"an array holds other elements"};
        if (tag.name == "ImageData") {
            if (whole_) throw Fault{"it has two images"};
            whole_ = extentOf(tag, "WholeExtent");
            requireFewEnough(*whole_, bytes_);
        } else if (tag.name == "Piece") {
            requirePiece(extentOf(tag, "Extent"));
        } else if (isArray(tag.name)) {
            openArray(tag);
        }
    }

    void requirePiece(const std::array<std::int64_t, 6>& piece) {
        if (!whole_) throw Fault{"it has a piece outside of an image"};
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (piece[2 * axis] < (*whole_)[2 * axis] || piece[2 * axis + 1] > (*whole_)[2 * axis + 1])
                throw Fault{"a piece lies outside of its image"};
        ++pieces_;
    }

    void openArray(const Tag& tag) {
        static constexpr std::array<std::string_view, 12> types{"Int8",    "UInt8",   "Int16",  "UInt16",
                                                                "Int32",   "UInt32",  "Int64",  "UInt64",
                                                                "Float32", "Float64", "String", "Bit"};
        ++arrays_;
        if (std::ranges::find(types, tag["type"]) == types.end())
            throw Fault{
                fmt::format("an array has the type '{}', expected one such as Float32", tag["type"].substr(0, 40))};
        for (const std::string_view attribute : {"NumberOfComponents", "NumberOfTuples"}) {
            if (!tag.attributes.contains(attribute)) continue;
            const std::vector<std::int64_t> count = integersOf(tag[attribute]);
            const std::int64_t maximum = attribute == "NumberOfComponents" ? maximumComponents : maximumCells;
            if (count.size() != 1 || count[0] < 1 || count[0] > maximum)
                throw Fault{fmt::format("{} of an array is '{}', allowed: 1..{}", attribute,
                                        tag[attribute].substr(0, 40), maximum)};
        }
        const std::string_view format = tag["format"];
        if (format == "appended") {
            const std::vector<std::int64_t> offset = integersOf(tag["offset"]);
            if (offset.size() != 1 || offset[0] < 0) throw Fault{"an appended array has no offset"};
            lastOffset_ = std::max(lastOffset_, offset[0]);
        } else if (format != "ascii" && format != "binary") {
            throw Fault{
                fmt::format("an array has the format '{}', expected ascii, binary or appended", format.substr(0, 40))};
        } else if (tag.kind == Tag::Kind::whole) {
            throw Fault{"an array is empty"};
        }
        inArray_ = tag.kind == Tag::Kind::open;
        hasText_ = false;
        needsText_ = format != "appended";
    }

    void closeElement(const std::string& name) {
        if (open_.empty() || open_.back() != name) throw Fault{"its XML is damaged"};
        open_.pop_back();
        if (!isArray(name)) return;
        if (hasText_ != needsText_)
            throw Fault{needsText_ ? "an array is empty" : "an appended array has text of its own"};
        inArray_ = false;
    }

    /// `appended`: after the tag; its data begin after '_'.
    void finish(std::string_view appended) const {
        if (!whole_ || pieces_ == 0) throw Fault{"it has no image with a piece"};
        if (arrays_ == 0) throw Fault{"it has no arrays"};
        if (lastOffset_ < 0) return;
        const std::size_t start = appended.find_first_not_of(blanks), end = appended.rfind("</AppendedData");
        if (start == std::string_view::npos || appended[start] != '_' || end == std::string_view::npos)
            throw Fault{"its appended data are missing or cut"};
        if (static_cast<std::uintmax_t>(lastOffset_) + start + 1 >= end)
            throw Fault{"an array lies beyond the appended data"};
    }

    XmlScan scan_;
    std::size_t bytes_;
    std::vector<std::string> open_;
    std::optional<std::array<std::int64_t, 6>> whole_;
    int pieces_ = 0, arrays_ = 0;
    std::int64_t lastOffset_ = -1;
    bool seenRoot_ = false, inArray_ = false, hasText_ = false, needsText_ = false;
};

}  // namespace

std::string vtiFault(const std::filesystem::path& file) {
    try {
        const std::string text = files::wholeText(file, "a volume", files::limits::geometryBytes);
        VtiCheck(text).run();
        return "";
    } catch (const Fault& fault) {
        return fault.reason;
    }
}

}  // namespace dustbench::volumes
