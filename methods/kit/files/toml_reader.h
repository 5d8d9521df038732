// Reads a TOML file with errors a person can act on: file, line, key, what was got, what is expected.
//
// The library behind it stays out of this header, so that few files pay for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "methods/contract/choices.h"

namespace dustbench::files {

/// One table of a TOML file. Every reader of a key marks it as known; `finish` refuses the rest, with the nearest name.
/// All members throw InputError, `scenes/flat.toml:12: key 'wind' … got …, expected …`.
class DUSTBENCH_API TomlReader {
 public:
    static TomlReader parseFile(const std::filesystem::path& file);
    /// `name` stands for the file in messages.
    static TomlReader parseText(std::string_view text, std::string name);
    TomlReader(TomlReader&&) noexcept;
    TomlReader& operator=(TomlReader&&) noexcept;
    ~TomlReader();

    [[nodiscard]] bool has(std::string_view key) const;
    /// Keys in the order of the file.
    [[nodiscard]] std::vector<std::string> keys() const;

    [[nodiscard]] double number(std::string_view key, double minimum, double maximum);
    [[nodiscard]] double number(std::string_view key, double minimum, double maximum, double initial);
    [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t minimum, std::int64_t maximum);
    [[nodiscard]] std::int64_t integer(std::string_view key, std::int64_t minimum, std::int64_t maximum,
                                       std::int64_t initial);
    [[nodiscard]] std::string text(std::string_view key);
    [[nodiscard]] std::string text(std::string_view key, std::string initial);
    [[nodiscard]] bool boolean(std::string_view key, bool initial);
    /// One of `allowed`.
    [[nodiscard]] std::string choice(std::string_view key, const std::vector<std::string>& allowed);
    template <typename Enumeration>
    [[nodiscard]] Enumeration choice(std::string_view key, const Choices<Enumeration>& choices) {
        return choices.valueOf(choice(key, choices.words()));
    }
    [[nodiscard]] glm::dvec3 vector3(std::string_view key);
    [[nodiscard]] glm::dvec3 vector3(std::string_view key, glm::dvec3 initial);
    /// An array of numbers, at least `minimum` of them.
    [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t minimum = 0);
    /// An array of texts, or one text for an array of one.
    [[nodiscard]] std::vector<std::string> texts(std::string_view key);
    /// A number, boolean or text, as text; or an array of them. For values whose type somebody else declares.
    [[nodiscard]] std::vector<std::string> scalars(std::string_view key);

    [[nodiscard]] TomlReader table(std::string_view key);
    /// An array of tables (`[[key]]`); empty where the key is missing.
    [[nodiscard]] std::vector<TomlReader> tables(std::string_view key);

    /// Throws where the table has a key that nobody asked for.
    void finish() const;

    /// `file:line: ` of a key, or of the table where the key is empty or missing: the start of an error message.
    [[nodiscard]] std::string where(std::string_view key = {}) const;

 private:
    struct State;
    explicit TomlReader(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dustbench::files
