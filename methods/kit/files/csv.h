// Reads and writes CSV tables by RFC 4180: always a header, '.' as decimal point, empty cells for missing values.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dustbench::files {

/// A table read into memory. Throws InputError with the file, the line and what was expected.
class DUSTBENCH_API CsvTable {
 public:
    static CsvTable parseFile(const std::filesystem::path& file);
    static CsvTable parseText(std::string_view text, std::string name);

    [[nodiscard]] const std::vector<std::string>& header() const { return header_; }
    [[nodiscard]] std::size_t rows() const { return cells_.size(); }
    [[nodiscard]] bool hasColumn(std::string_view column) const;
    [[nodiscard]] const std::string& cell(std::size_t row, std::string_view column) const;
    /// The cell as a finite number.
    [[nodiscard]] double number(std::size_t row, std::string_view column) const;
    /// `file:line: ` of a row: prefix for an error message.
    [[nodiscard]] std::string where(std::size_t row) const;

 private:
    [[nodiscard]] std::size_t columnIndex(std::string_view column) const;

    std::string name_;
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> cells_;
    std::vector<std::size_t> lines_;
};

/// The whole text as a finite number, including denormal ones; otherwise empty.
[[nodiscard]] DUSTBENCH_API std::optional<double> numberOf(std::string_view text);
/// A cell's text, quoted if necessary.
[[nodiscard]] DUSTBENCH_API std::string csvCell(std::string_view text);
/// The shortest text that reads back as the same number; empty for NaN and infinities.
[[nodiscard]] DUSTBENCH_API std::string csvNumber(double value);

}  // namespace dustbench::files
