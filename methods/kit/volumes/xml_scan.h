// Reads XML tag by tag, as far as VTK's files use it: elements, attributes, comments. Document types and CDATA
// are refused. References are decoded only in `Tag::text`. Nesting uses no stack.
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
    /// Empty if there is no such attribute.
    [[nodiscard]] std::string_view operator[](std::string_view attribute) const {
        const auto found = attributes.find(attribute);
        return found == attributes.end() ? std::string_view() : found->second;
    }
    /// The same with references such as `&amp;` or `&#228;` decoded. Throws VolumeFault for an invalid one.
    [[nodiscard]] std::string text(std::string_view attribute) const;
};

/// Without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Index of the attribute's value in the words; 0 if the tag does not have the attribute. Throws VolumeFault for any
/// other word.
[[nodiscard]] std::size_t choice(const Tag& tag, std::string_view attribute,
                                 std::initializer_list<std::string_view> words);

/// Holds views into the text. Members throw VolumeFault.
class DUSTBENCH_API XmlScan {
 public:
    explicit XmlScan(std::string_view text) : rest_(text) {}

    /// The text before the next tag; at the end of the text there is no tag.
    std::string_view next(std::optional<Tag>& tag);
    /// The text after the last tag.
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
