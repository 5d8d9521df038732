// Lines, words and numbers of text meshes, and their error messages.
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

/// For messages; at most 40 bytes of the text.
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
    /// The words of the next non-blank line; false at the end.
    [[nodiscard]] bool nextWords(std::vector<std::string_view>& words);
    /// Bytes up to the end of the last line read.
    [[nodiscard]] std::size_t offset() const { return at_; }
    /// Throws InputError `file:line: what`.
    [[noreturn]] void fail(const std::string& what) const;
    /// Throws InputError if the word is not a finite number.
    [[nodiscard]] double number(std::string_view word) const;
    /// Three words as a point of finite floats.
    [[nodiscard]] glm::vec3 vector(const std::vector<std::string_view>& words, std::size_t first) const;
    /// Requires the line end that distinguishes a complete last line from a truncated one.
    void requireLineEnd() const;

 private:
    std::string_view text_;
    const std::filesystem::path& file_;
    std::size_t at_ = 0;
    std::size_t number_ = 0;
};

}  // namespace dustbench::meshes
