// Lines, words and numbers of meshes that are text, and the messages about them.
#pragma once

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::meshes {

[[nodiscard]] std::vector<std::string_view> wordsOf(std::string_view line);

/// At most 40 bytes, for a message.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// The whole word as a number, a leading '+' allowed.
template <typename Number>
[[nodiscard]] std::optional<Number> parse(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Iterates over a text's lines and counts them for messages.
class Lines {
 public:
    Lines(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

    /// The next line, blank or not; false at the end.
    [[nodiscard]] bool next(std::string_view& line);
    /// The words of the next line that has any; false at the end.
    [[nodiscard]] bool nextWords(std::vector<std::string_view>& words);
    /// Bytes up to the end of the last line read.
    [[nodiscard]] std::size_t offset() const { return at_; }
    /// Throws InputError `file:line: what`.
    [[noreturn]] void fail(const std::string& what) const;
    /// Throws InputError for what is no finite number.
    [[nodiscard]] double number(std::string_view word) const;
    /// Three words as a point of finite floats.
    [[nodiscard]] glm::vec3 vector(const std::vector<std::string_view>& words, std::size_t first) const;
    /// The line end is what tells a whole last line from a cut one.
    void requireLineEnd() const;

 private:
    std::string_view text_;
    const std::filesystem::path& file_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

}  // namespace dustbench::meshes
