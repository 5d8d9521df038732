// Reads TOML files and reports precise errors: file, line, key, the value received and the value expected.
//
// The TOML library is not included here, so that only a few files pay for its compile time.
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

/// One table of a TOML file. `finish` rejects every key that was not read and suggests the nearest key that was read
/// or looked for with `has`. All members throw InputError, `scenes/flat.toml:12: key 'wind' … got …, expected …`.
class DUSTBENCH_API TomlReader {
 public:
    /// Limits on length and depth: limits.h.
    static TomlReader parseFile(const std::filesystem::path& file);
    /// `name` is the file name used in messages.
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
    /// An array of at least `minimum` numbers.
    [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t minimum = 0);
    /// An array of texts; a single text counts as an array of one.
    [[nodiscard]] std::vector<std::string> texts(std::string_view key);
    /// A number, boolean or text, as text; or an array of them. For values whose type is declared elsewhere.
    [[nodiscard]] std::vector<std::string> scalars(std::string_view key);

    [[nodiscard]] TomlReader table(std::string_view key);
    /// An array of tables (`[[key]]`); empty if the key is missing.
    [[nodiscard]] std::vector<TomlReader> tables(std::string_view key);

    /// Throws if the table has a key that was never read.
    void finish() const;

    /// `file:line: ` of a key, or of the table if the key is empty or missing: prefix for an error message.
    [[nodiscard]] std::string where(std::string_view key = {}) const;

 private:
    struct State;
    explicit TomlReader(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace dustbench::files
