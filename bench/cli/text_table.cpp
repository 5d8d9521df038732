#include "bench/cli/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "methods/kit/files/printable.h"

namespace dustbench::cli {
namespace {

bool looksNumeric(const std::string& cell) {
    return cell.find_first_not_of("0123456789.+-e%") == std::string::npos;
}

/// Characters on the screen: UTF-8 continuation bytes do not count.
std::size_t displayWidth(const std::string& cell) {
    return static_cast<std::size_t>(
        std::ranges::count_if(cell, [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0) != 0x80; }));
}

}  // namespace

std::string textTable(std::vector<std::vector<std::string>> rows) {
    if (rows.empty()) return {};
    for (auto& row : rows)
        for (std::string& cell : row) cell = files::printable(cell);
    std::vector<std::size_t> width(rows.front().size(), 0);
    std::vector<bool> right(rows.front().size(), rows.size() > 1);
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t column = 0; column < width.size(); ++column) {
            width[column] = std::max(width[column], displayWidth(rows[row][column]));
            if (row > 0 && !looksNumeric(rows[row][column])) right[column] = false;
        }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t column = 0; column < width.size(); ++column) {
            const std::string padding(width[column] - displayWidth(row[column]), ' ');
            line += (column ? "  " : "") + (right[column] ? padding + row[column] : row[column] + padding);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string fixed(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "";
}

}  // namespace dustbench::cli
