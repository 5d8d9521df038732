// Reads XML tag by tag, as far as VTK's files use it: elements, attributes, comments. Document types and CDATA
// are refused; references are decoded where a name is asked for (`Tag::text`); nothing nests on the stack.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace dustbench::volumes {

/// A reason to refuse a file, as one clause.
struct VolumeFault {
    std::string reason;
};

struct Tag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;
    enum class Kind { open, close, whole } kind = Kind::open;

    [[nodiscard]] bool has(std::string_view attribute) const { return attributes.contains(attribute); }
    /// Empty if it has none of that name.
    [[nodiscard]] std::string_view operator[](std::string_view attribute) const {
        const auto found = attributes.find(attribute);
        return found == attributes.end() ? std::string_view() : found->second;
    }
    /// The same with its references decoded, as `&amp;` or `&#228;`. Throws VolumeFault for one that is none.
    [[nodiscard]] std::string text(std::string_view attribute) const;
};

/// Without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The place among the words of what an attribute says; the first if the tag has none of that name. Throws VolumeFault
/// for another word.
[[nodiscard]] std::size_t choice(const Tag& tag, std::string_view attribute,
                                 std::initializer_list<std::string_view> words);

/// Keeps views into the text. Members throw VolumeFault.
class DUSTBENCH_API XmlScan {
 public:
    explicit XmlScan(std::string_view text) : rest_(text) {}

    /// The text before the next tag; at the end of the text there is no tag.
    std::string_view next(std::optional<Tag>& tag);
    /// What follows the last tag.
    [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
    [[nodiscard]] bool take(std::string_view token);
    void skipPast(std::string_view end);
    void skipBlanks();
    [[nodiscard]] std::string_view readName();
    [[nodiscard]] Tag readTag();
    void readAttribute(Tag& tag);

    std::string_view rest_;
};

}  // namespace dustbench::volumes
